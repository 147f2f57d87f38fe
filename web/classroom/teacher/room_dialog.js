/** The dialog of one room: how it goes, and what the teacher can do about it. */

/** @import { ClassState, Room, Seat } from "../../types/class.js" */
/** @import { Command } from "./command.js" */
/** @import { RealNames } from "./real_names.js" */

import { clock } from "../../shared/numbers.js";
import { showAssign } from "./assign_dialog.js";
import { command, commandOrTell } from "./command.js";
import { element } from "../../shared/dom.js";
import { choices, chosenIn, closeDialogOf, showForm } from "../../shared/form_dialog.js";
import { showForget } from "./forget_dialog.js";
import { showMoveCode } from "./move_code_dialog.js";
import { ask, tell } from "../../shared/dialog.js";
import { t, tn } from "../../shared/text.js";
import { showNetworks } from "./room_networks.js";
import { showPrograms } from "./room_programs.js";
import { placeText, roomName, seatsOf, statusOf } from "../room_words.js";

/**
 * @param {Room} room
 * @param {ClassState} state
 * @param {RealNames} realNames
 */
export function showRoom(room, state, realNames) {
  const seats = seatsOf(room, state);
  const isLocal = room.kind !== "remote";
  const act = (/** @type {string} */ text, /** @type {Command} */ wanted) =>
    action(text, async (button) => {
      closeDialogOf(button);
      await commandOrTell(wanted);
    });
  const assign = action(t("Assign a scene…"), (button) => {
    closeDialogOf(button);
    showAssign(state, room.id);
  });
  const code = action(t("Code"), (button) => {
    closeDialogOf(button);
    showPrograms(room, state);
  });
  const networks = action(t("Networks"), (button) => {
    closeDialogOf(button);
    showNetworks(room, state);
  });
  const lookIn = element("a", { className: "ai4u-button", href: room.look_in, target: "_blank", rel: "noopener", textContent: t("Look in") });
  const actions = element(
    "div",
    { className: "ai4u-actions" },
    room.look_in && lookIn,
    isLocal && code,
    isLocal && networks,
    act(t("Show to all"), { do: "show", kind: "room", room: room.id }),
    assign,
    room.is_learning && act(t("Stop learning"), { do: "stop training", room: room.id }),
    isLocal && room.is_running && act(t("Put to sleep"), { do: "sleep", room: room.id }),
  );
  const content = [
    facts(room, missionsOf(seats, state)),
    room.error && element("pre", { className: "ai4u-error", tabIndex: 0, "aria-label": t("Error"), textContent: room.error }),
    actions,
    element("ul", { className: "ai4u-people" }, ...seats.map((seat) => person(seat, realNames, Boolean(state.code)))),
  ];
  return showForm({ title: roomName(room, state), content, no: t("Close") });
}

/**
 * Return where the seats of a room are in their missions; empty if they are in none.
 * @param {Seat[]} seats
 * @param {ClassState} state
 */
function missionsOf(seats, state) {
  const lines = seats.map(({ name, number }) => {
    const place = state.mission_places?.[number];
    if (!place) return "";
    const time = place.minutes && !place.is_done ? tn("for {n} minute", "for {n} minutes", place.minutes) : "";
    return [seats.length > 1 && name, placeText(place), time, !place.is_done && place.hint].filter(Boolean).join(", ");
  });
  return lines.filter(Boolean).join("; ");
}

/**
 * @param {Room} room
 * @param {string} mission
 */
function facts(room, mission) {
  const { text } = statusOf(room);
  const first = [text, room.status === "driving" && clock(room.seconds), room.why].filter(Boolean).join(" · ");
  const counts = [tn("{n} drive", "{n} drives", room.episodes), tn("{n} fall", "{n} falls", room.falls), room.is_solved ? t("solved") : t("not solved yet")].join(", ");
  return element(
    "dl",
    { className: "ai4u-facts-list" },
    ...pair(t("Now"), first),
    ...pair(t("Scene"), room.scene),
    ...(mission ? pair(t("Mission"), mission) : []),
    ...pair(t("Driven by"), room.driver || t("nobody")),
    ...(room.learning ? pair(t("Network"), room.learning) : []),
    ...pair(t("So far"), counts),
  );
}

