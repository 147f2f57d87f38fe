/** The rewards of an agent: each term's last and summed reward, and the curve of the episode. */

import { element, keyed, setAttributes, setText } from "./dom.js";
import { number } from "./panel_numbers.js";

const SVG = "http://www.w3.org/2000/svg";
const [WIDTH, HEIGHT] = [280, 60];

export class RewardTable {
  #help = element("p", { className: "ai4u-soft" });
  #rows = element("tbody");
  #total = element("tr", {}, element("th", { scope: "row", textContent: "Sum" }), element("td"), element("td"));
  #line = document.createElementNS(SVG, "polyline");
  #curve = document.createElementNS(SVG, "svg");
  #figure = element("figure", { className: "ai4u-curve ai4u-details-only" });
  element;

  constructor() {
    const heads = ["Reward", "Last decision", "Episode"].map((text) => element("th", { scope: "col", textContent: text }));
    const table = element(
      "table",
      { className: "ai4u-rewards" },
      element("thead", {}, element("tr", {}, ...heads)),
      this.#rows,
      element("tfoot", {}, this.#total),
    );
    setAttributes(this.#curve, { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": "The score during the episode", preserveAspectRatio: "none" });
    this.#curve.append(this.#line);
    this.#figure.append(this.#curve);
    this.element = element("div", {}, this.#help, table, this.#figure);
  }

  setHelp(text) {
    setText(this.#help, text);
    this.#help.hidden = !text;
  }

  /** @param terms [{term, decision, episode}] */
  update(terms) {
    keyed(this.#rows, terms, ({ term }) => term, makeRow, (row, { term, decision, episode }) => {
      fill(row, term, decision, episode);
    });
    const sum = (name) => terms.reduce((total, each) => total + (each[name] ?? 0), 0);
    fill(this.#total, "Sum", sum("decision"), sum("episode"));
    this.#total.hidden = terms.length < 2;
  }

  /** @param points [decision, its reward, the sum so far] of each decision, oldest first */
  drawCurve(points) {
    const sums = points.map(([, , sum]) => sum);
    this.#figure.hidden = sums.length < 2;
    if (sums.length >= 2) setAttributes(this.#line, { points: line(sums) });
  }
}

function makeRow() {
  return element("tr", {}, element("th", { scope: "row" }), element("td"), element("td"));
}

function fill(row, name, decision, episode) {
  const [head, last, all] = row.children;
  setText(head, name);
  setText(last, number(decision));
  setText(all, number(episode));
}

function line(points) {
  const [low, high] = [Math.min(...points, 0), Math.max(...points, 0)];
  const span = high - low || 1;
  const at = (value, index) =>
    `${((WIDTH * index) / (points.length - 1)).toFixed(1)},${(2 + (HEIGHT - 4) * (1 - (value - low) / span)).toFixed(1)}`;
  return points.map(at).join(" ");
}
