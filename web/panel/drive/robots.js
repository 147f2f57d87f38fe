/** All robots of the world, and the script that drives one of them. */

/** @import { AgentSummary, ScriptState } from "../../generated/messages.js" */
import { element, keyed, setText, tableHead } from "../../shared/dom.js";
import { number } from "../../shared/numbers.js";

const HEADS = ["Robot", "Decisions", "Score", "State"];
/**
 * Names of a script's counts.
 * @type {Record<string, string>}
 */
const COUNTS = {
  decisions: "actions carried out",
  missing: "decisions without an action in time",
  ignored: "messages that were no answer",
  refused: "actions that could not be carried out",
  clipped: "numbers out of range, cut",
  warnings: "replies without effect, or with parts that had none",
};

/** A table of the robots, with what each of them has done in its episode. */
export class RobotTable {
  #rows = element("tbody");
  element = element("table", { className: "ai4u-table" }, tableHead(...HEADS), this.#rows);

  /** @param {AgentSummary[]} robots */
  update(robots) {
    keyed(this.#rows, robots, ({ id }) => id, makeRow, (row, { title, colour, decision, score, state }) => {
      const [head, ...cells] = row.children;
      head.querySelector("i").style.background = colour;
      setText(head.lastChild, title);
      [String(decision), number(score), state].forEach((text, index) => setText(cells[index], text));
    });
  }
}

function makeRow() {
  const head = element("th", { scope: "row" }, element("i", { ariaHidden: "true" }), element("span"));
  return element("tr", {}, head, ...HEADS.slice(1).map(() => element("td")));
}

/**
 * Return the state of a script in words.
 * @param {ScriptState | null} script null if there is none
 */
export function scriptWords(script) {
  if (!script) return "";
  const counts = Object.entries(script.counts).map(([name, count]) => `${count} ${COUNTS[name] ?? name}`);
  return [`Script: ${script.state}`, script.reason, ...counts].filter(Boolean).join(" · ");
}

/**
 * Return what a script sends that has no effect, or why it is lost: also for people without an interest in its counts.
 * @param {ScriptState | null} script null if there is none
 */
export function scriptWarning(script) {
  if (!script) return "";
  return script.warning || (script.state === "lost" ? script.reason : "");
}
