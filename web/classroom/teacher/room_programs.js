/** The programs of a room's students, for the teacher to read. */

/** @import { ClassState, ProgramRun, Room, SeatProgram } from "../../types/class.js" */

import { splitProgram } from "../../blocks/text.js";
import { element } from "../../shared/dom.js";
import { showForm } from "../../shared/form_dialog.js";
import { t, tn } from "../../shared/text.js";
import { roomName } from "../room_words.js";

const UNREACHABLE = t("The class can't be reached. Is its program still running?");
const ELSEWHERE = t("In this class, students' programs stay on their own machines.");
/** Id of the agent of a scene that has one only. */
const ONLY_AGENT = "0";
/**
 * Units of an age, the largest first: [seconds, words].
 * @type {[number, (count: number) => string][]}
 */
const UNITS = [
  [86400, (count) => tn("changed {n} day ago", "changed {n} days ago", count)],
  [3600, (count) => tn("changed {n} hour ago", "changed {n} hours ago", count)],
  [60, (count) => tn("changed {n} minute ago", "changed {n} minutes ago", count)],
];

/**
 * Show the latest program of each seat of a room, as text that can't be changed.
 * @param {Room} room
 * @param {ClassState} state
 */
export function showPrograms(room, state) {
  const list = element("div", { className: "ai4u-programs" });
  const problem = element("p", { className: "ai4u-problem", role: "alert" });
  const refresh = element("button", { type: "button", className: "ai4u-plain", textContent: t("Refresh") });

  async function load() {
    refresh.disabled = true;
    try {
      const { programs } = await programsOf(room.id);
      list.replaceChildren(...programs.map((program) => programElement(program, state)));
      if (programs.length === 0) list.replaceChildren(element("p", { textContent: t("Nobody is in this room.") }));
      problem.textContent = "";
    } catch (error) {
      problem.textContent = error.message;
    }
    refresh.disabled = false;
  }

  refresh.addEventListener("click", load);
  const text = t("The program that each student changed last. All programs are in the export.");
  const content = [element("div", { className: "ai4u-actions" }, refresh), problem, list];
  const shown = showForm({ title: t("Code: {room}", { room: roomName(room, state) }), text, content, no: t("Close") });
  list.closest("dialog").classList.add("ai4u-wide");
  load();
  return shown;
}

/**
 * Return the latest programs of a room's seats; of all seats their beginning if `room` is empty.
 * @param {string} room
 * @returns {Promise<{programs: SeatProgram[]}>}
 */
export async function programsOf(room) {
  let answer;
  try {
    answer = await fetch(`./teacher/programs?room=${encodeURIComponent(room)}`, { cache: "no-store" });
  } catch {
    throw new Error(UNREACHABLE);
  }
  if (answer.status === 404 && !room) throw new Error(ELSEWHERE);
  const found = await answer.json().catch(() => ({}));
  if (!answer.ok) throw new Error(found.problem ?? t("The class answered with status {status}.", { status: answer.status }));
  return found;
}

/**
 * Return where a program is for, and when it was changed.
 * @param {SeatProgram} program
 * @param {ClassState} state
 */
export function programFacts({ scene, agent, age }, { scenes = [] }) {
  const title = scenes.find(({ name }) => name === scene)?.title ?? scene;
  return [title, agent !== ONLY_AGENT && t("robot {agent}", { agent }), ago(age)].filter(Boolean).join(" · ");
}

/**
 * @param {SeatProgram} program
 * @param {ClassState} state
 */
function programElement(program, state) {
  const { name, source } = program;
  const isAny = source !== null;
  const { python, isOfBlocks } = splitProgram(source ?? "");
  const facts = isAny ? [programFacts(program, state), isOfBlocks && t("made of blocks")].filter(Boolean).join(" · ") : t("no program yet");
  const run = state.runs?.[program.seat];
  const mistake = isAny && run?.state === "mistake" && stopText(run);
  const head = element("h3", {}, name, " ", element("small", { className: "ai4u-facts", textContent: facts }));
  const text = isAny && element("pre", { tabIndex: 0, "aria-label": t("Program of {name}", { name }), textContent: python });
  return element("section", {}, head, mistake && element("p", { className: "ai4u-problem", textContent: mistake }), text);
}

/** @param {ProgramRun} run that a mistake has stopped */
function stopText({ line, text }) {
  return line ? t("Stopped: line {line}: {text}", { line, text }) : t("Stopped: {text}", { text });
}

/**
 * Return an age in words.
 * @param {number} seconds
 */
export function ago(seconds) {
  const [unit, words] = UNITS.find(([length]) => seconds >= length) ?? [];
  if (!unit) return t("changed just now");
  return words(Math.floor(seconds / unit));
}
