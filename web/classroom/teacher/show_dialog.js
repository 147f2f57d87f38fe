/** The dialog that chooses what the projector page shows. */

/** @import { ClassState } from "../../types/class.js" */

import { command } from "./command.js";
import { element } from "../../shared/dom.js";
import { choices, chosenIn, field, select, showForm } from "../../shared/form_dialog.js";
import { t } from "../../shared/text.js";
import { roomName } from "../room_words.js";

/** @type {Record<string, string>} */
const KINDS = { join: t("How to join: address, code and QR code"), board: t("The wall"), room: t("One room, live"), race: t("The race"), tournament: t("The tournament") };

/** @param {ClassState} state */
export function showProjector(state) {
  const rooms = state.rooms.map((room) => [room.id, roomName(room, state)]);
  const kinds = { ...KINDS };
  if (rooms.length === 0) delete kinds.room;
  const kind = choices(t("The projector shows"), "kind", kinds, state.shown.kind in kinds ? state.shown.kind : "tournament");
  const room = select(rooms, state.shown.room);
  const whose = field(t("Whose room"), room);
  const update = () => (whose.hidden = chosenIn(kind) !== "room");
  kind.addEventListener("change", update);
  update();
  const open = element("a", {
    href: "./projector",
    target: "ai4u-projector",
    className: "ai4u-plain",
    textContent: t("Open the projector page"),
  });
  const text = t("Open its page once, in a window of its own, and move the window to the projector.");
  return showForm({ title: t("Show on the projector"), text, content: [element("p", {}, open), kind, whose], yes: t("Show") }, () =>
    command({ do: "show", kind: chosenIn(kind), room: chosenIn(kind) === "room" ? room.value : "" }),
  );
}
