/** The keys on the screen: they light up while held, can be pressed, and say who drives. */

import { element } from "./dom.js";
import { caption, label } from "./labels.js";

/** What may lie at a place of the pad, first come first served. */
const PLACES = {
  up: ["forward", "up"],
  left: ["turn_left", "left"],
  down: ["backward", "down"],
  right: ["turn_right", "right"],
};
/** How long a tap lasts that has no length of its own (ms), as from a screen reader. */
const TAP = 150;

export class Keycaps {
  #keys;
  #caps = new Map();
  #pad = element("div", { className: "ai4u-pad" });
  #more = element("div", { className: "ai4u-more" });
  #dot = element("span", { className: "ai4u-dot", ariaHidden: "true" });
  #text = element("span");
  #take = element("button", { type: "button", className: "ai4u-button", textContent: "Take over" });

  /**
   * @param {import("./keys.js").HeldKeys} keys
   * @param {() => void} take called when the person wants to drive
   */
  constructor(keys, take) {
    this.#keys = keys;
    this.#take.addEventListener("click", take);
    const status = element("span", { role: "status" }, this.#text);
    document.body.append(
      element(
        "section",
        { className: "ai4u-dock", ariaLabel: "Drive" },
        element("div", { className: "ai4u-seat" }, this.#dot, status, this.#take),
        element("div", { className: "ai4u-keys" }, this.#pad, this.#more),
      ),
    );
  }

  /** Makes a cap for each action; `captions` says what some of them do here. */
  arrange(bindings, captions = {}) {
    const made = new Map();
    this.#caps.clear();
    for (const [action, codes] of Object.entries(bindings)) {
      made.set(action, this.#cap(action, codes[0], caption(action, captions)));
      this.#caps.set(made.get(action), codes);
    }
    this.#pad.replaceChildren();
    for (const [place, actions] of Object.entries(PLACES)) {
      const action = actions.find((each) => made.has(each));
      if (action === undefined) continue;
      const cap = made.get(action);
      made.delete(action);
      cap.style.gridArea = place;
      this.#pad.append(cap);
    }
    this.#more.replaceChildren(...made.values());
  }

  draw({ connected, hello, seat, held }) {
    for (const [cap, codes] of this.#caps) {
      cap.toggleAttribute("data-held", codes.some((code) => held.includes(code)));
    }
    const [kind, text] = standing({ connected, hello, seat });
    this.#dot.dataset.kind = kind;
    if (this.#text.textContent !== text) this.#text.textContent = text;
    this.#take.hidden = kind !== "other";
  }

  #cap(action, code, does) {
    const cap = element(
      "button",
      { type: "button", className: "ai4u-cap", ariaLabel: `${does} (${label(code)})` },
      element("kbd", { textContent: label(code) }),
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

function standing({ connected, hello, seat }) {
  if (!connected) return ["lost", "Connecting …"];
  if (Object.keys(hello.keys).length === 0) return ["none", `Driven by ${hello.brain}`];
  if (seat.driver === null) return ["free", "Press a key to drive"];
  if (seat.driver !== hello.you) return ["other", `Page ${seat.driver} drives`];
  return ["mine", seat.pages > 1 ? `You drive (page ${hello.you})` : "You drive"];
}
