/** A form from a description of its fields. Each entry is sent when it is made; problems stand below their fields. */

/** @import { FormField } from "../../generated/messages.js" */
import { element, keyed, setText } from "../../shared/dom.js";
import { FieldRow } from "./field.js";
import { recall, remember } from "../../shared/storage.js";

/** Number of fields before "More" if the server doesn't say which. */
const FIRST_COUNT = 3;

export class Form {
  #onChange;
  #rows = new Map();
  /** Entries that were not accepted yet, by field: they are sent again with the next one. */
  #pending = new Map();
  #first = element("div", { className: "ai4u-form-first" });
  #rest = element("div", { className: "ai4u-form-rest" });
  #more = element(
    "details",
    { className: "ai4u-form-more", open: recall("form-more", false) },
    element("summary", { textContent: "More" }),
    this.#rest,
  );
  #problem = element("p", { className: "ai4u-problem", role: "alert" });
  element = element("div", { className: "ai4u-form" }, this.#first, this.#more, this.#problem);

  /** @param options.onChange called with the entries by field; returns a promise of the server's answer */
  constructor({ onChange }) {
    this.#onChange = onChange;
    this.#more.addEventListener("toggle", () => remember("form-more", this.#more.open));
  }

  /**
   * Show fields. A field that has the focus or an entry that was not accepted keeps what was typed.
   * @param {FormField[]} fields
   * @param {string[]} first names of the fields above "More"
   */
  update(fields, first = []) {
    const named = new Set(first.length ? first : fieldsThatMatter(fields));
    const names = new Set(fields.map(({ name }) => name));
    for (const name of [...this.#rows.keys()]) {
      if (names.has(name)) continue;
      this.#rows.delete(name);
      this.#pending.delete(name);
    }
    const order = first.length ? (a, b) => first.indexOf(a.name) - first.indexOf(b.name) : () => 0;
    this.#place(this.#first, fields.filter(({ name }) => named.has(name)).sort(order));
    const rest = fields.filter(({ name }) => !named.has(name));
    this.#place(this.#rest, rest);
    this.#more.hidden = rest.length === 0;
  }

  /** Show problems below their fields, and the others below the form. */
  showProblems(problems) {
    const texts = new Map();
    const others = [];
    for (const { path = [], text } of problems) {
      if (this.#rows.has(path[0])) texts.set(path[0], [...(texts.get(path[0]) ?? []), text]);
      else others.push(text);
    }
    for (const [name, row] of this.#rows) {
      row.setProblem((texts.get(name) ?? []).join(" "));
      if (texts.has(name) && this.#rest.contains(row.element)) this.#more.open = true;
    }
    setText(this.#problem, others.join(" "));
  }

  #place(parent, fields) {
    keyed(
      parent,
      fields,
      (field) => `${field.name} ${field.kind}`,
      (field) => this.#row(field).element,
      (_, field) => this.#rows.get(field.name).update(field, this.#pending.has(field.name)),
    );
  }

  #row(field) {
    const row = new FieldRow(field, (entered) => this.#enter(field.name, entered));
    this.#rows.set(field.name, row);
    return row;
  }

  async #enter(name, entered) {
    if (entered === undefined) this.#pending.delete(name);
    else this.#pending.set(name, entered);
    if (this.#pending.size === 0) return this.showProblems([]);
    const sent = new Map(this.#pending);
    const answer = await this.#onChange(Object.fromEntries(sent));
    if (answer.ok) {
      // something else may have been entered meanwhile
      for (const [each, value] of sent) if (this.#pending.get(each) === value) this.#pending.delete(each);
      this.showProblems([]);
    } else {
      this.showProblems(answer.problems?.length ? answer.problems : [{ text: answer.text }]);
    }
  }
}

/** @param {FormField[]} fields */
function fieldsThatMatter(fields) {
  const own = fields.filter((field) => !field.is_common);
  return (own.length ? own : fields).slice(0, FIRST_COUNT).map(({ name }) => name);
}
