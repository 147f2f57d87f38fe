/** The board of misconceptions: which mistake of which exercise was made how often, and what to say about it. */

/** @import { ClassState, Misconception, Seat } from "../../types/class.js" */
/** @import { RealNames } from "./real_names.js" */

import { element } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";

/** @typedef {Misconception & {names: string[]}} NamedMisconception */

export class Misconceptions {
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

  /** @param {ClassState} state */
  show({ seats, misconceptions = [] }) {
    const named = misconceptions.map((each) => ({ ...each, names: namesOf(each.seats, seats, this.#realNames) }));
    const told = JSON.stringify(named);
    if (told === this.#told) return;
    this.#told = told;
    const exercises = grouped(named);
    const most = (/** @type {NamedMisconception[]} */ group) => Math.max(...group.map((each) => each.count));
    const groups = [...exercises].sort(([, a], [, b]) => most(b) - most(a));
    const empty = t("No mistakes yet. When a check of an exercise finds a known mistake, it is counted here.");
    this.#place.replaceChildren(
      ...(groups.length ? groups.map(section) : [element("p", { className: "ai4u-empty", textContent: empty })]),
    );
  }
}

/** @param {NamedMisconception[]} items */
function grouped(items) {
  /** @type {Map<string, NamedMisconception[]>} */
  const groups = new Map();
  for (const each of items) groups.set(each.exercise, [...(groups.get(each.exercise) ?? []), each]);
  return groups;
}

/**
 * @param {number[]} numbers
 * @param {Seat[]} seats
 * @param {RealNames} realNames
 */
function namesOf(numbers, seats, realNames) {
  return numbers
    .map((number) => seats.find((seat) => seat.number === number))
    .filter(Boolean)
    .map((seat) => (realNames.of(seat) ? `${seat.name} (${realNames.of(seat)})` : seat.name));
}

/** @param {[string, NamedMisconception[]]} exercise */
function section([exercise, group]) {
  const cards = [...group].sort((a, b) => b.count - a.count).map(mistakeCard);
  return element(
    "section",
    { className: "ai4u-mistakes" },
    element("h2", { textContent: t("Exercise {exercise}", { exercise }) }),
    ...cards,
  );
}

/**
 * Return a card with a mistake: how often it was made, what it is, what to say, and by whom.
 * @param {{count: number, names: string[], sentence: string, guide: string, diagnosis?: string, examples?: string[]}} mistake
 */
export function mistakeCard({ count, names, sentence, guide, diagnosis = "", examples = [] }) {
  return element(
    "article",
    {},
    element("p", { className: "ai4u-count" }, element("strong", { textContent: count }), element("span", { textContent: tn("time", "times", count) })),
    element(
      "div",
      {},
      element("p", { className: "ai4u-sentence", textContent: sentence || diagnosis }),
      ...examples.map((text) => element("p", { textContent: `“${text}”` })),
      guide && element("p", { className: "ai4u-guide" }, element("strong", { textContent: t("Say:") }), " ", guide),
      element("p", { className: "ai4u-facts", textContent: tn("{n} student: {names}", "{n} students: {names}", names.length, { names: names.join(", ") }) }),
    ),
  );
}
