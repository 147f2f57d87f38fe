/** The results of a test: a sentence, and a table of its starts. */

/** @import { CodeTest, Start } from "./test.js" */

import { averageDecisions, STARTS } from "./test.js";
import { button, element, keyed, setAttributes, setText, tableHead } from "../shared/dom.js";
import { seconds } from "../shared/numbers.js";
import { section } from "../panel/widgets/parts.js";

const HEADS = ["No.", "Seed", "End", "Decisions", "Time"];
/** @type {Record<string, string>} */
const WORDS = { goal: "goal", won: "goal", time: "time is up", fell: "fell", lost: "lost", mistake: "mistake" };

/**
 * Return the sentence about a test.
 * @param {Pick<CodeTest, "rows" | "isOn">} test
 */
export function testWords({ rows, isOn }) {
  const ended = rows.filter(({ outcome }) => outcome);
  const goals = ended.filter(({ outcome }) => outcome === "goal").length;
  if (isOn) return `${goals} of ${ended.length} reached the goal so far.`;
  if (goals === STARTS) {
    return `${goals} of ${STARTS} reached the goal, in ${Math.round(averageDecisions(rows))} decisions on average.`;
  }
  const rest = ended.length < STARTS ? `; the test ended before all ${STARTS}.` : ".";
  return `${goals} of ${ended.length} reached the goal${rest}`;
}

export class TestTable {
  #sentence = element("caption");
  #body = element("tbody");
  #hint = element("p", { className: "ai4u-hint-text", textContent: "Click a row to try that start." });
  #watch;
  element;

  /**
   * @param {(seed: number) => void} onChoose called with the seed of a start that is clicked
   * @param {() => void} onWatch called to show the first failure
   */
  constructor(onChoose, onWatch) {
    this.#watch = button("Watch the first failure", onWatch, { icon: "play" });
    const table = element("table", { className: "ai4u-code-test" }, this.#sentence, tableHead(...HEADS), this.#body);
    this.#body.addEventListener("click", ({ target }) => {
      const row = /** @type {Element} */ (target).closest("tr"); // the button in it is for the keyboard
      if (row !== null) onChoose(Number(row.dataset.key));
    });
    this.element = section("code-test", "Test", {}, table, this.#watch, this.#hint);
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
  const again = element("button", { type: "button", textContent: seed, title: `Begin start ${number}, seed ${seed}` });
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
  setText(end, outcome ? (WORDS[outcome] ?? "over") : isNow ? "…" : "–");
  setText(count, isBegun ? String(decisions) : "–");
  setText(duration, isBegun ? seconds(time) : "–");
}
