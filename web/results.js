/** A person's results: the time of an episode that reached the goal, and the best time for the scene in this browser. */

import { recall, remember } from "./storage.js";

const WINS = ["goal", "won"];
/** Kinds of a time, compared with the best one before. */
export const FIRST = "first";
export const BEST = "best";
export const SLOWER = "slower";

export class Results {
  #episode = "";
  #result = null;
  #onwin;

  /** @param {() => void} onwin called once for each episode that a person won */
  constructor(onwin) {
    this.#onwin = onwin;
  }

  /**
   * Return the result of the episode that has just ended, or null.
   *
   * @param state the server's last state message; null while disconnected
   * @param {boolean} isDriven whether this page drives the agent: other results are not kept
   * @returns {?{seconds: number, best: number, kind: string}}
   */
  of(state, isDriven) {
    if (!state?.outcome || state.past) {
      if (state && !state.past) this.#episode = "";
      return null;
    }
    const episode = `${state.title} ${state.episode}`;
    if (episode !== this.#episode) {
      this.#episode = episode;
      this.#result = isDriven && WINS.includes(state.outcome) ? this.#record(state) : null;
    }
    return this.#result;
  }

  #record({ title, seconds }) {
    const times = recall("best-times", {});
    const before = times[title];
    const isBetter = before === undefined || seconds < before;
    if (isBetter) remember("best-times", { ...times, [title]: seconds });
    this.#onwin();
    const kind = before === undefined ? FIRST : isBetter ? BEST : SLOWER;
    return { seconds, best: isBetter ? seconds : before, kind };
  }
}

/** Return a result as the end of a sentence: " in 2.3 s, your best". */
export function timeText({ seconds, best, kind }) {
  const time = ` in ${format(seconds)} s`;
  if (kind === BEST) return `${time}, your best`;
  return kind === SLOWER ? `${time} (your best: ${format(best)} s)` : time;
}

function format(seconds) {
  return seconds.toLocaleString(undefined, { minimumFractionDigits: 1, maximumFractionDigits: 1 });
}