/**
 * @param {string} name
 * @param {string} value
 */
function pair(name, value) {
  return [element("dt", { textContent: name }), element("dd", { textContent: value })];
}

/**
 * @param {Seat} seat
 * @param {RealNames} realNames
 * @param {boolean} hasCodes
 */
function person(seat, realNames, hasCodes) {
  const { name, colour } = seat;
  const dot = element("span", { className: "ai4u-dot" });
  dot.style.background = colour;
  const rename = action(t("Rename…"), (button) => {
    closeDialogOf(button);
    showRename(seat);
  });
  const kick = action(t("Send out…"), async (button) => {
    closeDialogOf(button);
    const text = t("The page closes. With the class’s code this student can join again, and finds all work there.");
    if (await ask({ title: t("Send {name} out?", { name }), text, yes: t("Send out") })) await commandOrTell({ do: "kick", seat: seat.number });
  });
  const ban = action(t("Ban…"), async (button) => {
    closeDialogOf(button);
    await showBan(seat, hasCodes);
  });
  const move = action(t("Code…"), async (button) => {
    closeDialogOf(button);
    await showMoveCode(seat);
  });
  const forget = action(t("Forget…"), async (button) => {
    closeDialogOf(button);
    await showForget(seat, realNames);
  });
  move.hidden = !hasCodes;
  rename.ariaLabel = t("Rename {name}", { name });
  move.ariaLabel = t("Code for {name}", { name });
  kick.ariaLabel = t("Send out {name}", { name });
  ban.ariaLabel = t("Ban {name}", { name });
  forget.ariaLabel = t("Forget {name}", { name });
  const real = realNames.of(seat);
  return element(
    "li",
    {},
    dot,
    element("span", { className: "ai4u-name", textContent: name }),
    element("span", { className: "ai4u-facts", textContent: [real, seat.is_here ? "" : t("page closed")].filter(Boolean).join(" · ") }),
    element("span", { className: "ai4u-actions" }, rename, move, kick, ban, forget),
  );
}

/**
 * Ban a seat. Its student may join again with the code in another browser, unless the code changes.
 * @param {Seat} seat
 * @param {boolean} hasCodes
 */
async function showBan(seat, hasCodes) {
  const options = { new: t("Set a new code. Whoever knows the old one can’t join again."), keep: t("Keep the code") };
  const group = choices(t("Code of the class"), "ban-code", options, "new");
  const text = t("This seat can’t be used again. Its work stays.");
  await showForm({ title: t("Ban {name}?", { name: seat.name }), text, content: hasCodes ? [group] : [], yes: t("Ban"), isDanger: true }, () =>
    command({ do: "ban", seat: seat.number, new_code: hasCodes && chosenIn(group) === "new" }),
  );
}

/**
 * Names are those of the list only: so nobody's real name gets to the class.
 * @param {Seat} seat
 */
async function showRename(seat) {
  try {
    /** @type {{names: string[]}} */
    const { names } = await (await fetch("./api/names", { cache: "no-store" })).json();
    const group = choices(t("New name"), "new-name", Object.fromEntries(names.map((name) => [name, name])), names[0]);
    const text = t("Names come from a list. For a real name, use “Real names…”: it stays in this browser.");
    await showForm({ title: t("Rename {name}", { name: seat.name }), text, content: [group], yes: t("Rename") }, () =>
      command({ do: "rename", seat: seat.number, name: chosenIn(group) }),
    );
  } catch {
    await tell(t("That can't be done"), t("The class can't be reached. Is its program still running?"));
  }
}

/**
 * @param {string} text
 * @param {(button: HTMLButtonElement) => void} onClick
 */
function action(text, onClick) {
  const made = element("button", { type: "button", className: "ai4u-plain", textContent: text });
  made.addEventListener("click", () => onClick(made));
  return made;
}
