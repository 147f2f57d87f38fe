/** The projector page: what the teacher shows to all. */

/** @import { ClassState, Race, RaceRow, Seat } from "../../types/class.js" */

import { clock } from "../../shared/numbers.js";
import { openClassSocket } from "../socket.js";
import { Countdown } from "../strips.js";
import { element, find, keyed, setAttributes, setText } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";
import { Podium, soundButton } from "./podium.js";
import { dot } from "../tournament/tables.js";
import { ProjectedTournament } from "./tournament.js";
import { Wall } from "../wall/wall.js";

const TICK_MS = 100;
const MARGIN_PX = 16;
const MAX_PLACES = 12;
const PODIUM_PLACES = 3;
/** Names of students up to which they are large. */
const FEW_NAMES = 12;
/**
 * Words for how a drive of a race ended, if it did not reach the goal.
 * @type {Record<string, string>}
 */
const OUTCOMES = { lost: t("lost"), fell: t("fell"), time: t("out of time"), over: t("ended") };
const starts = new Countdown();
const podium = new Podium();
find("#board").before(podium.element);
const sound = soundButton();
document.body.append(sound);
const tournament = new ProjectedTournament(find("#tournament"));
/** @type {ClassState | null} */
let state = null;

const wall = new Wall(find("#wall"), { heightLeft: () => innerHeight - find("#wall").getBoundingClientRect().top - scrollY - MARGIN_PX });
wall.look({ by: "name" }); // nobody's need of help is shown to all
openClassSocket(
  "./projector/socket",
  { class: show, drawing: (message) => wall.setDrawing(message), poses: (message) => wall.setPoses(message) },
  (problem) => setText(find("#status"), problem),
);
new ResizeObserver(() => wall.fit()).observe(find("#attention"));
setInterval(() => state?.race && showCountdown(state.race), TICK_MS);

/** @param {ClassState} message */
function show(message) {
  state = message;
  const { kind, room } = state.shown;
  find("#join").hidden = kind !== "join";
  find("#race").hidden = kind !== "race";
  find("#tournament").hidden = kind !== "tournament";
  find("#game").hidden = kind !== "game";
  find("#rooms").hidden = kind !== "room" && kind !== "board";
  sound.hidden = kind !== "race" && kind !== "tournament";
  setText(find("#attention"), state.attention.message);
  showJoin();
  showRace();
  showMissions();
  tournament.show(state);
  showGame();
  const shown = kind === "room" ? state.rooms.filter((each) => each.id === room) : state.rooms;
  // without what is between a student and the teacher
  wall.show({ ...state, rooms: shown.map((each) => ({ ...each, help: 0, why: "" })), progress: {} });
}

function showJoin() {
  setText(find("#address"), state.address.replace(/^http:\/\//, "").replace(/\/$/, ""));
  setText(find("#code"), state.code);
  find("#code").hidden = !state.code; // at a JupyterHub students sign in
  setText(find("#code-step"), state.code ? t("and type the code") : t("and sign in"));
  setAttributes(find("#qr"), { src: state.qr });
  const count = state.seats.filter((seat) => seat.state === "in").length;
  const here = count ? tn("{n} student is here", "{n} students are here", count) : t("Nobody is here yet");
  showNames();
  setText(find("#here"), state.open ? here : t("{here}. The class is locked.", { here }));
}

/** Show who has joined, the latest at the end. */
function showNames() {
  const seats = state.seats.filter((seat) => seat.state === "in");
  find("#join").dataset.size = seats.length === 0 ? "none" : seats.length > FEW_NAMES ? "many" : "few";
  keyed(find("#names"), seats, ({ number }) => number, nameItem, (item, { name }) => setText(item.lastChild, name));
}

/** @param {Seat} seat */
function nameItem(seat) {
  return element("li", {}, dot(seat), element("span"));
}

/** Show how many are where in the missions, without a name: who is stuck is between a student and the teacher. */
function showMissions() {
  const counts = state.shown.kind === "board" ? (state.mission_counts ?? []) : [];
  const stuck = counts.reduce((sum, each) => sum + each.stuck, 0);
  find("#missions").hidden = counts.length === 0;
  keyed(find("#missions ul"), counts, ({ title }) => title, () => element("li", {}, element("strong"), element("span")), (item, { title, count }) => {
    setText(item.firstChild, String(count));
    setText(item.lastChild, title);
  });
  setText(find("#missions p"), stuck ? tn("{n} of them is stuck", "{n} of them are stuck", stuck) : "");
}

function showRace() {
  const { race } = state;
  setText(find("#race h1"), race ? t("Race: {scene}", { scene: race.scene }) : t("No race now"));
  const isHidden = Boolean(race?.is_board_hidden);
  const text = isHidden ? t("The board is hidden. Drive your own best!") : race && race.board.length === 0 && race.phase === "running" ? t("Nobody has arrived yet.") : "";
  setText(find("#hidden-board"), text);
  starts.set(race?.starts_in ?? 0);
  showCountdown(race);
  const rows = isHidden || !race ? [] : race.board.slice(0, MAX_PLACES).map((row, index) => ({ ...row, place: index + 1 }));
  const best = race?.phase === "over" ? rows.filter(({ outcome }) => !(outcome in OUTCOMES)) : [];
  podium.show(race?.id, best.map(({ name, colour, seconds }) => ({ name, colour, text: `${seconds.toFixed(1)} s` })));
  const others = best.length ? rows.slice(Math.min(PODIUM_PLACES, best.length)) : rows;
  find("#board").dataset.columns = others.length > MAX_PLACES / 2 ? "2" : "1";
  keyed(find("#board"), others, (row) => row.room || row.name, raceRow, updateRow);
}

/** Show the recording of a game, which plays by itself; it is in a frame, as it may do nothing else. */
function showGame() {
  const { shown, tournament } = state;
  const address = shown.kind === "game" && tournament ? `./projector/game/${shown.game}?of=${tournament.id}` : "";
  const frame = find("#game iframe");
  if ((frame?.getAttribute("src") ?? "") === address) return;
  const made = element("iframe", { title: t("Recording of game {number}", { number: shown.game }), src: address });
  find("#game").replaceChildren(...(address ? [made] : []));
}

/** @param {Race | null} race */
function showCountdown(race) {
  const isCounting = race?.phase === "countdown" && starts.left > 0;
  setText(find("#starts"), isCounting ? (starts.left > 60 ? clock(starts.left) : String(Math.ceil(starts.left))) : "");
}

/** @param {RaceRow} row */
function raceRow(row) {
  return element("li", {}, element("span", { className: "ai4u-place" }), dot(row), element("span", { className: "ai4u-name" }), element("span", { className: "ai4u-time" }));
}

/**
 * @param {HTMLElement} item
 * @param {RaceRow & {place: number}} row
 */
function updateRow(item, row) {
  setText(item.querySelector(".ai4u-place"), String(row.place));
  setText(item.querySelector(".ai4u-name"), row.name);
  setText(item.querySelector(".ai4u-time"), OUTCOMES[row.outcome] ?? `${row.seconds.toFixed(1)} s`);
}
