/** The results of a test: a sentence, and a table of its starts. */

/** @import { CodeTest, Start } from "./test.js" */

import { averageDecisions, STARTS } from "./test.js";
import { button, element, keyed, setAttributes, setText, tableHead } from "../shared/dom.js";
import { seconds } from "../shared/numbers.js";
import { t } from "../shared/text.js";
import { section } from "../panel/widgets/parts.js";

const HEADS = [t("No."), t("Seed"), t("End"), t("Decisions"), t("Time")];
/** @type {Record<string, string>} */
const WORDS = { goal: t("goal"), won: t("goal"), time: t("time is up"), fell: t("fell"), lost: t("lost"), mistake: t("mistake") };

/**
 * Return the sentence about a test.
 * @param {Pick<CodeTest, "rows" | "isOn">} test
 */
export function testWords({ rows, isOn }) {
  const ended = rows.filter(({ outcome }) => outcome);
  const goals = ended.filter(({ outcome }) => outcome === "goal").length;
  if (isOn) return t("{goals} of {ended} reached the goal so far.", { goals, ended: ended.length });
  if (goals === STARTS) {
    return t("{goals} of {starts} reached the goal, in {decisions} decisions on average.", { goals, starts: STARTS, decisions: Math.round(averageDecisions(rows)) });
  }
  const numbers = { goals, ended: ended.length, starts: STARTS };
  if (ended.length < STARTS) return t("{goals} of {ended} reached the goal; the test ended before all {starts}.", numbers);
  return t("{goals} of {ended} reached the goal.", numbers);
}

export class TestTable {
  #sentence = element("caption");
  #body = element("tbody");
  #hint = element("p", { className: "ai4u-hint-text", textContent: t("Click a row to try that start.") });
  #watch;
  element;

  /**
   * @param {(seed: number) => void} onChoose called with the seed of a start that is clicked
   * @param {() => void} onWatch called to show the first failure
   */
  constructor(onChoose, onWatch) {
    this.#watch = button(t("Watch the first failure"), onWatch, { icon: "play" });
    const table = element("table", { className: "ai4u-code-test" }, this.#sentence, tableHead(...HEADS), this.#body);
    this.#body.addEventListener("click", ({ target }) => {
      const row = /** @type {Element} */ (target).closest("tr"); // the button in it is for the keyboard
      if (row !== null) onChoose(Number(row.dataset.key));
    });
    this.element = section("code-test", t("Test"), {}, table, this.#watch, this.#hint);
    this.element.hidden = true;
  }

  /** @param {CodeTest} test */
  update(test) {
    const { rows, isOn, start, failure } = test;
    this.element.hidden = rows.length === 0;
    setText(this.#sentence, testWords(test));
    const shown = rows.map((row) => ({ ...row, isNow: isOn && row.number === start, isBegun: row.number <= start }));
    keyed(this.#body, shown, ({ seed }) => seed, makeRow, updateRow);
    this.#watch.hidden = isOn || failure === null;
    this.#hint.hidden = isOn;
  }
}

/** @param {Start} start */
function makeRow({ number, seed }) {
  const again = element("button", { type: "button", textContent: seed, title: t("Begin start {number}, seed {seed}", { number, seed }) });
  return element(
    "tr",
    {},
    element("th", { scope: "row", textContent: number }),
    element("td", {}, again),
    element("td"),
    element("td"),
    element("td"),
  );
}

/**
 * @param {HTMLElement} row
 * @param {Start & {isNow: boolean, isBegun: boolean}} start
 */
function updateRow(row, { outcome, decisions, seconds: time, isNow, isBegun }) {
  const [, , end, count, duration] = row.children;
  setAttributes(row, { "data-outcome": outcome || null, "aria-current": isNow ? "step" : null });
  setText(end, outcome ? (WORDS[outcome] ?? t("over")) : isNow ? "…" : "–");
  setText(count, isBegun ? String(decisions) : "–");
  setText(duration, isBegun ? seconds(time) : "–");
}
