/** Labels of keys, and captions of actions. */

import { t } from "../shared/text.js";

/** @type {Record<string, string>} */
const KEY_LABELS = {
  ArrowUp: "↑",
  ArrowDown: "↓",
  ArrowLeft: "←",
  ArrowRight: "→",
  Space: t("Space"),
  ShiftLeft: "Shift",
  ShiftRight: t("Right Shift"),
  Comma: ",",
  Period: ".",
  Slash: "/",
  Semicolon: ";",
  Quote: "'",
  BracketLeft: "[",
  BracketRight: "]",
  Minus: "-",
  Equal: "=",
};
/** The two directions in one text: each word alone means other things, too. */
const [LEFT, RIGHT] = t("left | right").split(" | ");
/** @type {Record<string, string>} */
const CAPTIONS = {
  accept: t("accept"),
  backward: t("back"),
  down: t("down"),
  forward: t("forward"),
  jump: t("jump"),
  jump_forward: t("jump forward"),
  left: LEFT,
  restart: t("restart"),
  right: RIGHT,
  turn_left: LEFT,
  turn_right: RIGHT,
  up: t("up"),
};

/** @type {ReadonlyMap<string, string>} */
let layout = new Map();

/** Load the keyboard's layout, where the browser supports that. */
export async function loadLayout() {
  try {
    layout = (await navigator.keyboard?.getLayoutMap()) ?? layout;
  } catch {
    // not allowed in this frame: labels are those of an English keyboard
  }
}

/**
 * Return the text printed on a key.
 * @param {string} code its KeyboardEvent.code
 */
export function label(code) {
  const printed = layout.get(code);
  if (printed?.trim()) return printed.toLocaleUpperCase();
  return KEY_LABELS[code] ?? code.replace(/^(Key|Digit|Numpad)/, "");
}

/**
 * Return an action's name for people.
 * @param {string} action
 * @param {Record<string, string>} sceneCaptions the scene's own names, by action
 */
export function caption(action, sceneCaptions = {}) {
  return sceneCaptions[action] ?? CAPTIONS[action] ?? action.replaceAll("_", " ");
}
