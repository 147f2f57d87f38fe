/** The dialog that gives a scene, a lesson or a mission to one, some or all rooms. */

/** @import { ClassState } from "../../types/class.js" */

import { command } from "./command.js";
import { element } from "../../shared/dom.js";
import { choice, choices, chosenIn, field, showForm } from "../../shared/form_dialog.js";
import { t } from "../../shared/text.js";
import { roomName } from "../room_words.js";
import { sceneChoice, seedField } from "./scene_choice.js";

/** The same as MAX_STARTING_PROGRAM_CHARS of the class link. */
const MAX_PROGRAM_CHARS = 20_000;
const PROGRAM_HINT = t("Optional. The tab Code offers it; what students wrote stays.");

/**
 * Ask for a scene, a lesson or a mission and for rooms, and assign it.
 * @param {ClassState} state
 * @param {string} [room] id of the room that is chosen at first; "" for all
 */
export function showAssign(state, room = "") {
  const scene = sceneChoice(state, { withLessons: true });
  const to = choices(t("For"), "rooms", { all: t("Everybody"), some: t("Some rooms") }, room ? "some" : "all");
  const boxes = state.rooms.map((each) => element("input", { type: "checkbox", value: each.id, checked: each.id === room }));
  const list = element(
    "div",
    { className: "ai4u-checklist", role: "group", "aria-label": t("Rooms") },
    ...state.rooms.map((each, index) => choice(roomName(each, state), boxes[index])),
  );
  const same = element("input", { type: "checkbox", checked: true });
  const seed = seedField(t("The same number gives the same start, also next week."));
  const program = element("textarea", { className: "ai4u-program-field", rows: 5, maxLength: MAX_PROGRAM_CHARS, spellcheck: false });
  const update = () => (list.hidden = chosenIn(to) !== "some");
  to.addEventListener("change", update);
  update();

  const text = t("What students have built stays among their saved scenes.");
  const more = element("details", { className: "ai4u-more" }, element("summary", { textContent: t("More: start and program") }));
  more.append(choice(t("The same start for all"), same), seed.node, field(t("Starting program (Python)"), program, PROGRAM_HINT));
  const content = [...scene.nodes, to, list, more];
  return showForm({ title: t("Assign a scene, a lesson or a mission"), text, content, yes: t("Assign") }, async () => {
    const some = boxes.filter((box) => box.checked).map((box) => box.value);
    const rooms = chosenIn(to) === "all" ? "all" : some;
    if (rooms.length === 0) throw new Error(t("Choose at least one room."));
    const source = program.value.trim() ? program.value : "";
    await command({
      do: "assign",
      rooms,
      scene: await scene.value(),
      seed: seed.value(),
      same_seed: same.checked,
      ...(source && { program: source }),
    });
  });
}
