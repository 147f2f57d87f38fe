/** All robots of the world, and the script that drives one of them. */

/** @import { AgentSummary, ScriptState } from "../../generated/messages.js" */
import { element, keyed, setText, tableHead } from "../../shared/dom.js";
import { number } from "../../shared/numbers.js";
import { t, tn } from "../../shared/text.js";

const HEADS = [t("Robot"), t("Decisions"), t("Score"), t("State")];
/**
 * A script's counts in words.
 * @type {Record<string, (count: number) => string>}
 */
const COUNTS = {
  decisions: (count) => tn("{n} action carried out", "{n} actions carried out", count),
  missing: (count) => tn("{n} decision without an action in time", "{n} decisions without an action in time", count),
  ignored: (count) => tn("{n} message that was no answer", "{n} messages that were no answer", count),
  refused: (count) => tn("{n} action that could not be carried out", "{n} actions that could not be carried out", count),
  clipped: clippedWords,
  warnings: (count) =>
    tn("{n} reply without effect, or with parts that had none", "{n} replies without effect, or with parts that had none", count),
};

/** @type {Record<string, string>} */
const STATES = {
  waiting: t("Script: waiting"),
  connected: t("Script: connected"),
  late: t("Script: late"),
  lost: t("Script: lost"),
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

/** @param {number} count of numbers of an agent's actions that were out of range */
export function clippedWords(count) {
  return tn("{n} number out of range, cut", "{n} numbers out of range, cut", count);
}

/**
 * Return the state of a script in words.
 * @param {ScriptState | null} script null if there is none
 */
export function scriptWords(script) {
  if (!script) return "";
  const counts = Object.entries(script.counts).map(([name, count]) => COUNTS[name]?.(count) ?? `${count} ${name}`);
  return [STATES[script.state], script.reason, ...counts].filter(Boolean).join(" · ");
}

/**
 * Return what a script sends that has no effect, or why it is lost: also for people without an interest in its counts.
 * @param {ScriptState | null} script null if there is none
 */
export function scriptWarning(script) {
  if (!script) return "";
  return script.warning || (script.state === "lost" ? script.reason : "");
}
