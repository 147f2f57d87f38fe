/** Parts that the panel's tabs share: sections, switches, lists to choose from, tiles. */

import { element, setAttributes, setText } from "../../shared/dom.js";
import { icon } from "../../shared/icons.js";
import { freeId } from "../../shared/ids.js";
import { recall, remember } from "../../shared/storage.js";

/** A section that folds, and remembers it. Put more children into `.content`. */
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

/** A switch with a label. `set` shows a state without calling `onChange`. */
export function toggle(label, onChange, { title = "" } = {}) {
  const made = element(
    "button",
    { type: "button", className: "ai4u-toggle", title },
    element("i", { ariaHidden: "true" }),
    element("span", { textContent: label }),
  );
  const set = (isOn) => setAttributes(made, { "aria-checked": isOn ? "true" : "false" });
  setAttributes(made, { role: "switch" });
  set(false);
  made.addEventListener("click", () => {
    const isOn = made.getAttribute("aria-checked") !== "true";
    set(isOn);
    onChange(isOn);
  });
  return { element: made, set };
}

/** A labelled list to choose from. An option with a reason can't be chosen; the reason stands behind it. */
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
  const set = (options, value) => {
    const key = JSON.stringify(options);
    if (key !== shown) {
      shown = key;
      select.replaceChildren(...options.map(optionElement));
    }
    if (select.value !== value) select.value = value;
  };
  return { element: made, set };
}

function optionElement({ value, text, reason }) {
  const words = reason ? `${text} – ${reason}` : text;
  return element("option", { value, textContent: words, disabled: Boolean(reason) });
}

/** A row of buttons of which one is pressed. */
export function segments(label, options, onChange) {
  const buttons = options.map(({ value, text, title = "" }) =>
    element("button", { type: "button", textContent: text, title, value, on: { click: () => onChange(value) } }),
  );
  const made = element("div", { className: "ai4u-segments", role: "group", ariaLabel: label }, ...buttons);
  const set = (value) => {
    for (const each of buttons) setAttributes(each, { "aria-pressed": each.value === value ? "true" : "false" });
  };
  set(null);
  return { element: made, set };
}

/**
 * A card of a gallery.
 * @param tile.reason why it can't be chosen; empty if it can
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

/** A grid of tiles. */
export function tiles(...children) {
  return element("div", { className: "ai4u-tiles" }, ...children);
}

/** A line with a name and a value. `set` changes the value. */
export function fact(name) {
  const value = element("dd");
  const made = element("div", { className: "ai4u-fact" }, element("dt", { textContent: name }), value);
  return { element: made, set: (text) => setText(value, text) };
}
