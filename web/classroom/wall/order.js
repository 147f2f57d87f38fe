/** Choice and order of the rooms on a wall. */

/** @import { Room } from "../../types/class.js" */

import { needsHelp } from "../room_words.js";
import { t } from "../../shared/text.js";

/** Needs of help that differ by less count as the same, so that cards don't change places all the time. */
const HELP_STEP = 10;
/** Share of the largest width of cards with which they keep their places, such as when a strip appears above them. */
const KEPT_SHARE = 0.6;

/** @type {Record<string, {text: string, keeps: (room: Room) => boolean}>} */
export const FILTERS = {
  all: { text: t("All rooms"), keeps: () => true },
  help: { text: t("Needs help"), keeps: needsHelp },
  driving: { text: t("Driving"), keeps: (room) => room.status === "driving" },
  solved: { text: t("Rooms that solved it"), keeps: (room) => room.is_solved },
  asleep: { text: t("Asleep"), keeps: (room) => room.status === "asleep" || room.status === "away" },
};

/**
 * Return rooms in the wall's order.
 * @param {Room[]} rooms
 * @param {string} by "help" or "name"
 * @param {(room: Room) => string} nameOf
 * @param {string[] | null} held ids of rooms in an order to keep; others follow
 */
export function ordered(rooms, by, nameOf, held) {
  const names = new Map(rooms.map((room) => [room.id, nameOf(room)]));
  const byName = (/** @type {Room} */ a, /** @type {Room} */ b) => names.get(a.id).localeCompare(names.get(b.id)) || a.id.localeCompare(b.id);
  const need = (/** @type {Room} */ room) => Math.round((room.help ?? 0) / HELP_STEP);
  const sorted = [...rooms].sort((a, b) => (by === "help" && need(b) - need(a)) || byName(a, b));
  if (!held) return sorted;
  const places = new Map(held.map((id, index) => [id, index]));
  const place = (/** @type {Room} */ room) => places.get(room.id) ?? held.length;
  return sorted.sort((a, b) => place(a) - place(b));
}

/**
 * Return columns and width of cards: the largest ones of which all fit into a width and a height.
 * @param {number} count number of cards
 * @param {number} width
 * @param {number} height
 * @param {number} gap
 * @param {{minWidth: number, heightOf: (width: number) => number, widthOf: (height: number) => number}} card least width, and
 *   height and width from each other, without the gap
 * @param {number} [kept] number of columns to keep if cards become little smaller by that; 0 for none
 */
export function fitting(count, width, height, gap, { minWidth, heightOf, widthOf }, kept = 0) {
  const most = Math.max(1, Math.floor((width + gap) / (minWidth + gap)));
  let best = { columns: most, cardWidth: 0 };
  let same = best;
  for (let columns = 1; columns <= most; columns += 1) {
    const widest = (width - gap * (columns - 1)) / columns;
    const rowHeight = (height + gap) / Math.ceil(count / columns) - gap;
    const cardWidth = heightOf(widest) <= rowHeight ? widest : widthOf(rowHeight);
    if (cardWidth > best.cardWidth) best = { columns, cardWidth };
    if (columns === kept) same = { columns, cardWidth };
  }
  if (same.cardWidth >= Math.max(minWidth, KEPT_SHARE * best.cardWidth)) return same;
  // they don't fit: as many columns as possible, and the page scrolls
  return best.cardWidth < minWidth ? { columns: most, cardWidth: (width - gap * (most - 1)) / most } : best;
}
