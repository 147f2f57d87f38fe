/** A plot of a share for each of several values, with the range in which it lies with 95% certainty. */

import { element, setAttributes } from "../shared/dom.js";

const SVG = "http://www.w3.org/2000/svg";
const [WIDTH, HEIGHT] = [280, 130];
/** Places of 100% and 0%, and of the first and the last value. */
const [TOP, BOTTOM, LEFT, RIGHT] = [10, 104, 46, 262];
const CAP = 4;

/** @typedef {{value: number, middle: number, low: number, high: number}} Interval each number a share, but for the value */

export class IntervalPlot {
  #drawn = "";
  #picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img" });
  element = element("figure", { className: "ai4u-interval-plot", hidden: true }, this.#picture);

  /**
   * @param {Interval[]} rows in the order in which they are drawn; none hide it
   * @param {string} name for screen readers
   */
  update(rows, name) {
    const key = JSON.stringify([rows, name]);
    if (key === this.#drawn) return;
    this.#drawn = key;
    this.element.hidden = rows.length === 0;
    setAttributes(this.#picture, { "aria-label": name });
    const lines = [0, 0.5, 1].map((share) => {
      const y = yOf(share);
      const text = svg("text", { x: LEFT - 16, y: y + 3, "text-anchor": "end" });
      text.textContent = `${100 * share}%`;
      return [svg("line", { class: "ai4u-grid", x1: LEFT - 12, x2: RIGHT + 12, y1: y, y2: y }), text];
    });
    const points = rows.map(({ middle }, index) => `${xOf(index, rows.length)},${yOf(middle)}`);
    const curve = svg("polyline", { points: points.join(" ") });
    this.#picture.replaceChildren(...lines.flat(), curve, ...rows.flatMap((row, index) => mark(row, xOf(index, rows.length))));
  }
}

/**
 * @param {Interval} row
 * @param {number} x
 */
function mark({ value, middle, low, high }, x) {
  const [top, bottom] = [yOf(high), yOf(low)];
  const path = `M${x - CAP},${top}h${2 * CAP}m${-CAP},0V${bottom}m${-CAP},0h${2 * CAP}`;
  const label = svg("text", { x, y: HEIGHT - 8, "text-anchor": "middle" });
  label.textContent = String(value);
  return [svg("path", { d: path }), svg("circle", { cx: x, cy: yOf(middle), r: 3 }), label];
}

/**
 * @param {number} index
 * @param {number} count
 */
function xOf(index, count) {
  const part = count === 1 ? 0.5 : index / (count - 1);
  return Math.round(LEFT + part * (RIGHT - LEFT));
}

/** @param {number} share */
function yOf(share) {
  return Number((BOTTOM - share * (BOTTOM - TOP)).toFixed(1));
}

/**
 * @template {keyof SVGElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Record<string, string | number>} attributes
 */
function svg(tag, attributes) {
  const made = document.createElementNS(SVG, tag);
  setAttributes(made, attributes);
  return made;
}
