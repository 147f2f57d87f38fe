/** Gamepads: the left stick or the directional pad drives, A jumps, B jumps forward, Start restarts. */

/** @import { Axes } from "./stick.js" */
import { dpadActions } from "./dpad.js";
import { axesFrom } from "./stick.js";

/** Poll interval (ms): browsers send no events for gamepad buttons. */
const POLL_MS = 20;
/**
 * Button indices of the standard gamepad mapping, by action and by direction.
 * @type {Record<string, number>}
 */
const ACTION_BUTTONS = { jump: 0, accept: 0, jump_forward: 1, restart: 9 };
/** @type {Record<string, number>} */
const DPAD_BUTTONS = { up: 12, down: 13, left: 14, right: 15 };
/** Button indices for an agent's other actions, in their order. */
const SPARE_BUTTONS = [2, 3, 5, 4, 7, 6];
/** Deflection from which the stick counts as a pressed key, for agents that take no axis values. */
const STICK_AS_KEY_THRESHOLD = 0.5;

export class Gamepads {
  #keys;
  /**
   * Key code by button index.
   * @type {Map<number, string>}
   */
  #codes = new Map();
  /**
   * Key code by direction of the pad.
   * @type {Map<string, string>}
   */
  #dpadCodes = new Map();
  #takesStick = false;
  #timer = 0;
  /**
   * Codes of the keys that were pressed at the last poll, by source.
   * @type {Map<string, string>}
   */
  #pressed = new Map();
  /**
   * Axes of the sticks at the last poll, by source.
   * @type {Map<string, Axes>}
   */
  #sticks = new Map();

  /** @param {import("./keys.js").HeldKeys} keys */
  constructor(keys) {
    this.#keys = keys;
    for (const type of ["gamepadconnected", "gamepaddisconnected"]) {
      addEventListener(type, () => this.#startOrStop());
    }
    this.#startOrStop();
  }

  /**
   * @param {Record<string, string[]>} bindings key codes of the agent by action
   * @param {boolean} takesStick
   */
  bind(bindings, takesStick) {
    const dpad = dpadActions(bindings);
    this.#takesStick = takesStick;
    this.#dpadCodes = new Map([...dpad].map(([direction, action]) => [direction, bindings[action][0]]));
    this.#codes = new Map([...this.#dpadCodes].map(([direction, code]) => [DPAD_BUTTONS[direction], code]));
    const spare = [...SPARE_BUTTONS];
    const onDpad = new Set(dpad.values());
    for (const [action, [code]] of Object.entries(bindings)) {
      if (onDpad.has(action)) continue;
      const button = ACTION_BUTTONS[action] ?? spare.shift();
      if (button !== undefined) this.#codes.set(button, code);
    }
  }

  #startOrStop() {
    clearInterval(this.#timer);
    if (connectedGamepads().length) this.#timer = setInterval(() => this.#poll(), POLL_MS);
    this.#poll();
  }

  #poll() {
    const { pressed, sticks } = this.#read();
    // Only changes are passed on: a key that was released for another reason must be pressed again.
    for (const [source, code] of pressed) {
      if (this.#pressed.get(source) !== code) this.#keys.press(source, code);
    }
    for (const source of this.#pressed.keys()) if (!pressed.has(source)) this.#keys.release(source);
    for (const source of this.#sticks.keys()) if (!sticks.has(source)) this.#keys.setStick(source, axesFrom(0, 0));
    for (const [source, stick] of sticks) {
      const before = this.#sticks.get(source) ?? axesFrom(0, 0);
      if (before.forward !== stick.forward || before.turn !== stick.turn) this.#keys.setStick(source, stick);
    }
    [this.#pressed, this.#sticks] = [pressed, sticks];
  }

  /** Return the pressed keys and the sticks of all gamepads, by source; none while another page has the focus. */
  #read() {
    /** @type {Map<string, string>} */
    const pressed = new Map();
    /** @type {Map<string, Axes>} */
    const sticks = new Map();
    for (const { index, axes, buttons } of document.hasFocus() && !document.hidden ? connectedGamepads() : []) {
      for (const [button, code] of this.#codes) {
        if (buttons[button]?.pressed) pressed.set(`gamepad ${index} button ${button}`, code);
      }
      const stick = axesFrom(axes[0] ?? 0, axes[1] ?? 0);
      if (this.#takesStick) sticks.set(`gamepad ${index}`, stick);
      else {
        const code = this.#dpadCodes.get(mainDirection(stick));
        if (code !== undefined) pressed.set(`gamepad ${index} stick`, code);
      }
    }
    return { pressed, sticks };
  }
}

function connectedGamepads() {
  return [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad?.connected);
}

/**
 * Return the direction into which a stick is pushed; empty for none.
 * @param {Axes} axes
 */
function mainDirection({ forward, turn }) {
  if (Math.max(Math.abs(forward), Math.abs(turn)) < STICK_AS_KEY_THRESHOLD) return "";
  if (Math.abs(forward) >= Math.abs(turn)) return forward > 0 ? "up" : "down";
  return turn > 0 ? "right" : "left";
}
