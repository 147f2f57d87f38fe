/** The line about a run of a program, in words. */

/** Size of Python's files, which are loaded once (MB). */
const PYTHON_MB = 13;

/** @import { RunEnd } from "./run.js" */

/**
 * Return {kind, text, count}: kind is "off", "busy", "on", "done" or "bad"; count changes too often to be announced.
 * @param {object} run
 * @param {string} run.phase as of CodeRun
 * @param {number} run.decision number of the latest one
 * @param {number} run.start the number of the start that is tested
 * @param {string} run.success the world's word for reaching the goal
 * @param {boolean} run.isPerson true while the person drives in the program's place
 * @param {boolean} run.isPaused true while the world is paused
 * @param {string} run.python "loading", "ready", or a sentence about what went wrong
 * @param {(RunEnd & {summary?: string}) | null} run.end null while there is none; of a test it has a summary
 */
export function runWords({ phase, decision, start, success, isPerson, isPaused, python, end }) {
  if (phase === "loading") return line("busy", `Loading Python, once (${PYTHON_MB} MB) …`);
  if (phase === "joining") return line("busy", "The program gets the robot …");
  if (phase === "testing" && isPaused) return line("busy", "The world is paused", startWords(start));
  if (phase === "testing") return line("on", "Tests the program", startWords(start));
  if (phase === "running" && isPerson) return line("busy", "You drive; let go, and the program goes on");
  if (phase === "running" && isPaused) return line("busy", "The world is paused", `decision ${decision}`);
  if (phase === "running") return line("on", "Runs", `decision ${decision}`);
  if (phase === "stepping") return line("on", "Waits for the next step", `decision ${decision}`);
  if (end !== null) return endWords(end, decision, success);
  if (python === "loading") return line("off", `Loading Python, once (${PYTHON_MB} MB) …`);
  return python === "ready" ? line("off", "Ready") : line("bad", python);
}

/** @param {number} start */
function startWords(start) {
  return start ? `start ${start}` : "";
}

/**
 * @param {RunEnd & {summary?: string}} end
 * @param {number} decision
 * @param {string} success
 */
function endWords({ reason, percept, line: number, summary }, decision, success) {
  const at = decision ? ` at decision ${decision}` : "";
  if (reason === "tested") return line("done", summary);
  if (reason === "stopped") return line("off", `Stopped${at}; the robot is yours`);
  if (reason === "mistake") return line("bad", number === null ? `A mistake ended it${at}` : `A mistake in line ${number} ended it`);
  if (reason === "lost") return line("bad", `The run ended${at}`);
  const isGoal = Boolean(success && percept.terms?.[success] > 0);
  return line(isGoal ? "done" : "off", `${isGoal ? "Goal reached" : "The episode is over"}${at}`);
}

/**
 * @param {string} kind
 * @param {string} text
 */
function line(kind, text, count = "") {
  return { kind, text, count };
}
