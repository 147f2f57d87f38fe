/** The dialog that chooses what the projector page shows. */

/** @import { ClassState } from "../../types/class.js" */

import { command } from "./command.js";
import { element } from "../../shared/dom.js";
import { choices, chosenIn, field, select, showForm } from "../../shared/form_dialog.js";
import { roomName } from "../room_words.js";

/** @type {Record<string, string>} */
const KINDS = { join: "How to join: address, code and QR code", board: "The wall", room: "One room, live", race: "The race", tournament: "The tournament" };

/** @param {ClassState} state */
export function showProjector(state) {
  const rooms = state.rooms.map((room) => [room.id, roomName(room, state)]);
  const kinds = { ...KINDS };
  if (rooms.length === 0) delete kinds.room;
  const kind = choices("The projector shows", "kind", kinds, state.shown.kind in kinds ? state.shown.kind : "tournament");
  const room = select(rooms, state.shown.room);
  const whose = field("Whose room", room);
  const update = () => (whose.hidden = chosenIn(kind) !== "room");
  kind.addEventListener("change", update);
  update();
  const open = element("a", {
    href: "./projector",
    target: "ai4u-projector",
    className: "ai4u-plain",
    textContent: "Open the projector page",
  });
  const text = "Open its page once, in a window of its own, and move the window to the projector.";
  return showForm({ title: "Show on the projector", text, content: [element("p", {}, open), kind, whose], yes: "Show" }, () =>
    command({ do: "show", kind: chosenIn(kind), room: chosenIn(kind) === "room" ? room.value : "" }),
  );
}
