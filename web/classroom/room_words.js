/** Words for rooms: of their people, their status, and what they need. */

/** @import { ClassState, MissionPlace, Room } from "../types/class.js" */

import { t, tn } from "../shared/text.js";

/** From this need of help (0 to 100, see help_score.py) on, a card is marked. */
const MIN_HELP = 30;

/**
 * Words and a sign by status; a sign differs in shape, not only in color.
 * @type {Record<string, {text: string, sign: string}>}
 */
const STATUSES = {
  waiting: { text: t("not started"), sign: "○" },
  driving: { text: t("driving"), sign: "▶" },
  solved: { text: t("solved"), sign: "✓" },
  fell: { text: t("fell"), sign: "↓" },
  over: { text: t("ended"), sign: "■" },
  idle: { text: t("idle"), sign: "–" },
  paused: { text: t("paused"), sign: "Ⅱ" },
  error: { text: t("error"), sign: "!" },
  mistake: { text: t("program stopped"), sign: "!" },
  asleep: { text: t("asleep"), sign: "☾" },
  away: { text: t("not connected"), sign: "×" },
};

/** @param {Room} room */
export function statusOf(room) {
  return STATUSES[room.status] ?? { text: room.status, sign: "" };
}

/** @param {Room} room */
export function needsHelp(room) {
  return (room.help ?? 0) >= MIN_HELP;
}

/**
 * Return the seats of a room that are in the class.
 * @param {Room} room
 * @param {ClassState} state
 */
export function seatsOf(room, state) {
  return state.seats.filter((seat) => room.seats.includes(seat.number) && seat.state === "in");
}

/**
 * Return the names of a room's seats, such as "Red Fox and Calm Owl".
 * @param {Room} room
 * @param {ClassState} state
 */
export function roomName(room, state) {
  const names = seatsOf(room, state).map((seat) => seat.name);
  if (names.length === 0) return t("Empty room");
  const [name, other] = names;
  if (names.length === 2) return t("{name} and {other}", { name, other });
  return names.length === 1 ? name : tn("{name} and {n} other", "{name} and {n} others", names.length - 1, { name });
}

/**
 * Return where a seat is in its mission, such as "First drive 2/4".
 * @param {MissionPlace} place
 */
export function placeText({ title, step, steps, is_done: isDone }) {
  return isDone && step === steps - 1 ? `${title} ✓` : `${title} ${step + 1}/${steps}`;
}
