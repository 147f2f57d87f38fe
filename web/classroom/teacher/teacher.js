/** The teacher's page: the wall of rooms, progress, misconceptions, and commands for the class. */

/** @import { Switches } from "../../generated/messages.js" */
/** @import { ClassState } from "../../types/class.js" */

import { showAssign } from "./assign_dialog.js";
import { END_ATTENTION, isHeld, showAttention } from "./attention_dialog.js";
import { commandOrTell } from "./command.js";
import { openClassSocket } from "../socket.js";
import { ClassStrips } from "../strips.js";
import { watchTabs } from "./tabs.js";
import { find, setText } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";
import { showEnd } from "./end_dialog.js";
import { JoinHeader } from "./join_header.js";
import { Misconceptions } from "./misconceptions.js";
import { showNames } from "./names_dialog.js";
import { ProgramsBoard } from "./programs_board.js";
import { ProgressTable } from "./progress_table.js";
import { showRace } from "./race_dialog.js";
import { RealNames } from "./real_names.js";
import { showRoom } from "./room_dialog.js";
import { showPrograms } from "./room_programs.js";
import { showProjector } from "./show_dialog.js";
import { TournamentBoard } from "../tournament/board.js";
import { Wall } from "../wall/wall.js";
import { WallControls } from "../wall/controls.js";
import { FILTERS } from "../wall/order.js";

const BOTTOM_PX = 16;
const MIN_WALL_PX = 240;
const NOBODY = t("Nobody is here yet. A card for each room appears as soon as somebody joins.");
/** @type {ClassState | null} */
let state = null;
/** Sentence while the class can't be reached. */
let lost = "";

/**
 * Buttons that turn something on or off in the whole class.
 * @type {NodeListOf<HTMLButtonElement>}
 */
const switches = document.querySelectorAll("[data-switch]");

const realNames = new RealNames();
const wall = new Wall(find("#wall"), {
  realNames,
  onOpen: (id) => showRoom(state.rooms.find((room) => room.id === id), state, realNames),
  heightLeft: () => Math.max(MIN_WALL_PX, innerHeight - (find("#wall").getBoundingClientRect().top + scrollY) - BOTTOM_PX),
});
const header = new JoinHeader(realNames);
const strips = new ClassStrips(find("#held"), find("#running-race"));
const progress = new ProgressTable(find("#view-progress"), realNames);
const misconceptions = new Misconceptions(find("#view-mistakes"), realNames);
const programs = new ProgramsBoard(find("#view-programs"), realNames, (number) => {
  const room = state.rooms.find(({ seats }) => seats.includes(number));
  if (room) showPrograms(room, state);
});
const tournament = new TournamentBoard(find("#view-tournament"), realNames);
const controls = new WallControls(find("#wall-controls"), wall);

const resized = new ResizeObserver(() => wall.fit());
for (const above of ["#join-view", "#bar"]) resized.observe(find(above));
realNames.onchange = () => state && show(state);
watchTabs(find("[role=tablist]"), (panel) => {
  find("#wall-controls").hidden = panel.id !== "view-wall";
  if (state) show(state);
});
find("#filters").addEventListener("click", () => state && sayNobody());
onState("#assign", () => showAssign(state));
onState("#race", () => showRace(state));
onState("#show", () => showProjector(state));
onState("#end", () => showEnd(state, () => realNames.forget()));
onState("#real-names", () => showNames(realNames));
onState("#attention", () => {
  return isHeld(state.attention) ? commandOrTell(END_ATTENTION) : showAttention();
});
for (const button of switches) {
  const name = /** @type {keyof Switches} */ (button.dataset.switch);
  button.addEventListener("click", () => state && commandOrTell({ do: "switch", name, on: !state.switches[name] }));
}
openClassSocket(
  "./teacher/socket",
  { class: show, drawing: (message) => wall.setDrawing(message), poses: (message) => wall.setPoses(message) },
  (problem) => {
    lost = problem;
    sayProblem();
  },
);

/**
 * Call a function at a click, once there is a state.
 * @param {string} selector
 * @param {() => void} onClick
 */
function onState(selector, onClick) {
  find(selector).addEventListener("click", () => state && onClick());
}

/** @param {ClassState} message */
function show(message) {
  state = message;
  sayProblem();
  header.show(state);
  strips.show(state);
  setText(find("#attention"), isHeld(state.attention) ? t("End attention") : t("Attention…"));
  for (const button of switches) {
    button.ariaPressed = String(state.switches[/** @type {keyof Switches} */ (button.dataset.switch)]);
  }
  find("#attention").toggleAttribute("data-held", isHeld(state.attention));
  wall.show(state);
  controls.update();
  sayNobody();
  progress.show(state);
  misconceptions.show(state);
  programs.show(state);
  tournament.show(state);
  const stopped = Object.values(state.runs ?? {}).filter((run) => run.state === "mistake").length;
  setText(find("#stopped-count"), stopped ? tn("({n} stopped)", "({n} stopped)", stopped) : "");
  const mistakes = state.misconceptions?.length ?? 0;
  setText(find("#mistake-count"), mistakes ? `(${mistakes})` : "");
  find("#wall ul").removeAttribute("aria-busy");
}

/** Say what is wrong with the connection, or with the class itself, such as a full disk. */
function sayProblem() {
  setText(find("#status"), lost || state?.problem || "");
}

/** Say why the wall is empty, if it is. */
function sayNobody() {
  const none = state.rooms.length ? t("No room now: “{filter}”.", { filter: FILTERS[wall.filter].text }) : NOBODY;
  find("#nobody").hidden = wall.count(wall.filter) > 0;
  setText(find("#nobody"), none);
}
