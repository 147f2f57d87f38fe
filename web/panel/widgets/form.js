/** A form from a description of its fields. Each entry is sent when it is made; problems stand below their fields. */

/** @import { FormField } from "../../generated/messages.js" */
/** @import { Answer, Problem } from "../../types/panel.js" */
import { element, keyed, setText } from "../../shared/dom.js";
import { FieldRow } from "./field.js";
import { recall, remember } from "../../shared/storage.js";
import { t } from "../../shared/text.js";

/** Number of fields before "More" if none are marked as the ones that matter most. */
const FIRST_COUNT = 3;

/** @typedef {Record<string, string | boolean>} Entries by field */

export class Form {
  #onChange;
  /**
   * Rows by the name of their field.
   * @type {Map<string, FieldRow>}
   */
  #rows = new Map();
  /**
   * Entries that were not accepted yet, by field: they are sent again with the next one.
   * @type {Map<string, string | boolean>}
   */
  #pending = new Map();
  #first = element("div", { className: "ai4u-form-first" });
  #rest = element("div", { className: "ai4u-form-rest" });
  #more = element(
    "details",
    { className: "ai4u-form-more", open: recall("form-more", false) },
    element("summary", { textContent: t("More") }),
    this.#rest,
  );
  #problem = element("p", { className: "ai4u-problem", role: "alert" });
  element = element("div", { className: "ai4u-form" }, this.#first, this.#more, this.#problem);

  /**
   * @param {object} options
   * @param {(entries: Entries) => Promise<Answer>} options.onChange sends entries; returns a promise of the server's answer
   */
  constructor({ onChange }) {
    this.#onChange = onChange;
    this.#more.addEventListener("toggle", () => remember("form-more", this.#more.open));
  }

  /**
   * Show fields. A field that has the focus or an entry that was not accepted keeps what was typed.
   * @param {FormField[]} fields
   */
  update(fields) {
    const first = fieldsThatMatter(fields);
    const names = new Set(fields.map(({ name }) => name));
    for (const name of [...this.#rows.keys()]) {
      if (names.has(name)) continue;
      this.#rows.delete(name);
      this.#pending.delete(name);
    }
    this.#place(this.#first, first);
    const rest = fields.filter((field) => !first.includes(field));
    this.#place(this.#rest, rest);
    this.#more.hidden = rest.length === 0;
  }

  /**
   * Show problems below their fields, and the others below the form.
   * @param {Problem[]} problems
   */
  showProblems(problems) {
    /** @type {Map<string, string[]>} */
    const texts = new Map();
    const others = [];
    for (const { path = [], text } of problems) {
      const name = String(path[0]);
      if (this.#rows.has(name)) texts.set(name, [...(texts.get(name) ?? []), text]);
      else others.push(text);
    }
    for (const [name, row] of this.#rows) {
      row.setProblem((texts.get(name) ?? []).join(" "));
      if (texts.has(name) && this.#rest.contains(row.element)) this.#more.open = true;
    }
    setText(this.#problem, others.join(" "));
  }

  /**
   * @param {HTMLElement} parent
   * @param {FormField[]} fields
   */
  #place(parent, fields) {
    keyed(
      parent,
      fields,
      (field) => `${field.name} ${field.kind}`,
      (field) => this.#row(field).element,
      (_, field) => this.#rows.get(field.name).update(field, this.#pending.has(field.name)),
    );
  }

  /** @param {FormField} field */
  #row(field) {
    const row = new FieldRow(field, (entered) => this.#enter(field.name, entered));
    this.#rows.set(field.name, row);
    return row;
  }

  /**
   * @param {string} name of the field
   * @param {string | boolean | undefined} entered undefined if the field shows its value again
   */
  async #enter(name, entered) {
    if (entered === undefined) this.#pending.delete(name);
    else this.#pending.set(name, entered);
    if (this.#pending.size === 0) return this.showProblems([]);
    const sent = new Map(this.#pending);
    const answer = await this.#onChange(Object.fromEntries(sent));
    if (answer.ok) {
      // something else may have been entered meanwhile
      for (const [field, value] of sent) if (this.#pending.get(field) === value) this.#pending.delete(field);
      this.showProblems([]);
    } else {
      this.showProblems(answer.problems.length ? answer.problems : [{ path: [], text: answer.text }]);
    }
  }
}

/**
 * Return the fields that stand before "More".
 * @param {FormField[]} fields
 */
function fieldsThatMatter(fields) {
  const marked = fields.filter((field) => field.is_first);
  if (marked.length) return marked;
  const own = fields.filter((field) => !field.is_common);
  return (own.length ? own : fields).slice(0, FIRST_COUNT);
}
