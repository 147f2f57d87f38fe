/** Keyboard focus: on the page, in a text field or another window. */

import { isTextInput } from "./keys.js";

/** Return true if the keyboard reaches the page, and no text field takes its keys. */
export function keysReachPage() {
  return document.hasFocus() && !isTextInput(document.activeElement);
}

/**
 * Call a function whenever the focus has moved; a click on the picture takes it from a text field.
 * @param {() => void} changed
 */
export function watchFocus(changed) {
  const later = () => setTimeout(changed); // while the event is handled, the focus has not moved yet
  for (const type of ["focusin", "focusout", "focus", "blur"]) addEventListener(type, later);
  // whatever viser does with the click
  addEventListener("pointerdown", blurForCanvas, { capture: true });
}

/** @param {PointerEvent} event */
function blurForCanvas({ target }) {
  if (target instanceof HTMLCanvasElement) /** @type {HTMLElement | null} */ (document.activeElement)?.blur();
}
