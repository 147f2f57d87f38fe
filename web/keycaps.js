/** The keys on the screen: they light up while held, and can be pressed. */

import { element } from "./dom.js";
import { label } from "./labels.js";
import { cross } from "./places.js";
import { Stick } from "./stick.js";

/** How long a tap lasts that has no length of its own (ms), as from a screen reader. */
const TAP = 150;
const COARSE = matchMedia("(pointer: coarse)");

export class Keycaps {
  #keys;
  #keymap;
  #caps = new Map();
  #stick;
  #pad = element("div", { className: "ai4u-pad" });
  #more = element("div", { className: "ai4u-more" });
  #dock;
  #arranged = [{}, false];

  /**
   * @param {HTMLElement} dock where they lie
   * @param {import("./keys.js").HeldKeys} keys
   * @param {import("./keymap.js").KeyMap} keymap
   */
  constructor(dock, keys, keymap) {
    this.#dock = dock;
    this.#keys = keys;
    this.#keymap = keymap;
    this.#stick = new Stick(keys);
    dock.append(this.#pad, this.#more);
    COARSE.addEventListener("change", () => this.arrange(...this.#arranged));
  }

  /** Makes a cap for each action; a stick in place of four of them, where a thumb would push it. */
  arrange(bindings, takesStick) {
    this.#arranged = [bindings, takesStick];
    const made = new Map();
    this.#caps.clear();
    for (const [action, codes] of Object.entries(bindings)) {
      const cap = this.#cap(action, codes[0]);
      made.set(action, cap);
      this.#caps.set(cap, codes);
    }
    this.#pad.replaceChildren();
    for (const [place, action] of cross(bindings)) {
      const cap = made.get(action);
      made.delete(action);
      cap.style.gridArea = place;
      this.#pad.append(cap);
    }
    const hasStick = COARSE.matches && takesStick && this.#pad.hasChildNodes();
    if (hasStick) this.#pad.replaceChildren(this.#stick.element);
    this.#dock.toggleAttribute("data-touch", COARSE.matches);
    this.#pad.toggleAttribute("data-stick", hasStick);
    this.#more.replaceChildren(...made.values());
  }

  /** @param {string[]} held codes */
  draw(held) {
    for (const [cap, codes] of this.#caps) {
      cap.toggleAttribute("data-held", codes.some((code) => held.includes(code)));
    }
  }

  #cap(action, code) {
    const does = this.#keymap.name(action);
    const [key] = this.#keymap.keys[action];
    const printed = key === undefined ? "" : label(key);
    const cap = element(
      "button",
      { type: "button", className: "ai4u-cap", ariaLabel: `${does} (${printed || "no key"})` },
      element("kbd", { textContent: printed }),
      element("span", { textContent: does }),
    );
    cap.dataset.action = action;
    const press = (event) => {
      // without this a finger stays bound to the cap on which it came down, and can't slide on
      cap.releasePointerCapture(event.pointerId);
      this.#keys.press(`pointer ${event.pointerId}`, code);
    };
    const release = (event) => this.#keys.release(`pointer ${event.pointerId}`);
    cap.addEventListener("pointerdown", (event) => event.button === 0 && press(event));
    cap.addEventListener("pointerenter", (event) => event.buttons & 1 && press(event));
    for (const end of ["pointerup", "pointercancel", "pointerleave"]) {
      cap.addEventListener(end, release);
    }
    for (const unwanted of ["mousedown", "contextmenu"]) {
      cap.addEventListener(unwanted, (event) => event.preventDefault());
    }
    cap.addEventListener("click", (event) => {
      if (event.detail) return; // a pointer's, and that was told already
      this.#keys.press("click", code);
      setTimeout(() => this.#keys.release("click"), TAP);
    });
    return cap;
  }
}
