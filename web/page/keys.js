/**
 * Held keys and stick positions, from the keyboard, the screen and gamepads.
 *
 * Keys are positions on the keyboard (KeyboardEvent.code), so they don't depend on its layout. viser moves
 * its camera with some of them, from a listener on `document`; ours runs first and stops their propagation.
 */

/** @import { Axes } from "./stick.js" */

/** Interval at which held keys are sent again (ms); the server releases keys after three times as long. */
const RESEND_MS = 100;
/** Shortest time between two messages about a stick (ms), because of the server's rate limit. */
const MIN_STICK_MESSAGE_MS = 25;
/** Most keys that the server accepts as held at once. */
const MAX_HELD_KEYS = 16;
/** Codes of the keys with which viser moves its camera. */
const CAMERA_CODES = [..."WASDQE"].map((letter) => `Key${letter}`).concat(
  ["Up", "Down", "Left", "Right"].map((side) => `Arrow${side}`),
);
const INPUT_TYPES_WITHOUT_TEXT = "button, checkbox, color, file, image, radio, range, reset, submit".split(", ");

export class HeldKeys {
  /**
   * Called with the code of each newly pressed key.
   * @type {(code: string) => void}
   */
  onpress = () => {};
  /**
   * Called with the event of a newly pressed key that is not the agent's; returns true if it was used.
   * @type {(event: KeyboardEvent) => boolean}
   */
  onotherpress = () => false;
  /** Overridden by a dialog: while it returns true, keyboard events are ignored. */
  isSuspended = () => false;

  /**
   * The code to send, by the code of the pressed key.
   * @type {Map<string, string>}
   */
  #sentCodes = new Map();
  /**
   * Held codes by source: a key of the keyboard, a pointer or a gamepad button.
   * @type {Map<string, string>}
   */
  #sources = new Map();
  /**
   * Axes by source.
   * @type {Map<string, Axes>}
   */
  #sticks = new Map();
  #changed;
  #timer = 0;
  /** Time of the latest call of `changed` (ms, performance.now). */
  #notifiedAt = 0;
  /**
   * The control that the person moved to with the keyboard.
   * @type {EventTarget | null}
   */
  #reachedByKey = null;
  /** True if the focus moves because of a key, not of a pointer. */
  #movesFocus = false;

  /** @param {() => void} changed called at each change, and repeatedly while anything is held */
  constructor(changed) {
    this.#changed = changed;
    const first = { capture: true };
    addEventListener("keydown", (event) => this.#down(event), first);
    addEventListener("keyup", (event) => this.#up(event), first);
    addEventListener("focusin", (event) => isTextInput(event.target) && this.releaseAll(), first);
    addEventListener("focusin", ({ target }) => this.#movesFocus && (this.#reachedByKey = target), first);
    addEventListener(
      "pointerdown",
      () => {
        this.#reachedByKey = null;
        this.#movesFocus = false;
      },
      first,
    );
    for (const type of ["blur", "pagehide"]) addEventListener(type, () => this.releaseAll());
    document.addEventListener("visibilitychange", () => document.hidden && this.releaseAll());
  }

  /** The held keys, as codes that the agent knows. */
  get held() {
    return [...new Set(this.#sources.values())].slice(0, MAX_HELD_KEYS);
  }

  /** The sum of all sticks: forward and turn (positive to the right), each from -1 to 1. */
  get stick() {
    const sum = { forward: 0, turn: 0 };
    for (const { forward, turn } of this.#sticks.values()) {
      sum.forward = Math.max(-1, Math.min(1, sum.forward + forward));
      sum.turn = Math.max(-1, Math.min(1, sum.turn + turn));
    }
    return sum;
  }

  /** @param {Map<string, string>} sentCodes the code to send, by the code of the pressed key */
  bind(sentCodes) {
    this.#sentCodes = sentCodes;
  }

  /**
   * @param {string} source what holds the key: a key of the keyboard, a pointer, a gamepad button
   * @param {string} code as the agent knows it
   */
  press(source, code) {
    if (this.#sources.get(source) === code) return;
    this.#sources.set(source, code);
    this.onpress(code);
    this.#notify();
  }

  /**
   * Set the axes of one stick.
   * @param {string} source the stick
   * @param {Axes} axes
   */
  setStick(source, { forward, turn }) {
    const before = this.#sticks.get(source);
    if ((before?.forward ?? 0) === forward && (before?.turn ?? 0) === turn) return;
    if (forward || turn) this.#sticks.set(source, { forward, turn });
    else this.#sticks.delete(source);
    if (!before) this.onpress("");
    const wait = forward || turn ? this.#notifiedAt + MIN_STICK_MESSAGE_MS - performance.now() : 0;
    if (wait <= 0) return this.#notify();
    clearInterval(this.#timer);
    this.#timer = setTimeout(() => this.#notify(), wait);
  }

  /** @param {string} source what held the key */
  release(source) {
    if (this.#sources.delete(source)) this.#notify();
  }

  releaseAll() {
    if (this.#sources.size + this.#sticks.size === 0) return;
    this.#sources.clear();
    this.#sticks.clear();
    this.#notify();
  }

  #notify() {
    clearInterval(this.#timer);
    this.#notifiedAt = performance.now();
    if (this.#sources.size + this.#sticks.size) this.#timer = setInterval(() => this.#changed(), RESEND_MS);
    this.#changed();
  }

  /** @param {KeyboardEvent} event */
  #down(event) {
    const { code } = event;
    const isForOthers = this.#isForOthers(event);
    if (isForOthers || !this.#isOurs(code)) {
      this.#movesFocus = true; // not only Tab does: arrow keys do in a list of tabs
      const isShortcut = event.repeat || event.ctrlKey || event.metaKey || event.altKey;
      if (!isForOthers && !isShortcut && this.onotherpress(event)) event.preventDefault();
      return;
    }
    event.stopPropagation();
    if (event.ctrlKey || event.metaKey || event.altKey) {
      this.releaseAll(); // macOS sends no keyup events while Meta is held
      return;
    }
    const sent = this.#sentCodes.get(code);
    if (sent === undefined) {
      if (!event.repeat) this.onotherpress(event);
      return;
    }
    event.preventDefault();
    if (!event.repeat) this.press(code, sent);
  }

  /** @param {KeyboardEvent} event */
  #up(event) {
    this.release(event.code);
    if (this.#isForOthers(event) || !this.#isOurs(event.code)) return;
    event.stopPropagation();
    if (this.#sentCodes.has(event.code)) event.preventDefault(); // Space would press a button
  }

  /**
   * Return true for a key that drives, or would move viser's camera.
   * @param {string} code
   */
  #isOurs(code) {
    return this.#sentCodes.has(code) || CAMERA_CODES.includes(code);
  }

  /**
   * Return true if the browser or the focused control has to handle a keyboard event.
   * @param {KeyboardEvent} event
   */
  #isForOthers({ code, target, isComposing }) {
    if (this.isSuspended() || isComposing || isTextInput(target)) return true;
    // a control reached by a key needs its own keys
    const usesControl = this.#reachedByKey === target && target !== document.body;
    return usesControl && (code === "Space" || code === "Enter" || code.startsWith("Arrow"));
  }
}

/**
 * Return true if typing goes into the element, or into an editor that has keys of its own.
 * @param {EventTarget | null} target
 */
export function isTextInput(target) {
  if (target instanceof Element && target.closest("[data-ai4u-keys]")) return true;
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement) return !INPUT_TYPES_WITHOUT_TEXT.includes(target.type);
  return target.isContentEditable || target.matches("textarea, select, [role=textbox]");
}
