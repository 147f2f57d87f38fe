/** The keys on the screen: lit while held, and usable with mouse, fingers and screen readers. */

import { element } from "../shared/dom.js";
import { t } from "../shared/text.js";
import { label } from "./labels.js";
import { dpadActions } from "./dpad.js";
import { Stick } from "./stick.js";

/** Time that a key counts as held after a click without pointer events (ms), as from a screen reader. */
const CLICK_HOLD_MS = 150;
export const TOUCH_SCREEN = matchMedia("(pointer: coarse)");

export class Keycaps {
  #keys;
  #keymap;
  /**
   * Key codes by keycap.
   * @type {Map<HTMLElement, string[]>}
   */
  #keycaps = new Map();
  #stick;
  #dpad = element("div", { className: "ai4u-dpad" });
  #more = element("div", { className: "ai4u-more" });
  #dock;
  /** @type {Parameters<Keycaps["arrange"]>} */
  #arranged = [{}, false];

  /**
   * @param {HTMLElement} dock parent element
   * @param {import("./keys.js").HeldKeys} keys
   * @param {import("./keymap.js").KeyMap} keymap
   */
  constructor(dock, keys, keymap) {
    this.#dock = dock;
    this.#keys = keys;
    this.#keymap = keymap;
    this.#stick = new Stick(keys);
    dock.append(this.#dpad, this.#more);
    TOUCH_SCREEN.addEventListener("change", () => this.arrange(...this.#arranged));
  }

  /**
   * Create a keycap for each action; on touch screens, a stick in place of the directional pad.
   * @param {Record<string, string[]>} bindings key codes of the agent by action
   * @param {boolean} takesStick
   */
  arrange(bindings, takesStick) {
    this.#arranged = [bindings, takesStick];
    /** @type {Map<string, HTMLElement>} */
    const made = new Map();
    this.#keycaps.clear();
    for (const [action, codes] of Object.entries(bindings)) {
      const keycap = this.#keycap(action, codes[0]);
      made.set(action, keycap);
      this.#keycaps.set(keycap, codes);
    }
    this.#dpad.replaceChildren();
    for (const [direction, action] of dpadActions(bindings)) {
      const keycap = made.get(action);
      made.delete(action);
      keycap.style.gridArea = direction;
      this.#dpad.append(keycap);
    }
    const hasStick = TOUCH_SCREEN.matches && takesStick && this.#dpad.hasChildNodes();
    if (hasStick) this.#dpad.replaceChildren(this.#stick.element);
    this.#dock.toggleAttribute("data-touch", TOUCH_SCREEN.matches);
    this.#dpad.toggleAttribute("data-stick", hasStick);
    this.#more.replaceChildren(...made.values());
  }

  /** @param {string[]} held key codes */
  draw(held) {
    for (const [keycap, codes] of this.#keycaps) {
      keycap.toggleAttribute("data-held", codes.some((code) => held.includes(code)));
    }
  }

  /**
   * @param {string} action
   * @param {string} code sent while it is pressed
   */
  #keycap(action, code) {
    const name = this.#keymap.name(action);
    const [key] = this.#keymap.keys[action];
    const printed = key === undefined ? "" : label(key);
    const keycap = element(
      "button",
      { type: "button", className: "ai4u-keycap", ariaLabel: `${name} (${printed || t("no key")})` },
      element("kbd", { textContent: printed }),
      element("span", { textContent: name }),
    );
    keycap.dataset.action = action;
    keycap.dataset.code = code;
    const press = (/** @type {PointerEvent} */ event) => {
      // else the first keycap captures the finger, which then can't slide to another one
      keycap.releasePointerCapture(event.pointerId);
      this.#keys.press(`pointer ${event.pointerId}`, code);
    };
    const release = (/** @type {PointerEvent} */ event) => this.#keys.release(`pointer ${event.pointerId}`);
    keycap.addEventListener("pointerdown", (event) => event.button === 0 && press(event));
    keycap.addEventListener("pointerenter", (event) => event.buttons & 1 && press(event));
    for (const type of /** @type {const} */ (["pointerup", "pointercancel", "pointerleave"])) {
      keycap.addEventListener(type, release);
    }
    for (const type of ["mousedown", "contextmenu"]) {
      keycap.addEventListener(type, (event) => event.preventDefault());
    }
    keycap.addEventListener("click", (event) => {
      if (event.detail) return; // from a pointer, whose own events were handled above
      this.#keys.press("click", code);
      setTimeout(() => this.#keys.release("click"), CLICK_HOLD_MS);
    });
    return keycap;
  }
}
