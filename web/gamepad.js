/** Gamepads: the left stick or the cross drives, A jumps, B leaps, Start restarts. */

import { cross } from "./places.js";
import { pushed } from "./stick.js";

/** Milliseconds between two looks; a browser tells of no button by itself. */
const LOOK = 20;
/** Buttons as the standard mapping counts them, by what they do. */
const BUTTONS = { jump: 0, accept: 0, jump_forward: 1, restart: 9 };
const CROSS = { up: 12, down: 13, left: 14, right: 15 };
/** For whatever else there is to be done. */
const SPARE = [2, 3, 5, 4, 7, 6];
/** From so far on a stick counts as a key, where nobody listens to halves. */
const FAR = 0.5;

export class Gamepads {
  #keys;
  #codes = new Map();
  #cross = new Map();
  #takesStick = false;
  #timer = 0;
  #before = new Map();

  /** @param {import("./keys.js").HeldKeys} keys */
  constructor(keys) {
    this.#keys = keys;
    for (const change of ["gamepadconnected", "gamepaddisconnected"]) {
      addEventListener(change, () => this.#count());
    }
    this.#count();
  }

  /** @param bindings for each action the codes that the agent listens to */
  bind(bindings, takesStick) {
    this.#takesStick = takesStick;
    this.#cross = new Map([...cross(bindings)].map(([place, action]) => [place, bindings[action][0]]));
    this.#codes = new Map([...this.#cross].map(([place, code]) => [CROSS[place], code]));
    const spare = [...SPARE];
    const placed = new Set(cross(bindings).values());
    for (const [action, [code]] of Object.entries(bindings)) {
      if (placed.has(action)) continue;
      const button = BUTTONS[action] ?? spare.shift();
      if (button !== undefined) this.#codes.set(button, code);
    }
  }

  #count() {
    clearInterval(this.#timer);
    if (gamepads().length) this.#timer = setInterval(() => this.#look(), LOOK);
    this.#look();
  }

  #look() {
    // two pages may be open, and only one of them is meant
    const here = document.hasFocus() && !document.hidden ? gamepads() : [];
    const now = new Map();
    const sticks = new Map();
    for (const { index, axes, buttons } of here) {
      for (const [button, code] of this.#codes) {
        if (buttons[button]?.pressed) now.set(`gamepad ${index} button ${button}`, code);
      }
      const push = pushed(axes[0] ?? 0, axes[1] ?? 0);
      if (this.#takesStick) sticks.set(`gamepad ${index}`, push);
      else {
        const code = this.#cross.get(direction(push));
        if (code !== undefined) now.set(`gamepad ${index} stick`, code);
      }
    }
    // only what changes is told: what was let go for another reason has to be pressed anew
    for (const [source, code] of now) {
      if (this.#before.get(source) !== code) this.#keys.press(source, code);
    }
    for (const [source, before] of this.#before) {
      if (typeof before === "string" && !now.has(source)) this.#keys.release(source);
      if (typeof before === "object" && !sticks.has(source)) this.#keys.push(source, pushed(0, 0));
    }
    for (const [source, push] of sticks) {
      const before = this.#before.get(source) ?? pushed(0, 0);
      if (before.forward !== push.forward || before.turn !== push.turn) this.#keys.push(source, push);
    }
    this.#before = new Map([...now, ...sticks]);
  }
}

function gamepads() {
  return [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad?.connected);
}

function direction({ forward, turn }) {
  if (Math.max(Math.abs(forward), Math.abs(turn)) < FAR) return "";
  if (Math.abs(forward) >= Math.abs(turn)) return forward > 0 ? "up" : "down";
  return turn > 0 ? "right" : "left";
}
