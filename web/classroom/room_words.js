/** Words for rooms: of their people, their status, and what they need. */

/** @import { ClassState, MissionPlace, Room } from "../types/class.js" */

/** From this need of help (0 to 100, see help_score.py) on, a card is marked. */
const MIN_HELP = 30;

/**
 * Words and a sign by status; a sign differs in shape, not only in color.
 * @type {Record<string, {text: string, sign: string}>}
 */
const STATUSES = {
  waiting: { text: "not started", sign: "○" },
  driving: { text: "driving", sign: "▶" },
  solved: { text: "solved", sign: "✓" },
  fell: { text: "fell", sign: "↓" },
  over: { text: "ended", sign: "■" },
  idle: { text: "idle", sign: "–" },
  paused: { text: "paused", sign: "Ⅱ" },
  error: { text: "error", sign: "!" },
  mistake: { text: "program stopped", sign: "!" },
  asleep: { text: "asleep", sign: "☾" },
  away: { text: "not connected", sign: "×" },
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
  if (names.length === 0) return "Empty room";
  return names.length > 2 ? `${names[0]} and ${names.length - 1} others` : names.join(" and ");
}

/**
 * Return where a seat is in its mission, such as "First drive 2/4".
 * @param {MissionPlace} place
 */
export function placeText({ title, step, steps, is_done: isDone }) {
  return isDone && step === steps - 1 ? `${title} ✓` : `${title} ${step + 1}/${steps}`;
}

/**
 * Return a count with its noun: "1 fall", "6 falls".
 * @param {number} count
 * @param {string} noun
 */
export function counted(count, noun) {
  return `${count} ${noun}${count === 1 ? "" : "s"}`;
}
