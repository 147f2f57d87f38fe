/** The tables of progress: students by exercises, and the stars of their programs by scenes. */

/** @import { ClassState, ExerciseProgress, LessonExercises, LibraryScene, Seat } from "../../types/class.js" */
/** @import { RealNames } from "./real_names.js" */

import { element, setText, tableHead } from "../../shared/dom.js";
import { counted } from "../room_words.js";
import { starRow } from "../../scenes/stars.js";

/**
 * Signs and words of an exercise's state; a sign differs in shape.
 * @type {Record<string, {sign: string, text: string}>}
 */
const STATES = {
  solved: { sign: "✓", text: "solved" },
  hint: { sign: "?", text: "hint read" },
  tried: { sign: "×", text: "tried" },
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
  show({ seats, exercises = [], progress = {}, scenes = [], stars = {} }) {
    const students = seats.filter((seat) => seat.state === "in");
    const told = JSON.stringify([students.map((s) => [s.number, s.name, this.#realNames.of(s)]), exercises, progress, stars]);
    if (told === this.#told) return;
    this.#told = told;
    const begun = new Set(Object.values(progress).flatMap(Object.keys));
    const lessons = exercises.filter((lesson) => lesson.ids.some((id) => begun.has(id)));
    const earned = this.#starTable(students, scenes, stars);
    if (lessons.length === 0 && earned === null) {
      const text = "No exercises yet. When students solve exercises of the lessons, a row for each of them appears here, and when their programs earn stars.";
      this.#place.replaceChildren(element("p", { className: "ai4u-empty", textContent: text }));
      return;
    }
    const tables = [lessons.length > 0 && this.#table(students, lessons, progress), earned];
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
    const head = tableHead("Stars of programs", ...shown.map(({ title }) => title));
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
    return element("div", { className: "ai4u-scroll", tabIndex: 0, role: "region", "aria-label": "Stars of programs" }, table);
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
        element("th", { scope: "col", rowSpan: 2, textContent: "Student" }),
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
      const note = element("span", { className: "ai4u-facts", textContent: [real, `${solved} solved`].filter(Boolean).join(" · ") });
      const cells = ids.map((id) => cell(progress[seat.number]?.[id], firsts.has(id)));
      return element("tr", {}, element("th", { scope: "row" }, name, note), ...cells);
    });
    const sums = ids.map((id) => {
      const count = students.filter((seat) => isSolved(seat, id)).length;
      return element("td", { textContent: `${count}/${students.length}`, dataset: firsts.has(id) ? { first: "" } : {} });
    });
    const foot = element("tfoot", {}, element("tr", {}, element("th", { scope: "row", textContent: "Solved" }), ...sums));
    const table = element("table", { className: "ai4u-progress" }, head, element("tbody", {}, ...rows), foot);
    return element("div", { className: "ai4u-scroll", tabIndex: 0, role: "region", "aria-label": "Progress" }, table);
  }
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
  const facts = [state.text, result.tries && counted(result.tries, "try").replace("trys", "tries"), minutes && `${minutes} min`];
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
