/** Shortcuts for changing the world: undo and redo anywhere; the others come with the palette (world/palette.js). */

/** @import { Panel } from "./panel.js" */
import { isTextInput } from "../page/keys.js";

/** @type {Panel | null} */
let panel = null;

/**
 * Let the shortcuts work on a panel.
 * @param {Panel} itsPanel
 */
export function installShortcuts(itsPanel) {
  panel = itsPanel;
}

// When this module is loaded, because it has to come before the listener that drives (page/keys.js): arrow keys
// may drive, too.
addEventListener(
  "keydown",
  (event) => {
    if (panel === null || isTextInput(event.target) || event.isComposing) return;
    if (document.querySelector("dialog[open]")) return;
    const run = panel.palette?.commandOf(event) ?? commandOf(event);
    if (run === null) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    run();
  },
  { capture: true },
);

/**
 * Return what a key does as a function; null if it does nothing here.
 * @param {KeyboardEvent} event
 */
function commandOf({ key, ctrlKey, metaKey, shiftKey }) {
  const letter = ctrlKey || metaKey ? key.toLowerCase() : "";
  if (letter === "z") return () => panel.send(shiftKey ? "redo" : "undo");
  return letter === "y" ? () => panel.send("redo") : null;
}
