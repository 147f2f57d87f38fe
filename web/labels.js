/** What is printed on a key, and what it does. */

const NAMES = {
  ArrowUp: "↑",
  ArrowDown: "↓",
  ArrowLeft: "←",
  ArrowRight: "→",
  ShiftLeft: "Shift",
  ShiftRight: "Right Shift",
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
const CAPTIONS = { backward: "back", jump_forward: "leap", turn_left: "left", turn_right: "right" };

let layout = new Map();

/** Asks the browser for the keyboard's layout; only some tell. */
export async function learnLayout() {
  try {
    layout = (await navigator.keyboard?.getLayoutMap()) ?? layout;
  } catch {
    // not allowed in this frame: the letters of an English keyboard then
  }
}

/** What is printed on the key of a code. */
export function label(code) {
  const printed = layout.get(code);
  if (printed?.trim()) return printed.toLocaleUpperCase();
  return NAMES[code] ?? code.replace(/^(Key|Digit|Numpad)/, "");
}

/**
 * What an action is called under its key.
 * @param {string} action
 * @param {Record<string, string>} told what the server calls it in this scene
 */
export function caption(action, told = {}) {
  return told[action] ?? CAPTIONS[action] ?? action.replaceAll("_", " ");
}
