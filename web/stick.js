/** A stick to be pushed with the thumb: ahead, back, left and right, by halves too. */

import { element } from "./dom.js";

/** Of the way in each direction this share counts as none: a thumb is not exact. */
const SLACK = 0.15;
/** Steps in which a push is told. */
const STEPS = 20;

/**
 * How far a stick is pushed: ahead and to the right, each from -1 to 1.
 * @param {number} right of its middle, -1 to 1
 * @param {number} down of its middle, -1 to 1
 */
export function pushed(right, down) {
  // a stick moves within a circle; at its corners both numbers shall be 1, as with two keys
  const reach = Math.hypot(right, down);
  const most = Math.max(Math.abs(right), Math.abs(down));
  const stretch = most ? (reach / most) / Math.max(1, reach) : 0;
  const tell = (share) => {
    const way = (Math.abs(share) - SLACK) / (1 - SLACK);
    return way <= 0 ? 0 : (Math.sign(share) * Math.round(Math.min(way, 1) * STEPS)) / STEPS;
  };
  return { forward: tell(-down * stretch) + 0, turn: tell(right * stretch) + 0 };
}

export class Stick {
  #keys;
  #finger = null;
  #knob = element("div", { className: "ai4u-knob" });
  /** To be put somewhere. */
  element = element("div", {
    className: "ai4u-stick",
    role: "img",
    ariaLabel: "Stick: push it to drive and turn",
  });

  /** @param {import("./keys.js").HeldKeys} keys */
  constructor(keys) {
    this.#keys = keys;
    this.element.append(this.#knob);
    this.element.addEventListener("pointerdown", (event) => this.#begin(event));
    this.element.addEventListener("pointermove", (event) => this.#move(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
      this.element.addEventListener(end, (event) => this.#end(event));
    }
    for (const unwanted of ["mousedown", "contextmenu"]) {
      this.element.addEventListener(unwanted, (event) => event.preventDefault());
    }
  }

  #begin(event) {
    if (this.#finger !== null || event.button !== 0) return;
    this.#finger = event.pointerId;
    this.element.setPointerCapture(event.pointerId);
    this.element.toggleAttribute("data-held", true);
    this.#move(event);
  }

  #move(event) {
    if (event.pointerId !== this.#finger) return;
    const { left, top, width } = this.element.getBoundingClientRect();
    const reach = width / 3; // the knob stays on its plate
    const [right, down] = [event.clientX - left - width / 2, event.clientY - top - width / 2];
    const shown = Math.min(1, reach / Math.hypot(right, down));
    this.#knob.style.transform = `translate(${right * shown}px, ${down * shown}px)`;
    this.#keys.push("stick", pushed(right / reach, down / reach));
  }

  #end(event) {
    if (event.pointerId !== this.#finger) return;
    this.#finger = null;
    this.element.toggleAttribute("data-held", false);
    this.#knob.style.transform = "";
    this.#keys.push("stick", { forward: 0, turn: 0 });
  }
}
