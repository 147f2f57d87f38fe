/**
 * Which keys are held and how far a stick is pushed, on the keyboard, the screen or a gamepad.
 *
 * Keys are places (KeyboardEvent.code), so they don't depend on the layout. viser moves its camera
 * with some of them, from a listener on `document`; this one comes first and lets nothing through.
 */

/** Milliseconds; the server lets go of keys that it hasn't heard of for three times as long. */
const REPEAT = 100;
/** Milliseconds between two words about a stick: the server doesn't listen to whoever says too many. */
const PACE = 25;
const MOST = 16;
const CAMERA = [..."WASDQE"].map((letter) => `Key${letter}`).concat(
  ["Up", "Down", "Left", "Right"].map((side) => `Arrow${side}`),
);
const WITHOUT_TEXT = "button, checkbox, color, file, image, radio, range, reset, submit".split(", ");

export class HeldKeys {
  /** Called with the code of each key that is pressed anew. */
  onpress = (_code) => {};
  /** Whether the keyboard is somebody else's now. */
  isAsleep = () => false;

  #means = new Map();
  #sources = new Map();
  #sticks = new Map();
  #changed;
  #timer = 0;
  #told = 0;
  #reachedByTab = null;

  /** @param {() => void} changed called at each change, and while anything is held */
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

  /** The codes that are held now, as the agent knows them. */
  get held() {
    return [...new Set(this.#sources.values())].slice(0, MOST);
  }

  /** How far all sticks together are pushed: ahead and to the right, each from -1 to 1. */
  get stick() {
    const sum = { forward: 0, turn: 0 };
    for (const { forward, turn } of this.#sticks.values()) {
      sum.forward = Math.max(-1, Math.min(1, sum.forward + forward));
      sum.turn = Math.max(-1, Math.min(1, sum.turn + turn));
    }
    return sum;
  }

  /** @param {Map<string, string>} means for a key of this keyboard the code that the agent listens to */
  bind(means) {
    this.#means = means;
  }

  /** @param {string} source what holds the key: the key itself, or a finger on the screen */
  press(source, code) {
    if (this.#sources.get(source) === code) return;
    this.#sources.set(source, code);
    this.onpress(code);
    this.#tell();
  }

  /** @param {{forward: number, turn: number}} how far the stick of a source is pushed */
  push(source, { forward, turn }) {
    const before = this.#sticks.get(source);
    if ((before?.forward ?? 0) === forward && (before?.turn ?? 0) === turn) return;
    if (forward || turn) this.#sticks.set(source, { forward, turn });
    else this.#sticks.delete(source);
    if (!before) this.onpress("");
    const wait = forward || turn ? this.#told + PACE - performance.now() : 0;
    if (wait <= 0) return this.#tell();
    clearInterval(this.#timer);
    this.#timer = setTimeout(() => this.#tell(), wait);
  }

  release(source) {
    if (this.#sources.delete(source)) this.#tell();
  }

  releaseAll() {
    if (this.#sources.size + this.#sticks.size === 0) return;
    this.#sources.clear();
    this.#sticks.clear();
    this.#tell();
  }

  #tell() {
    clearInterval(this.#timer);
    this.#told = performance.now();
    if (this.#sources.size + this.#sticks.size) this.#timer = setInterval(() => this.#changed(), REPEAT);
    this.#changed();
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
    const means = this.#means.get(code);
    if (means === undefined) return;
    event.preventDefault();
    if (!event.repeat) this.press(code, means);
  }

  #up(event) {
    this.release(event.code);
    if (this.#isForOthers(event)) return;
    event.stopPropagation();
    if (this.#means.has(event.code)) event.preventDefault(); // Space would press a button
  }

  #isForOthers({ code, target, isComposing }) {
    if (this.isAsleep() || isComposing || isText(target)) return true;
    if (!this.#means.has(code) && !CAMERA.includes(code)) return true;
    // whoever walks through the controls by keyboard needs these keys there
    const walks = this.#reachedByTab === target && target !== document.body;
    return walks && (code === "Space" || code === "Enter" || code.startsWith("Arrow"));
  }
}

/** Whether keys write into it. */
export function isText(target) {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement) return !WITHOUT_TEXT.includes(target.type);
  return target.isContentEditable || target.matches("textarea, select, [role=textbox]");
}
