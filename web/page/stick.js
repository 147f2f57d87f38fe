/** An analog stick on the screen for the thumb: forward, backward, left and right. */

/** @import { StickPosition } from "../generated/messages.js" */
import { element } from "../shared/dom.js";
import { t } from "../shared/text.js";

/** Dead zone of each axis, as a share of its full deflection: a thumb is not exact. */
const DEAD_ZONE = 0.15;
/** Number of steps from the middle to full deflection. */
const STEPS = 20;

/** @typedef {Required<StickPosition>} Axes */

/**
 * Convert a stick's position to axis values (forward, turn), each from -1 to 1.
 * @param {number} right offset from the middle, -1 to 1
 * @param {number} down offset from the middle, -1 to 1
 */
export function axesFrom(right, down) {
  // A stick moves within a circle. Map it to a square: on a diagonal both axes reach 1, as with two keys.
  const distance = Math.hypot(right, down);
  const longer = Math.max(Math.abs(right), Math.abs(down));
  const stretch = longer ? (distance / longer) / Math.max(1, distance) : 0;
  const quantize = (/** @type {number} */ value) => {
    const size = (Math.abs(value) - DEAD_ZONE) / (1 - DEAD_ZONE);
    return size <= 0 ? 0 : (Math.sign(value) * Math.round(Math.min(size, 1) * STEPS)) / STEPS;
  };
  return { forward: quantize(-down * stretch) + 0, turn: quantize(right * stretch) + 0 }; // + 0: no -0
}

export class Stick {
  #keys;
  /**
   * The pointer that holds the knob; null for none.
   * @type {number | null}
   */
  #pointerId = null;
  #knob = element("div", { className: "ai4u-knob" });
  /** The stick's element; the caller places it. */
  element = element("div", {
    className: "ai4u-stick",
    role: "img",
    ariaLabel: t("Stick: push it to drive and turn"),
  });

  /** @param {import("./keys.js").HeldKeys} keys */
  constructor(keys) {
    this.#keys = keys;
    this.element.append(this.#knob);
    this.element.addEventListener("pointerdown", (event) => this.#begin(event));
    this.element.addEventListener("pointermove", (event) => this.#move(event));
    for (const type of /** @type {const} */ (["pointerup", "pointercancel", "lostpointercapture"])) {
      this.element.addEventListener(type, (event) => this.#end(event));
    }
    for (const type of ["mousedown", "contextmenu"]) {
      this.element.addEventListener(type, (event) => event.preventDefault());
    }
  }

  /** @param {PointerEvent} event */
  #begin(event) {
    if (this.#pointerId !== null || event.button !== 0) return;
    this.#pointerId = event.pointerId;
    this.element.setPointerCapture(event.pointerId);
    this.element.toggleAttribute("data-held", true);
    this.#move(event);
  }

  /** @param {PointerEvent} event */
  #move(event) {
    if (event.pointerId !== this.#pointerId) return;
    const { left, top, width } = this.element.getBoundingClientRect();
    const travel = width / 3; // so the knob stays within the stick's circle
    const [right, down] = [event.clientX - left - width / 2, event.clientY - top - width / 2];
    const scale = Math.min(1, travel / Math.hypot(right, down));
    this.#knob.style.transform = `translate(${right * scale}px, ${down * scale}px)`;
    this.#keys.setStick("stick", axesFrom(right / travel, down / travel));
  }

  /** @param {PointerEvent} event */
  #end(event) {
    if (event.pointerId !== this.#pointerId) return;
    this.#pointerId = null;
    this.element.toggleAttribute("data-held", false);
    this.#knob.style.transform = "";
    this.#keys.setStick("stick", { forward: 0, turn: 0 });
  }
}
