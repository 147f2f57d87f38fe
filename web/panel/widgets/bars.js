/** Numbers with bars: each has a name, a bar from its lowest to its highest value, and the value. */

/** @import { ChangedNumber } from "../../types/panel.js" */
import { element, keyed, setAttributes, setText } from "../../shared/dom.js";
import { number } from "../../shared/numbers.js";

/**
 * @typedef {object} Bar a number with a bar; without low and high there is no bar
 * @property {string} name
 * @property {number | null} value
 * @property {string} [unit]
 * @property {number | null} [low]
 * @property {number | null} [high]
 * @property {string} [text] in place of the value
 * @property {[number, number]} [good] a range to mark
 * @property {number} [why] how much it matters, 0 to 1
 */

export class Bars {
  element = element("div", { className: "ai4u-bars" });

  /** @param {Bar[]} rows */
  update(rows) {
    keyed(
      this.element,
      rows.map((row, index) => ({ ...row, index })),
      ({ index, name }) => `${index} ${name}`,
      makeRow,
      updateRow,
    );
  }
}

/**
 * Return true for a number of an action that does something; a jump of a robot that can't jump is left out.
 * @param {{has_effect?: boolean}} number
 */
export function hasEffect({ has_effect: has = true }) {
  return has;
}

/**
 * Return the row of a number of an action that would be another one.
 * @param {ChangedNumber} number
 * @returns {Bar}
 */
export function changedRow({ name, low, high, now, then }) {
  const text = now === then ? number(now) : `${number(now)} → ${number(then)}`;
  return { name, value: then, low, high, text };
}

function makeRow() {
  return element(
    "div",
    { className: "ai4u-bar-row" },
    element("span"),
    element("div", { className: "ai4u-bar", ariaHidden: "true" }, element("u"), element("s"), element("i")),
    element("b"),
  );
}

/**
 * @param {HTMLElement} row
 * @param {Bar} bar
 */
function updateRow(row, { name, value, unit = "", low, high, text, good, why = null }) {
  const [label, bar, shown] = row.children;
  const [range, fill, zero] = /** @type {HTMLCollectionOf<HTMLElement>} */ (bar.children);
  setText(label, name);
  setText(shown, `${text ?? number(value)}${unit ? ` ${unit}` : ""}`);
  setAttributes(row, { "data-why": why !== null });
  if (why !== null) row.style.setProperty("--why", `${(100 * Math.min(1, why)).toFixed(0)}%`);
  const hasBar = Number.isFinite(low) && Number.isFinite(high) && high > low && Number.isFinite(value);
  setAttributes(row, { "data-plain": !hasBar });
  if (!hasBar) return;
  const share = (/** @type {number} */ number) => Math.max(0, Math.min(1, (number - low) / (high - low)));
  place(fill, share(Math.max(low, Math.min(0, high))), share(value));
  range.hidden = !good;
  if (good) place(range, share(good[0]), share(good[1]));
  zero.hidden = !(low < 0 && high > 0);
  zero.style.left = `${100 * share(0)}%`;
}

/**
 * @param {HTMLElement} part of a bar
 * @param {number} from share of the bar
 * @param {number} to share of the bar
 */
function place(part, from, to) {
  const left = `${(100 * Math.min(from, to)).toFixed(1)}%`;
  const width = `${(100 * Math.abs(to - from)).toFixed(1)}%`;
  if (part.style.left !== left) part.style.left = left;
  if (part.style.width !== width) part.style.width = width;
}
