/** Helpers for building and updating elements. Text becomes text nodes, never HTML. */

import { icon as iconNamed } from "./icons.js";

/**
 * Return the page's element for a selector.
 * @param {string} selector
 */
export function find(selector) {
  return /** @type {HTMLElement} */ (document.querySelector(selector));
}

/**
 * Create an element.
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {{dataset?: Record<string, string | number>, on?: Record<string, (event: Event) => void>, [property: string]: unknown}}
 *   properties properties, or attributes where there is no such property; `on` has event handlers
 * @param {(Node | string | false)[]} children null and false are left out
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export function element(tag, { dataset = {}, on = {}, ...properties } = {}, ...children) {
  const made = document.createElement(tag);
  Object.assign(made.dataset, dataset);
  for (const [type, handle] of Object.entries(on)) made.addEventListener(type, handle);
  for (const [name, value] of Object.entries(properties)) {
    if (name in made) Object.assign(made, { [name]: value });
    else made.setAttribute(name, String(value));
  }
  for (const child of children) if (child !== false && child !== null && child !== undefined) made.append(child);
  return made;
}

/**
 * Set an element's text if it differs: screen readers announce every assignment.
 * @param {Node} target
 * @param {string} text
 */
export function setText(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

/**
 * Set attributes that differ. null and false remove one, true sets it to "".
 * @param {Element} target
 * @param {Record<string, unknown>} attributes
 */
export function setAttributes(target, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    const wanted = value === true ? "" : value === false || value === null || value === undefined ? null : String(value);
    if (target.getAttribute(name) === wanted) continue;
    if (wanted === null) target.removeAttribute(name);
    else target.setAttribute(name, wanted);
  }
}

/**
 * Create a button.
 * @param {string} text may be empty if there are an icon and a label
 * @param {(event: MouseEvent) => void} onClick
 * @param {{icon?: string, label?: string, kind?: string, [property: string]: unknown}} [options] `kind` is "", "main", "quiet"
 *   or "danger"; `label` an accessible name and tooltip, for a button without text; others are properties
 */
export function button(text, onClick, { icon = "", label = "", kind = "", ...properties } = {}) {
  const made = element(
    "button",
    { type: "button", className: "ai4u-panel-button", ...properties },
    icon && iconNamed(icon),
    text && element("span", { textContent: text }),
  );
  if (kind) made.dataset.kind = kind;
  if (label) setAttributes(made, { "aria-label": label, title: label });
  if (icon && !text) made.toggleAttribute("data-icon-only", true);
  made.addEventListener("click", onClick);
  return made;
}

/**
 * Create a button that asks for a file.
 * @param {string} text
 * @param {string} accept types of files, as an input has them
 * @param {(file: File) => void} onFile
 */
export function fileButton(text, accept, onFile) {
  const input = element("input", { type: "file", accept, hidden: true, tabIndex: -1 });
  input.addEventListener("change", () => {
    const [file] = input.files;
    input.value = ""; // so that the same file can be chosen again
    if (file) onFile(file);
  });
  const made = button(text, () => input.click(), { icon: "open" });
  return element("span", { className: "ai4u-file" }, made, input);
}

/**
 * Return a table's head: one row with the names of the columns.
 * @param {string[]} names
 */
export function tableHead(...names) {
  const cells = names.map((textContent) => element("th", { scope: "col", textContent }));
  return element("thead", {}, element("tr", {}, ...cells));
}

/**
 * Make an element's children match a list without creating those again that stay: focus, typed text and open
 * sections survive.
 * @template Item
 * @template {HTMLElement} Child
 * @param {Element} parent
 * @param {Iterable<Item>} items
 * @param {(item: NoInfer<Item>) => string | number} keyOf returns an item's key, unique in the list
 * @param {(item: NoInfer<Item>) => Child} make returns the element of a new item
 * @param {(child: NoInfer<Child>, item: NoInfer<Item>) => void} update brings an element up to date with its item
 */
export function keyed(parent, items, keyOf, make, update = () => {}) {
  const children = /** @type {Child[]} */ ([...parent.children]);
  const before = new Map(children.map((child) => [child.dataset.key, child]));
  let next = parent.firstElementChild;
  for (const item of items) {
    const key = String(keyOf(item));
    let child = before.get(key);
    before.delete(key);
    if (child === undefined) {
      child = make(item);
      child.dataset.key = key;
    }
    update(child, item);
    if (child === next) next = next.nextElementSibling;
    else parent.insertBefore(child, next); // moving the others instead would lose their focus
  }
  for (const child of before.values()) child.remove();
}

/**
 * Element that a pointer presses.
 * @type {Node | null}
 */
let pressed = null;
/**
 * Changes that wait until it is let go, by the parent of what they move.
 * @type {Map<Node, () => void>}
 */
const postponed = new Map();

function release() {
  pressed = null;
  const changes = [...postponed.values()];
  postponed.clear();
  for (const change of changes) change();
}

addEventListener("pointerdown", ({ target }) => (pressed = /** @type {Node} */ (target)), { capture: true });
// a click's handlers are chosen already; after the other two none comes
for (const type of ["click", "pointercancel", "contextmenu"]) addEventListener(type, release, { capture: true });
addEventListener("pointerup", () => requestAnimationFrame(release), { capture: true }); // let go elsewhere: no click comes

/**
 * Make a change that may move a parent's children; while one of them is pressed, when it is let go: a button that
 * moves away meanwhile gets no click.
 * @param {Node} parent
 * @param {() => void} change
 */
export function unlessPressed(parent, change) {
  if (pressed && parent.contains(pressed)) {
    postponed.set(parent, change);
    return;
  }
  postponed.delete(parent);
  change();
}

/**
 * Return a text as nodes: what stands in stars is bold.
 * @param {string} text
 */
export function withBold(text) {
  return text.split("*").map((part, index) => (index % 2 ? element("b", { textContent: part }) : part));
}
