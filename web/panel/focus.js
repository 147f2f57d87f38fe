/** The focus goes back to the page after each use of the panel by pointer, so that W, A, S and D drive at once. */

import { isTextInput } from "../page/keys.js";

/** @param {HTMLElement} root the panel */
export function returnFocus(root) {
  let isPointer = false;
  addEventListener("pointerdown", () => (isPointer = true), { capture: true });
  addEventListener("keydown", () => (isPointer = false), { capture: true });
  // with the keyboard the focus stays: a person would lose their place
  const release = (/** @type {Event} */ { target }) => {
    if (isPointer && !isTextInput(target)) focusWorld();
  };
  root.addEventListener("click", release);
  root.addEventListener("change", ({ target }) => {
    if (isPointer && (target instanceof HTMLSelectElement || !isTextInput(target))) focusWorld();
  });
  root.addEventListener("keydown", (event) => {
    const { key, target, isComposing } = event;
    if (!isTextInput(target)) return;
    event.stopPropagation(); // else viser moves its camera
    if (isComposing) return;
    const ends = key === "Escape" || (key === "Enter" && !(target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement));
    if (ends) focusWorld(); // the field has handled the key before; losing the focus sends its entry
  });
  root.addEventListener("keyup", (event) => isTextInput(event.target) && event.stopPropagation());
}

/** Take the focus from whatever control has it. */
export function focusWorld() {
  if (!document.querySelector("dialog[open]")) /** @type {HTMLElement | null} */ (document.activeElement)?.blur();
}
