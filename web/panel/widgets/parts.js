/** Parts that the panel's tabs share: sections, switches, lists to choose from, tiles. */

import { element, setAttributes, setText } from "../../shared/dom.js";
import { icon } from "../../shared/icons.js";
import { freeId } from "../../shared/ids.js";
import { recall, remember } from "../../shared/storage.js";
import { t } from "../../shared/text.js";

/**
 * Return a section that folds, and remembers it. Put more children into `.content`.
 * @param {string} key under which it is remembered
 * @param {string} title
 * @param {{isOpen?: boolean, detailsOnly?: boolean}} [options]
 * @param {(Node | string | false)[]} children
 */
export function section(key, title, { isOpen = true, detailsOnly = false } = {}, ...children) {
  const content = element("div", { className: "ai4u-section-content" }, ...children);
  const made = element(
    "details",
    { className: "ai4u-section", open: recall(`section-${key}`, isOpen) },
    element("summary", {}, icon("down", 14), element("h3", { textContent: title })),
    content,
  );
  if (detailsOnly) made.classList.add("ai4u-details-only");
  made.addEventListener("toggle", () => remember(`section-${key}`, made.open));
  return Object.assign(made, { content });
}

/**
 * Return how something is computed, folded.
 * @param {Node[]} children
 */
export function howComputed(...children) {
  return element("details", { className: "ai4u-how" }, element("summary", { textContent: t("How is this computed?") }), ...children);
}

/**
 * Return a switch with a label. `set` shows a state without calling `onChange`.
 * @param {string} label
 * @param {(isOn: boolean) => void} onChange
 */
export function toggle(label, onChange, { title = "" } = {}) {
  const made = element(
    "button",
    { type: "button", className: "ai4u-toggle", title },
    element("i", { ariaHidden: "true" }),
    element("span", { textContent: label }),
  );
  const set = (/** @type {boolean} */ isOn) => setAttributes(made, { "aria-checked": isOn ? "true" : "false" });
  setAttributes(made, { role: "switch" });
  set(false);
  made.addEventListener("click", () => {
    const isOn = made.getAttribute("aria-checked") !== "true";
    set(isOn);
    onChange(isOn);
  });
  return { element: made, set };
}

/** @typedef {{value: string, text: string, reason?: string}} Option one with a reason can't be chosen; the reason stands behind it */

/**
 * Return a labelled list to choose from.
 * @param {string} label
 * @param {(value: string) => void} onChange
 */
export function choice(label, onChange) {
  const select = element("select", { id: freeId() });
  const made = element(
    "div",
    { className: "ai4u-field" },
    element("label", { htmlFor: select.id, textContent: label }),
    select,
  );
  let shown = "";
  select.addEventListener("change", () => onChange(select.value));
  const set = (/** @type {Option[]} */ options, /** @type {string} */ value) => {
    const key = JSON.stringify(options);
    if (key !== shown) {
      shown = key;
      const left = options.filter(({ reason }) => reason).map(optionElement);
      select.replaceChildren(...options.filter(({ reason }) => !reason).map(optionElement));
      if (left.length) select.append(element("optgroup", { label: t("Not for this robot") }, ...left));
    }
    if (select.value !== value) select.value = value;
  };
  return { element: made, set };
}

/** @param {Option} option */
function optionElement({ value, text, reason }) {
  const words = reason ? `${text} – ${reason}` : text;
  return element("option", { value, textContent: words, disabled: Boolean(reason) });
}

/**
 * Return a row of buttons of which one is pressed.
 * @template {string} Value
 * @param {string} label
 * @param {{value: Value, text: string, name?: string, title?: string}[]} options `name`: accessible name, if it says more than the text
 * @param {(value: Value) => void} onChange
 */
export function segments(label, options, onChange) {
  const buttons = options.map(({ value, text, name = "", title = "" }) =>
    element("button", { type: "button", textContent: text, ...(name && { ariaLabel: name }), title, value, on: { click: () => onChange(value) } }),
  );
  const made = element("div", { className: "ai4u-segments", role: "group", ariaLabel: label }, ...buttons);
  const set = (/** @type {string | null} */ value) => {
    for (const each of buttons) setAttributes(each, { "aria-pressed": each.value === value ? "true" : "false" });
  };
  set(null);
  return { element: made, set };
}

/**
 * Return a card of a gallery.
 * @param {{title: string, text?: string, note?: string, reason?: string}} tile `reason`: why it can't be chosen; empty if it can
 * @param {() => void} onClick
 */
export function tile({ title, text = "", note = "", reason = "" }, onClick) {
  const made = element(
    "button",
    { type: "button", className: "ai4u-tile" },
    element("strong", { textContent: title }),
    text && element("span", { textContent: text }),
    note && element("small", { textContent: note }),
    reason && element("em", { textContent: reason }),
  );
  // aria-disabled, not disabled: the reason can still be reached and read
  if (reason) setAttributes(made, { "aria-disabled": "true" });
  made.addEventListener("click", () => reason || onClick());
  return made;
}

/**
 * Return a grid of tiles.
 * @param {HTMLElement[]} children
 */
export function tiles(...children) {
  return element("div", { className: "ai4u-tiles" }, ...children);
}

/**
 * Return a line with a name and a value. `set` changes the value.
 * @param {string} name
 */
export function fact(name) {
  const value = element("dd");
  const made = element("div", { className: "ai4u-fact" }, element("dt", { textContent: name }), value);
  return { element: made, set: (/** @type {string} */ text) => setText(value, text) };
}
