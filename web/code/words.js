/** The line about a run of a program, in words. */

const LOADING = "Getting Python ready (first time only) …";

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
  if (phase === "joining") return line("busy", "The program gets the robot …");
  if (phase === "testing" && isPaused) return line("busy", "The world is paused", startWords(start));
  if (phase === "testing") return line("on", "Tests the program", startWords(start));
  if (phase === "running" && isPerson) return line("busy", "You're driving. Press Let go to give the robot back to your program.");
  if (phase === "running" && isPaused) return line("busy", "The world is paused", `decision ${decision}`);
  if (phase === "running") return line("on", "Runs", `decision ${decision}`);
  if (phase === "waiting") return line("on", `Waits at line ${waitsAt}`, `decision ${decision}`);
  if (phase === "stepping") return line("on", "Waits for the next step", `decision ${decision}`);
  if (end !== null) return endWords(end, decision, success, isPaused);
  if (python === "loading") return line("off", LOADING);
  return python === "ready" ? line("off", "Ready") : line("bad", python);
}

/** @param {number} start */
function startWords(start) {
  return start ? `start ${start}` : "";
}

/**
 * @param {RunEnd & {summary?: string, outcome?: string}} end
 * @param {number} decision
 * @param {string} success
 * @param {boolean} isPaused
 */
function endWords({ reason, percept, line: number, summary, outcome }, decision, success, isPaused) {
  const at = decision ? ` at decision ${decision}` : "";
  if (reason === "tested") return line("done", summary);
  if (reason === "stopped") return line("off", `Stopped${at}; the robot is yours`);
  if (reason === "mistake") {
    const place = number === null ? "your program" : `line ${number}`;
    return line("bad", `Stopped: there's a mistake in ${place}.${isPaused ? " The world waits." : ""}`);
  }
  if (reason === "lost") return line("bad", `The run ended${at}`);
  const isGoal = Boolean(success && percept.terms?.[success] > 0);
  if (isGoal) return line("done", `Goal reached! Your program decided ${decision} ${decision === 1 ? "time" : "times"}.`);
  const what = outcome === "fell" ? "The robot fell" : percept.truncated ? "Time is up" : "The episode ended";
  return line("off", `${what}, after ${decision} ${decision === 1 ? "decision" : "decisions"}.`);
}

/**
 * @param {string} kind
 * @param {string} text
 */
function line(kind, text, count = "") {
  return { kind, text, count };
}
