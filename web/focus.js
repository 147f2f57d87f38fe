/** The focus of the page: it leaves the panel's controls once they were used, so that the keys drive again. */

import { isTextInput } from "./keys.js";

const CONTROLS = "input, textarea, select";
/** Parts of the page that keep the focus until they are closed, and our panel, which returns it itself. */
const FOCUS_KEEPERS = "dialog, [role=dialog], [role=menu], .ai4u-panel";

/** Return true if the keyboard reaches the page, and no text field takes its keys. */
export function keysReachPage() {
  return document.hasFocus() && !isTextInput(document.activeElement);
}

/**
 * Return the focus to the document after one of viser's controls was used.
 * @param {() => void} changed called when the focus has moved
 */
export function leaveControls(changed) {
  const later = () => setTimeout(changed); // while the event is handled, the focus has not moved yet
  for (const type of ["focusin", "focusout", "focus", "blur"]) addEventListener(type, later);
  addEventListener("keydown", (event) => leaveOnKey(event), { capture: true });
  addEventListener("change", ({ target }) => target.matches?.("select") && leave(target));
  addEventListener("click", (event) => leaveOnClick(event), { capture: true });
  // a click on the picture always gives the keys back, whatever viser does with it
  addEventListener("pointerdown", ({ target }) => target.matches?.("canvas") && document.activeElement?.blur(), { capture: true });
}

function leaveOnKey({ key, target, isComposing }) {
  const isField = target.matches?.("input") && isTextInput(target);
  // in a list that can be chosen from, Enter chooses: that counts as a click on the choice
  const chooses = target.matches?.("[aria-haspopup]") && target.ariaExpanded === "true";
  if (isField && !isComposing && (key === "Escape" || (key === "Enter" && !chooses))) leave(target);
}

/** Leave a text field after a click beside it: on a choice of its list, or on its buttons to step. */
function leaveOnClick({ target }) {
  const focused = document.activeElement ?? document.body;
  if (!focused.contains(target) && !target.closest?.("label")) leave(focused);
}

/** Blur an element after the event was handled: viser reads the field's value on its own blur or Enter. */
function leave(target) {
  if (!target?.matches?.(CONTROLS) || target.closest(FOCUS_KEEPERS)) return;
  setTimeout(() => document.activeElement === target && target.blur());
}
