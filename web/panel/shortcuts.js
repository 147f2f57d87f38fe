/** Shortcuts for changing the world: undo and redo anywhere; delete, copy, paste and nudge for the selected things. */

/** @import { Panel } from "./panel.js" */
import { isTextInput } from "../page/keys.js";
import { choose, duplicateSelected, removeSelected, selected } from "./world/selection.js";

/** Distance by which an arrow key moves a thing if there is no grid, or while Alt is held (m). */
const FREE_STEP_M = 0.05;
/** Angle by which an arrow key rotates a thing while Shift is held (degrees). */
const TURN_STEP_DEG = 15;
/** @type {Record<string, [right: number, up: number]>} */
const DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

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
function commandOf(event) {
  const { key, code } = event;
  const isBuilding = panel.shown.tabs.includes("world");
  const names = isBuilding ? selected(panel) : [];
  if (event.ctrlKey || event.metaKey) {
    const letter = key.toLowerCase();
    if (letter === "z") return () => panel.send(event.shiftKey ? "redo" : "undo");
    if (letter === "y") return () => panel.send("redo");
    if (letter === "v" && isBuilding) return () => panel.palette?.bar.paste();
    if (names.length === 0) return null;
    if (letter === "d") return () => duplicateSelected(panel);
    if (letter === "c" && getSelection().isCollapsed) return () => panel.palette?.bar.copy();
    return null;
  }
  if (names.length === 0) return null;
  if (key === "Delete" || key === "Backspace") return () => removeSelected(panel);
  if (key === "Escape" && !panel.part("world")?.is_dragging) return () => choose(panel, null);
  if (code in DIRECTIONS && panel.part("world")?.is_move_mode && !usesArrows(event.target)) return () => nudge(names, event);
  return null;
}

/** @param {EventTarget} target */
function usesArrows(target) {
  return target instanceof Element && target.matches("[role=tab], [role=slider], input, select");
}

/**
 * @param {string[]} names
 * @param {KeyboardEvent} event
 */
async function nudge(names, { code, shiftKey, altKey }) {
  const [right, up] = DIRECTIONS[code];
  const step = (!altKey && panel.part("world")?.snap) || FREE_STEP_M;
  const turn = shiftKey ? -right * TURN_STEP_DEG : 0;
  const [dx, dy] = shiftKey ? [0, 0] : [right * step, up * step];
  const answer = await panel.send("nudge", { names, dx, dy, turn_deg: turn }, { quiet: true });
  if (answer.ok) panel.palette?.say(answer.text);
}
