/** The tables of progress: students by missions, by exercises, and the stars of their programs by scenes. */

/** @import { ClassState, ExerciseProgress, LessonExercises, LibraryScene, MissionTitle, Seat } from "../../types/class.js" */
/** @import { RealNames } from "./real_names.js" */

import { element, setText, tableHead } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";
import { placeText } from "../room_words.js";
import { starRow } from "../../scenes/stars.js";

/**
 * Signs and words of an exercise's state; a sign differs in shape.
 * @type {Record<string, {sign: string, text: string}>}
 */
const STATES = {
  solved: { sign: "✓", text: t("solved") },
  hint: { sign: "?", text: t("hint read") },
  tried: { sign: "×", text: t("tried") },
};

export class ProgressTable {
  #place;
  #realNames;
  #told = "";

  /**
   * @param {HTMLElement} place
   * @param {RealNames} realNames
   */
  constructor(place, realNames) {
    this.#place = place;
    this.#realNames = realNames;
  }

  /**
   * Show the class's state; drawn again only if something in it has changed.
   * @param {ClassState} state
   */
  show({ seats, exercises = [], progress = {}, scenes = [], stars = {}, missions = [], mission_progress: reached = {}, mission_places: places = {} }) {
    const students = seats.filter((seat) => seat.state === "in");
    const told = JSON.stringify([students.map((s) => [s.number, s.name, this.#realNames.of(s)]), exercises, progress, stars, missions, reached, Object.entries(places).map(([seat, place]) => [seat, placeText(place)])]);
    if (told === this.#told) return;
    this.#told = told;
    const begun = new Set(Object.values(progress).flatMap(Object.keys));
    const lessons = exercises.filter((lesson) => lesson.ids.some((id) => begun.has(id)));
    const earned = this.#starTable(students, scenes, stars);
    const done = this.#missionTable(students, missions, reached, places);
    if (lessons.length === 0 && earned === null && done === null) {
      const text = t("Nothing yet. When students do missions, solve exercises of the lessons, or earn stars with their programs, a row for each of them appears here.");
      this.#place.replaceChildren(element("p", { className: "ai4u-empty", textContent: text }));
      return;
    }
    const tables = [done, lessons.length > 0 && this.#table(students, lessons, progress), earned];
    this.#keepScroll(() => this.#place.replaceChildren(...tables.filter(Boolean)));
  }

  /** @param {() => void} update */
  #keepScroll(update) {
    const box = this.#place.firstElementChild;
    const [left, top] = [box?.scrollLeft ?? 0, box?.scrollTop ?? 0];
    update();
    this.#place.firstElementChild.scrollTo(left, top);
  }

  /**
   * Return the table of missions; null if nobody has begun one.
   * @param {Seat[]} students
   * @param {MissionTitle[]} missions
   * @param {ClassState["mission_progress"]} reached
   * @param {ClassState["mission_places"]} places
   */
  #missionTable(students, missions, reached, places) {
    const now = students.map(({ number }) => places[number]?.mission);
    const begun = new Set([...now, ...students.flatMap(({ number }) => Object.keys(reached[number] ?? {}))]);
    const shown = missions.filter(({ name }) => begun.has(name));
    if (shown.length === 0) return null;
    const head = tableHead(t("Missions"), ...shown.map(({ title }) => title));
    const body = students.map((seat) => {
      const own = reached[seat.number] ?? {};
      const done = shown.filter(({ name, steps }) => (own[name]?.[0] ?? 0) >= steps).length;
      const place = places[seat.number];
      const note = [this.#realNames.of(seat), tn("{n} done", "{n} done", done), place && t("now {place}", { place: placeText(place) })].filter(Boolean).join(" · ");
      const title = element("span", { className: "ai4u-name", textContent: seat.name });
      const facts = element("span", { className: "ai4u-facts", textContent: note });
      return element("tr", {}, element("th", { scope: "row" }, title, facts), ...shown.map((mission) => missionCell(mission, own[mission.name])));
    });
    const sums = shown.map(({ name, steps }) => {
      const count = students.filter(({ number }) => (reached[number]?.[name]?.[0] ?? 0) >= steps).length;
      return element("td", { textContent: `${count}/${students.length}` });
    });
    const foot = element("tfoot", {}, element("tr", {}, element("th", { scope: "row", textContent: t("Done") }), ...sums));
    const table = element("table", { className: "ai4u-progress" }, head, element("tbody", {}, ...body), foot);
    return element("div", { className: "ai4u-scroll", tabIndex: 0, role: "region", "aria-label": t("Missions") }, table);
  }

  /**
   * Return the table of stars; null if nobody has any.
   * @param {Seat[]} students
   * @param {LibraryScene[]} scenes
   * @param {ClassState["stars"]} stars
   */
  #starTable(students, scenes, stars) {
    const begun = new Set(Object.values(stars).flatMap(Object.keys));
    const shown = scenes.filter(({ name }) => begun.has(name));
    const rows = students.filter(({ number }) => stars[number]);
    if (shown.length === 0 || rows.length === 0) return null;
    const head = tableHead(t("Stars of programs"), ...shown.map(({ title }) => title));
    const body = rows.map((seat) => {
      const note = element("span", { className: "ai4u-facts", textContent: this.#realNames.of(seat) });
      const cells = shown.map(({ name, stars: total }) => {
        const count = stars[seat.number][name] ?? 0;
        return element("td", {}, count > 0 && starRow(count, total).element);
      });
      const title = element("span", { className: "ai4u-name", textContent: seat.name });
      return element("tr", {}, element("th", { scope: "row" }, title, note), ...cells);
    });
    const table = element("table", { className: "ai4u-progress" }, head, element("tbody", {}, ...body));
    return element("div", { className: "ai4u-scroll", tabIndex: 0, role: "region", "aria-label": t("Stars of programs") }, table);
  }

  /**
   * @param {Seat[]} students
   * @param {LessonExercises[]} lessons
   * @param {ClassState["progress"]} progress
   */
  #table(students, lessons, progress) {
    const ids = lessons.flatMap((lesson) => lesson.ids);
    const firsts = new Set(lessons.map((lesson) => lesson.ids[0]));
    const isSolved = (/** @type {Seat} */ seat, /** @type {string} */ id) => progress[seat.number]?.[id]?.state === "solved";
    const head = element(
      "thead",
      {},
      element(
        "tr",
        {},
        element("th", { scope: "col", rowSpan: 2, textContent: t("Student") }),
        ...lessons.map(({ lesson, title, ids }) =>
          element("th", { scope: "colgroup", colSpan: ids.length, title, dataset: { first: "" } }, element("span", { textContent: `${lesson} ${title}` })),
        ),
      ),
      element("tr", {}, ...ids.map((id) => element("th", { scope: "col", textContent: id, dataset: firsts.has(id) ? { first: "" } : {} }))),
    );
    const rows = students.map((seat) => {
      const real = this.#realNames.of(seat);
      const solved = ids.filter((id) => isSolved(seat, id)).length;
      const name = element("span", { className: "ai4u-name", textContent: seat.name });
      const note = element("span", { className: "ai4u-facts", textContent: [real, tn("{n} solved", "{n} solved", solved)].filter(Boolean).join(" · ") });
      const cells = ids.map((id) => cell(progress[seat.number]?.[id], firsts.has(id)));
      return element("tr", {}, element("th", { scope: "row" }, name, note), ...cells);
    });
    const sums = ids.map((id) => {
      const count = students.filter((seat) => isSolved(seat, id)).length;
      return element("td", { textContent: `${count}/${students.length}`, dataset: firsts.has(id) ? { first: "" } : {} });
    });
    const foot = element("tfoot", {}, element("tr", {}, element("th", { scope: "row", textContent: t("Solved") }), ...sums));
    const table = element("table", { className: "ai4u-progress" }, head, element("tbody", {}, ...rows), foot);
    return element("div", { className: "ai4u-scroll", tabIndex: 0, role: "region", "aria-label": t("Progress") }, table);
  }
}

/**
 * @param {MissionTitle} mission
 * @param {[steps: number, stars: number] | undefined} reached
 */
function missionCell({ steps, stars: total }, [done, stars] = [0, 0]) {
  if (!done && !stars) return element("td");
  if (done < steps) return element("td", { dataset: { state: "tried" }, title: tn("{done} of {n} step", "{done} of {n} steps", steps, { done }), textContent: `${done}/${steps}` });
  const row = starRow(stars, total).element;
  row.title = t("Stars of this mission");
  return element("td", { dataset: { state: "solved" } }, element("span", { textContent: "✓ ", "aria-hidden": "true" }), row);
}

/**
 * @param {ExerciseProgress | undefined} result
 * @param {boolean} isFirst of its lesson
 */
function cell(result, isFirst) {
  const made = element("td", { dataset: isFirst ? { first: "" } : {} });
  const state = STATES[result?.state];
  if (!state) return made;
  made.dataset.state = result.state;
  const minutes = Math.round(result.minutes ?? 0);
  const facts = [state.text, result.tries && tn("{n} try", "{n} tries", result.tries), minutes && t("{minutes} min", { minutes })];
  made.title = facts.filter(Boolean).join(", ");
  made.append(
    element("span", { textContent: state.sign, "aria-hidden": "true" }),
    element("small", { textContent: minutes ? `${minutes}′` : "", "aria-hidden": "true" }),
  );
  const words = element("span", { className: "ai4u-hidden" });
  setText(words, made.title);
  made.append(words);
  return made;
}
