/** A person's results: the time of an episode that reached the goal, and the best times in this browser. */

/** @import { NetworkRace, StateEvent } from "../generated/messages.js" */
import { roomOfPage } from "../shared/room.js";
import { recall, remember } from "../shared/storage.js";
import { t } from "../shared/text.js";

export const WINS = ["goal", "won"];
/** Drivers whose times are kept apart. */
export const KEYS = "keys";
export const PROGRAM = "program";
export const NETWORK = "network";
/** Kinds of a time, compared with the best one before. */
export const FIRST = "first";
export const BEST = "best";
export const SLOWER = "slower";

/** @typedef {{seconds: number, best: number, kind: string, by: string}} Result */

export class Results {
  #episode = "";
  /** @type {Result | null} */
  #result = null;

  /**
   * Return the result of the episode that has just ended, or null.
   *
   * @param {StateEvent | null} state the server's last one; null while disconnected
   * @param {string} task what is driven, such as the scene's name
   * @param {string} by KEYS, PROGRAM or NETWORK: what drives; empty for others, whose results are not kept
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
   * @param {string} by KEYS, PROGRAM or NETWORK
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
    if (isBetter) remember(key(), { ...recall(key(), {}), [task]: { ...times, [by]: seconds } });
    const kind = before === undefined ? FIRST : isBetter ? BEST : SLOWER;
    return { seconds, best: isBetter ? seconds : before, kind, by };
  }
}

/**
 * Return the best times (s) for a task by driver. Earlier versions kept one number, of whoever drove.
 * @param {string} task
 * @returns {Record<string, number>}
 */
export function timesOf(task) {
  const times = recall(key(), {})[task];
  return typeof times === "object" ? times : {};
}

/**
 * Return the best times for a task as a text: "Best: you 12.3 s · your program 9.0 s"; empty without any.
 * @param {string} task
 */
export function timesText(task) {
  const times = timesOf(task);
  const parts = [];
  if (typeof times[KEYS] === "number") parts.push(t("you {time} s", { time: format(times[KEYS]) }));
  if (typeof times[PROGRAM] === "number") parts.push(t("your program {time} s", { time: format(times[PROGRAM]) }));
  return parts.length ? t("Best: {times}", { times: parts.join(" · ") }) : "";
}

/** Return true if a person has won by keys before, in any scene. */
export function hasWon() {
  return Object.values(recall(key(), {})).some((times) => typeof times?.[KEYS] === "number");
}

/**
 * Return a result as the end of a sentence: " 2.3 s – your best".
 * @param {Result} result
 */
export function timeText({ seconds, best, kind, by }) {
  const values = { time: format(seconds), best: format(best) };
  // a network's is the same each time, from the same start
  if (by === NETWORK || (kind !== BEST && kind !== SLOWER)) return ` ${values.time} s`;
  if (kind === BEST) return " " + (by === PROGRAM ? t("{time} s – your program's best", values) : t("{time} s – your best", values));
  return " " + (by === PROGRAM ? t("{time} s (your program's best: {best} s)", values) : t("{time} s (your best: {best} s)", values));
}

/** Difference of two times (s) that counts as none. */
const SAME_S = 0.05;

/**
 * Return how a race against a ghost ended, in a sentence.
 * @param {NetworkRace} race
 * @param {StateEvent} state of an episode that is over: a person's, or that of a network against a person's ghost
 */
export function raceText(race, state) {
  const text = endText(race, state);
  if (race.full_speed_s >= race.seconds) return text;
  return [text, t("At full speed it needs {time} s.", { time: format(race.full_speed_s) })].join(" ");
}

/**
 * Return how much the ghost of a network is slowed, in a sentence; empty if it is not.
 * @param {NetworkRace} race
 */
export function slowedText({ full_speed_s: full, seconds }) {
  if (full >= seconds) return "";
  return t("So that keys can win, the network is slowed down: it takes {slow} s in place of {fast} s.", { slow: format(seconds), fast: format(full) });
}

/**
 * @param {NetworkRace} race
 * @param {StateEvent} state
 */
function endText({ ghost, is_won: ghostHasWon, seconds, score }, state) {
  const isMine = ghost === "network";
  if (ghostHasWon === null) return scoreText(isMine, score, state.reward ?? 0);
  const hasWon = WINS.includes(state.outcome);
  const time = format(seconds);
  if (hasWon && ghostHasWon) {
    const ahead = (isMine ? 1 : -1) * (seconds - state.seconds);
    if (Math.abs(ahead) < SAME_S) return isMine ? t("As fast as the network!") : t("As fast as your drive!");
    if (ahead > 0) return t("You beat it by {time} s!", { time: format(ahead) });
    return isMine ? t("The network was {time} s faster.", { time: format(-ahead) }) : t("It beat your drive by {time} s.", { time: format(-ahead) });
  }
  if (hasWon) return isMine ? t("You beat it: the network did not get there.") : t("It beat your drive, which did not get there.");
  if (ghostHasWon) return isMine ? t("The network got there in {time} s.", { time }) : t("You beat it: you got there in {time} s!", { time });
  return isMine ? t("The network did not get there either.") : t("Your drive did not get there either.");
}

/**
 * @param {boolean} isMine true if a person raced against the network's ghost
 * @param {number} ghosts score of the ghost
 * @param {number} drivers score of the driver
 */
function scoreText(isMine, ghosts, drivers) {
  const [mine, its] = isMine ? [drivers, ghosts] : [ghosts, drivers];
  const scores = { mine: format(mine), its: format(its) };
  return mine > its ? t("You beat it: {mine} points, the network {its}.", scores) : t("You: {mine} points, the network {its}.", scores);
}

/** Students of a class may use one device in turn. */
function key() {
  const room = roomOfPage();
  return room ? `best-times-${room}` : "best-times";
}

/** @param {number} seconds */
function format(seconds) {
  return seconds.toLocaleString(undefined, { minimumFractionDigits: 1, maximumFractionDigits: 1 });
}
