/** A line through numbers, from left to right, with zero always in sight. */

import { element, setAttributes } from "../../shared/dom.js";

const SVG = "http://www.w3.org/2000/svg";
const [WIDTH, HEIGHT] = [280, 60];

export class Curve {
  #line = document.createElementNS(SVG, "polyline");
  element = element("figure", { className: "ai4u-curve", hidden: true });

  /**
   * @param {string} name for screen readers
   * @param {string} caption below the line; empty for none
   */
  constructor(name, caption = "") {
    const picture = document.createElementNS(SVG, "svg");
    const viewBox = `0 0 ${WIDTH} ${HEIGHT}`;
    setAttributes(picture, { viewBox, role: "img", "aria-label": name, preserveAspectRatio: "none" });
    picture.append(this.#line);
    this.element.append(picture);
    if (caption) this.element.append(element("figcaption", { className: "ai4u-soft", textContent: caption }));
  }

  /** @param {number[]} values oldest first; fewer than two draw nothing */
  update(values) {
    this.element.hidden = values.length < 2;
    if (values.length >= 2) setAttributes(this.#line, { points: pointsOf(values) });
  }
}

/** @param {number[]} values */
function pointsOf(values) {
  const [low, high] = [Math.min(...values, 0), Math.max(...values, 0)];
  const span = high - low || 1;
  const at = (/** @type {number} */ value, /** @type {number} */ index) =>
    `${((WIDTH * index) / (values.length - 1)).toFixed(1)},${(2 + (HEIGHT - 4) * (1 - (value - low) / span)).toFixed(1)}`;
  return values.map(at).join(" ");
}
