/** Lists beside a program: what the agent senses and can do, and the variables of the latest decision. */

/** @import { Names } from "./start.js" */

import { element, keyed, setAttributes, setText } from "../shared/dom.js";
import { number } from "../shared/numbers.js";
import { t } from "../shared/text.js";
import { section } from "../panel/widgets/parts.js";

/** @typedef {{code: string, words: string}} Item */

const SVG = "http://www.w3.org/2000/svg";
/** Decisions in the curve of a variable. */
const MAX_POINTS = 200;
/** Size of a curve in its own units. */
const [CURVE_WIDTH, CURVE_HEIGHT] = [200, 24];

/** Names to put into the program by a click. */
export class NameList {
  #readings = element("ul", { className: "ai4u-code-names" });
  #outputs = element("ul", { className: "ai4u-code-names" });
  #onChoose;
  element = section(
    "code-names",
    t("Senses and actions"),
    {},
    element("h4", { textContent: t("It senses") }),
    this.#readings,
    element("h4", { textContent: t("It can do") }),
    this.#outputs,
  );

  /** @param {(code: string) => void} onChoose called with the code of a name that is clicked */
  constructor(onChoose) {
    this.#onChoose = onChoose;
  }

  /** @param {Names} names */
  update({ readings, outputs }) {
    this.#fill(this.#readings, readings.map(({ key, words }) => ({ code: `percept["${key}"]`, words })));
    this.#fill(this.#outputs, outputs.map(({ name, words }) => ({ code: `"${name}"`, words })));
  }

  /**
   * @param {HTMLElement} list
   * @param {Item[]} items
   */
  #fill(list, items) {
    const make = (/** @type {Item} */ { code }) => {
      const insert = element("button", { type: "button", title: t("Insert {code}", { code }) }, element("code", { textContent: code }));
      insert.addEventListener("click", () => this.#onChoose(code));
      return element("li", {}, insert, element("span"));
    };
    keyed(list, items, ({ code }) => code, make, (item, { words }) => setText(item.lastChild, words));
  }
}

/** The variables at the end of the latest decision, with curves of those that are numbers. */
export class VariableList {
  #list = element("dl", { className: "ai4u-code-variables" });
  /**
   * The latest numbers of each variable, the oldest first.
   * @type {Map<string, number[]>}
   */
  #numbers = new Map();
  element = section("code-variables", t("Variables"), {}, this.#list);

  constructor() {
    this.update({});
  }

  /**
   * Note the variables of a decision for their curves.
   * @param {Record<string, string>} variables texts by name
   */
  note(variables) {
    for (const [name, text] of Object.entries(variables)) {
      const value = Number(text);
      if (text.trim() === "" || !Number.isFinite(value)) continue;
      const numbers = this.#numbers.get(name) ?? [];
      this.#numbers.set(name, [...numbers.slice(1 - MAX_POINTS), value]);
    }
  }

  /** Forget the curves: another run begins. */
  clear() {
    this.#numbers.clear();
    this.update({});
  }

  /** @param {Record<string, string>} variables texts by name */
  update(variables) {
    const items = Object.entries(variables);
    this.element.hidden = items.length === 0;
    const make = (/** @type {[string, string]} */ [name]) => {
      const curve = document.createElementNS(SVG, "svg");
      setAttributes(curve, { viewBox: `0 -1 ${CURVE_WIDTH} ${CURVE_HEIGHT + 2}`, preserveAspectRatio: "none", role: "img" });
      curve.append(document.createElementNS(SVG, "polyline"));
      return element("div", {}, element("dt", { textContent: name }), element("dd"), curve);
    };
    keyed(this.#list, items, ([name]) => name, make, (item, [name, text]) => {
      setText(item.children[1], text);
      drawCurve(item.children[2], name, this.#numbers.get(name) ?? []);
    });
  }
}

/**
 * @param {Element} curve
 * @param {string} name
 * @param {number[]} numbers
 */
function drawCurve(curve, name, numbers) {
  curve.toggleAttribute("hidden", numbers.length < 2);
  if (numbers.length < 2) return;
  const [low, high] = [Math.min(...numbers), Math.max(...numbers)];
  const y = (/** @type {number} */ value) => (high === low ? CURVE_HEIGHT / 2 : (CURVE_HEIGHT * (high - value)) / (high - low));
  const points = numbers.map((value, index) => `${((CURVE_WIDTH * index) / (numbers.length - 1)).toFixed(1)},${y(value).toFixed(1)}`);
  setAttributes(curve.firstElementChild, { points: points.join(" ") });
  const words = { name, low: number(low), high: number(high), count: numbers.length };
  const label = t("{name}: from {low} to {high} in the latest {count} decisions", words);
  setAttributes(curve, { "aria-label": label });
}
