/** The line about a run of a program, in words. */

import { t, tn } from "../shared/text.js";

const LOADING = t("Getting Python ready (first time only) …");

/** @import { RunEnd } from "./run.js" */

/**
 * Return {kind, text, count}: kind is "off", "busy", "on", "done" or "bad"; count changes too often to be announced.
 * @param {object} run
 * @param {string} run.phase as of CodeRun
 * @param {number | null} [run.waitsAt] line of the breakpoint at which the program waits
 * @param {number} run.decision number of the latest one
 * @param {number} run.start the number of the start that is tested
 * @param {string} run.success the world's word for reaching the goal
 * @param {boolean} run.isPerson true while the person drives in the program's place
 * @param {boolean} run.isPaused true while the world is paused
 * @param {string} run.python "loading", "ready", or a sentence about what went wrong
 * @param {(RunEnd & {summary?: string, outcome?: string}) | null} run.end null while there is none; of a test it has a summary, and
 *   of an episode the world's word for its end, such as "fell"
 */
export function runWords({ phase, waitsAt = null, decision, start, success, isPerson, isPaused, python, end }) {
  if (phase === "loading") return line("busy", LOADING);
  if (phase === "joining") return line("busy", t("The program gets the robot …"));
  if (phase === "testing" && isPaused) return line("busy", t("The world is paused"), startWords(start));
  if (phase === "testing") return line("on", t("Tests the program"), startWords(start));
  if (phase === "running" && isPerson) return line("busy", t("You're driving. Press Let go to give the robot back to your program."));
  if (phase === "running" && isPaused) return line("busy", t("The world is paused"), t("decision {decision}", { decision }));
  if (phase === "running") return line("on", t("Runs"), t("decision {decision}", { decision }));
  if (phase === "waiting") return line("on", t("Waits at line {line}", { line: waitsAt }), t("decision {decision}", { decision }));
  if (phase === "stepping") return line("on", t("Waits for the next step"), t("decision {decision}", { decision }));
  if (end !== null) return endWords(end, decision, success, isPaused);
  if (python === "loading") return line("off", LOADING);
  return python === "ready" ? line("off", t("Ready")) : line("bad", python);
}

/** @param {number} start */
function startWords(start) {
  return start ? t("start {number}", { number: start }) : "";
}

/**
 * @param {RunEnd & {summary?: string, outcome?: string}} end
 * @param {number} decision
 * @param {string} success
 * @param {boolean} isPaused
 */
function endWords({ reason, percept, line: number, summary, outcome }, decision, success, isPaused) {
  if (reason === "tested") return line("done", summary);
  if (reason === "stopped") return line("off", decision ? t("Stopped at decision {decision}; the robot is yours", { decision }) : t("Stopped; the robot is yours"));
  if (reason === "mistake") {
    const where = number === null ? t("Stopped: there's a mistake in your program.") : t("Stopped: there's a mistake in line {number}.", { number });
    return line("bad", [where, isPaused && t("The world waits.")].filter(Boolean).join(" "));
  }
  if (reason === "lost") return line("bad", decision ? t("The run ended at decision {decision}", { decision }) : t("The run ended"));
  const isGoal = Boolean(success && percept.terms?.[success] > 0);
  if (isGoal) return line("done", tn("Goal reached! Your program decided {n} time.", "Goal reached! Your program decided {n} times.", decision));
  if (outcome === "fell") return line("off", tn("The robot fell, after {n} decision.", "The robot fell, after {n} decisions.", decision));
  if (percept.truncated) return line("off", tn("Time is up, after {n} decision.", "Time is up, after {n} decisions.", decision));
  return line("off", tn("The episode ended, after {n} decision.", "The episode ended, after {n} decisions.", decision));
}

/**
 * @param {string} kind
 * @param {string} text
 */
function line(kind, text, count = "") {
  return { kind, text, count };
}
