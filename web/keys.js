/**
 * Which keys are held, on the keyboard and on the screen.
 *
 * Keys are places (KeyboardEvent.code), so they don't depend on the layout. viser moves its camera
 * with some of them, from a listener on `document`; this one comes first and lets nothing through.
 */

/** Milliseconds; the server lets go of keys that it hasn't heard of for three times as long. */
const REPEAT = 100;
const MOST = 16;
const CAMERA = [..."WASDQE"].map((letter) => `Key${letter}`).concat(
  ["Up", "Down", "Left", "Right"].map((side) => `Arrow${side}`),
);
const WITHOUT_TEXT = "button, checkbox, color, file, image, radio, range, reset, submit".split(", ");

export class HeldKeys {
  /** Called with the code of each key that is pressed anew. */
  onpress = (_code) => {};

  #bound = new Set();
  #sources = new Map();
  #changed;
  #timer = 0;
  #reachedByTab = null;

  /** @param {(held: string[]) => void} changed called at each change, and while any key is held */
  constructor(changed) {
    this.#changed = changed;
    const first = { capture: true };
    addEventListener("keydown", (event) => this.#down(event), first);
    addEventListener("keyup", (event) => this.#up(event), first);
    addEventListener("focusin", (event) => isText(event.target) && this.releaseAll(), first);
    addEventListener("pointerdown", () => (this.#reachedByTab = null), first);
    for (const end of ["blur", "pagehide"]) addEventListener(end, () => this.releaseAll());
    document.addEventListener("visibilitychange", () => document.hidden && this.releaseAll());
  }

  /** The codes that are held now. */
  get held() {
    return [...new Set(this.#sources.values())].slice(0, MOST);
  }

  /** Says which codes mean something to the agent. */
  bind(codes) {
    this.#bound = new Set(codes);
  }

  /** @param {string} source what holds the key: the key itself, or a finger on the screen */
  press(source, code) {
    if (this.#sources.get(source) === code) return;
    this.#sources.set(source, code);
    this.onpress(code);
    this.#tell();
  }

  release(source) {
    if (this.#sources.delete(source)) this.#tell();
  }

  releaseAll() {
    if (this.#sources.size === 0) return;
    this.#sources.clear();
    this.#tell();
  }

  #tell() {
    clearInterval(this.#timer);
    if (this.#sources.size) this.#timer = setInterval(() => this.#changed(this.held), REPEAT);
    this.#changed(this.held);
  }

  #down(event) {
    const { code } = event;
    if (code === "Tab") requestAnimationFrame(() => (this.#reachedByTab = document.activeElement));
    if (this.#isForOthers(event)) return;
    event.stopPropagation();
    if (event.ctrlKey || event.metaKey || event.altKey) {
      this.releaseAll(); // while Meta is held, macOS tells of no key that goes up
      return;
    }
    if (!this.#bound.has(code)) return;
    event.preventDefault();
    if (!event.repeat) this.press(code, code);
  }

  #up(event) {
    this.release(event.code);
    if (this.#isForOthers(event)) return;
    event.stopPropagation();
    if (this.#bound.has(event.code)) event.preventDefault(); // Space would press a button
  }

  #isForOthers({ code, target, isComposing }) {
    if (isComposing || isText(target)) return true;
    if (!this.#bound.has(code) && !CAMERA.includes(code)) return true;
    // whoever walks through the controls by keyboard needs these keys there
    const walks = this.#reachedByTab === target && target !== document.body;
    return walks && (code === "Space" || code === "Enter" || code.startsWith("Arrow"));
  }
}

/** Whether keys write into it. */
function isText(target) {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement) return !WITHOUT_TEXT.includes(target.type);
  return target.isContentEditable || target.matches("textarea, select, [role=textbox]");
}
