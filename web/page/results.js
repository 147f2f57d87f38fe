/** A person's results: the time of an episode that reached the goal, and the best times in this browser. */

/** @import { StateEvent } from "../generated/messages.js" */
import { recall, remember } from "../shared/storage.js";

const WINS = ["goal", "won"];
/** Drivers whose times are kept apart. */
export const KEYS = "keys";
export const PROGRAM = "program";
/** Kinds of a time, compared with the best one before. */
export const FIRST = "first";
export const BEST = "best";
export const SLOWER = "slower";

/** @typedef {{seconds: number, best: number, kind: string, by: string}} Result */

export class Results {
  #episode = "";
  /** @type {Result | null} */
  #result = null;
  #onwin;

  /** @param {() => void} onwin called once for each episode that a person won */
  constructor(onwin) {
    this.#onwin = onwin;
  }

  /**
   * Return the result of the episode that has just ended, or null.
   *
   * @param {StateEvent | null} state the server's last one; null while disconnected
   * @param {string} task what is driven, such as the scene's name
   * @param {string} by KEYS or PROGRAM: what drives; empty for others, whose results are not kept
   */
  of(state, task, by) {
    if (!state?.outcome || state.past) {
      if (state && !state.past) this.#episode = "";
      return null;
    }
    const episode = `${state.title} ${state.episode}`;
    if (episode !== this.#episode) {
      this.#episode = episode;
      this.#result = by && WINS.includes(state.outcome) ? this.#record(state.seconds, task, by) : null;
    }
    return this.#result;
  }

  /**
   * Return the best time (s) of a driver; null if there is none.
   * @param {string} task what is driven
   * @param {string} by KEYS or PROGRAM
   */
  best(task, by) {
    return timesOf(task)[by] ?? null;
  }

  /**
   * @param {number} seconds
   * @param {string} task
   * @param {string} by
   */
  #record(seconds, task, by) {
    const times = timesOf(task);
    const before = times[by];
    const isBetter = before === undefined || seconds < before;
    if (isBetter) remember("best-times", { ...recall("best-times", {}), [task]: { ...times, [by]: seconds } });
    this.#onwin();
    const kind = before === undefined ? FIRST : isBetter ? BEST : SLOWER;
    return { seconds, best: isBetter ? seconds : before, kind, by };
  }
}

/**
 * Return the best times for a task by driver. Earlier versions kept one number, of whoever drove.
 * @param {string} task
 * @returns {Record<string, number>}
 */
function timesOf(task) {
  const times = recall("best-times", {})[task];
  return typeof times === "object" ? times : {};
}

/**
 * Return a result as the end of a sentence: " in 2.3 s, your best".
 * @param {Result} result
 */
export function timeText({ seconds, best, kind, by }) {
  const [time, whose] = [` in ${format(seconds)} s`, by === PROGRAM ? "your program's best" : "your best"];
  if (kind === BEST) return `${time}, ${whose}`;
  return kind === SLOWER ? `${time} (${whose}: ${format(best)} s)` : time;
}

/** @param {number} seconds */
function format(seconds) {
  return seconds.toLocaleString(undefined, { minimumFractionDigits: 1, maximumFractionDigits: 1 });
}
