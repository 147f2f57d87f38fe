/** One field of a form: label, control, unit, hint and problem. */

/** @import { FormField } from "../../generated/messages.js" */
import { element, setAttributes, setText } from "../../shared/dom.js";
import { freeId } from "../../shared/ids.js";
import { t } from "../../shared/text.js";

/** A text of more characters, or of several lines, gets a text area. */
const MAX_LINE_CHARS = 40;

export class FieldRow {
  #field;
  #onEnter;
  /** @type {HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement} */
  #control;
  #hint = element("small", { className: "ai4u-field-hint", id: freeId() });
  #detail = element("code", { className: "ai4u-details-only" });
  #problem = element("p", { className: "ai4u-problem", role: "alert", id: freeId() });
  #unit = element("span", { className: "ai4u-unit" });
  #label = element("label");
  element = element("div", { className: "ai4u-field" });

  /**
   * @param {FormField} field
   * @param {(entered: string | boolean | undefined) => void} onEnter called with an entry; with undefined if the field shows
   *   its value again
   */
  constructor(field, onEnter) {
    this.#field = field;
    this.#onEnter = onEnter;
    this.#control = control(field);
    this.#control.id = freeId();
    this.#label.htmlFor = this.#control.id;
    setAttributes(this.#control, { "aria-describedby": `${this.#hint.id} ${this.#problem.id}` });
    this.element.dataset.kind = field.kind;
    const row = element("div", { className: "ai4u-field-control" }, this.#control, this.#unit);
    this.element.append(this.#label, row, this.#hint, this.#detail, this.#problem);
    this.#control.addEventListener("change", () => this.#enter());
    this.element.addEventListener("keydown", (event) => this.#onKey(event));
  }

  /**
   * @param {FormField} field
   * @param {boolean} isPending true if an entry was not accepted yet, which stays then
   */
  update(field, isPending) {
    this.#field = field;
    setText(this.#label, field.label);
    setText(this.#unit, field.unit ?? "");
    setText(this.#hint, field.hint ?? "");
    setText(this.#detail, (field.detail ?? "").replaceAll("``", ""));
    if (this.#control instanceof HTMLSelectElement) setOptions(this.#control, field);
    if (!isPending && document.activeElement !== this.#control) this.#show();
  }

  /** @param {string} text empty for none */
  setProblem(text) {
    setText(this.#problem, text);
    setAttributes(this.#control, { "aria-invalid": text ? "true" : null });
  }

  #show() {
    if (isSwitch(this.#control)) this.#control.checked = this.#field.value === true;
    else this.#control.value = shownText(this.#field);
  }

  #enter() {
    const [shown, entered] = isSwitch(this.#control)
      ? [this.#field.value === true, this.#control.checked]
      : [shownText(this.#field), this.#control.value];
    this.#onEnter(entered === shown ? undefined : entered);
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (event.key !== "Escape" || event.isComposing || isSwitch(this.#control)) return;
    this.#show();
    this.setProblem("");
    this.#onEnter(undefined);
  }
}

/** @param {FormField} field */
function control(field) {
  if (field.kind === "switch") return element("input", { type: "checkbox" });
  if (field.kind === "choice") return element("select");
  const text = shownText(field);
  if (text.includes("\n") || text.length > MAX_LINE_CHARS) {
    return element("textarea", { rows: Math.min(8, Math.max(2, text.split("\n").length)), spellcheck: false });
  }
  const isNumber = field.kind === "number" || field.kind === "whole";
  const inputMode = isNumber ? (field.kind === "whole" ? "numeric" : "decimal") : "text";
  return element("input", { type: "text", inputMode, autocomplete: "off", spellcheck: false });
}

/**
 * @param {Element} control
 * @returns {control is HTMLInputElement}
 */
function isSwitch(control) {
  return control instanceof HTMLInputElement && control.type === "checkbox";
}

/** @param {FormField} field */
function shownText({ shown, value }) {
  return shown ?? (value === null || value === undefined ? "" : String(value));
}

/**
 * @param {HTMLSelectElement} select
 * @param {FormField} field
 */
function setOptions(select, { choices, words = choices }) {
  const key = JSON.stringify(choices);
  if (select.dataset.choices === key) return;
  select.dataset.choices = key;
  select.replaceChildren(...choices.map((value, index) => element("option", { value, textContent: words[index] || t("none") })));
}
