/** A room's card on the wall: who is in it, how it goes, and an empty area that the wall's canvas shows through. */

/** @import { ClassState, Room, Seat } from "../../types/class.js" */
/** @import { Names } from "./wall.js" */

import { element, setAttributes, setText } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";
import { needsHelp, placeText, roomName, seatsOf, statusOf } from "../room_words.js";

const MAX_DOTS = 8;
const MAX_COLOUR_DOTS = 3;

/**
 * Return a card.
 * @param {Room} room
 * @param {((room: string) => void) | null} onOpen called with the room's id when a person chooses it; null for a card that can't be
 *   chosen
 */
export function roomCard(room, onOpen) {
  const parts = [
    element(
      "span",
      { className: "ai4u-room-head" },
      element("span", { className: "ai4u-room-dots" }),
      element("span", { className: "ai4u-room-name" }),
      element("span", { className: "ai4u-room-real" }),
      element("span", { className: "ai4u-room-status" }, element("span"), element("span")),
    ),
    element("span", { className: "ai4u-room-picture" }, element("span", { className: "ai4u-room-why" })),
    element(
      "span",
      { className: "ai4u-room-foot" },
      element("span", { className: "ai4u-room-scene" }),
      element("span", { className: "ai4u-room-progress" }),
    ),
  ];
  if (!onOpen) return element("li", {}, element("div", { className: "ai4u-room" }, ...parts));
  const open = element("button", { type: "button", className: "ai4u-room" }, ...parts);
  open.addEventListener("click", () => onOpen(room.id));
  return element("li", {}, open);
}

/**
 * Bring a card up to date.
 * @param {Element} card
 * @param {Room} room
 * @param {ClassState} state
 * @param {Names} realNames
 */
export function updateCard(card, room, state, realNames) {
  const box = card.firstElementChild;
  /** @type {(name: string) => HTMLElement} */
  const part = (name) => box.querySelector(`.ai4u-room-${name}`);
  const seats = seatsOf(room, state);
  const status = statusOf(room);
  const name = roomName(room, state);
  const real = seats.map((seat) => realNames.of(seat)).filter(Boolean).join(", ");
  const why = (needsHelp(room) || room.status === "error") && room.why ? room.why : "";
  showColours(part("dots"), seats);
  setText(part("name"), name);
  setText(part("real"), real);
  setText(part("status").firstElementChild, status.sign);
  setText(part("status").lastElementChild, status.text);
  setText(part("why"), why);
  const mission = missionOf(seats, state);
  setText(part("scene"), [mission, room.learning, room.scene].filter(Boolean).join(" · "));
  const dots = progressOf(seats, state);
  showProgress(part("progress"), dots);
  setAttributes(box, { "data-status": room.status, "data-help": needsHelp(room), "data-solved": room.is_solved });
  if (box.localName !== "button") return;
  const solved = dots.filter((each) => each.state === "solved").length;
  const progress = dots.length ? exercisesText(solved, dots.length, dots[0].lesson) : "";
  const told = [name, real, status.text, room.is_solved && room.status !== "solved" && t("solved before"), why, mission, room.scene, room.learning, progress];
  setAttributes(box, { "aria-label": told.filter(Boolean).join(", ") });
}

/**
 * @param {number} solved
 * @param {number} count of the lesson
 * @param {string} lesson
 */
function exercisesText(solved, count, lesson) {
  const values = { solved, lesson };
  return tn("{solved} of {n} exercise of lesson {lesson} solved", "{solved} of {n} exercises of lesson {lesson} solved", count, values);
}

/**
 * @param {HTMLElement} place
 * @param {Seat[]} seats
 */
function showColours(place, seats) {
  const colours = seats.slice(0, MAX_COLOUR_DOTS).map((seat) => seat.colour);
  if (place.dataset.colours === colours.join()) return;
  place.dataset.colours = colours.join();
  place.replaceChildren(
    ...colours.map((colour) => {
      const dot = element("span");
      dot.style.background = colour;
      return dot;
    }),
  );
}

/**
 * Return the missions that these seats are at, with their steps; empty if they are at none.
 * @param {Seat[]} seats
 * @param {ClassState} state
 */
function missionOf(seats, state) {
  const places = seats.map((seat) => state.mission_places?.[seat.number]).filter(Boolean);
  return [...new Set(places.map(placeText))].join(", ");
}

/** @typedef {{lesson: string, id: string, state: string}} Exercise */

/**
 * Return the exercises of the last lesson that somebody of these seats has begun.
 * @param {Seat[]} seats
 * @param {ClassState} state
 * @returns {Exercise[]}
 */
function progressOf(seats, state) {
  /** @type {Record<string, string>} */
  const found = {};
  for (const seat of seats) {
    for (const [id, { state: reached }] of Object.entries(state.progress?.[seat.number] ?? {})) {
      if (found[id] !== "solved") found[id] = reached;
    }
  }
  const lesson = (state.exercises ?? []).findLast((each) => each.ids.some((id) => id in found));
  return (lesson?.ids ?? []).map((id) => ({ lesson: lesson.lesson, id, state: found[id] ?? "" }));
}

/**
 * @param {HTMLElement} place
 * @param {Exercise[]} dots
 */
function showProgress(place, dots) {
  const told = dots.map((each) => each.state || "none").join(" ");
  if (place.dataset.told === told) return;
  place.dataset.told = told;
  place.replaceChildren(
    ...dots.slice(0, MAX_DOTS).map((each) => element("span", { dataset: { state: each.state || "none" } })),
  );
}
