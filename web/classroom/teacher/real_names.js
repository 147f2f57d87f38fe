/** Real names of students, from a table that the teacher loads. They stay in this browser and are never sent. */

/** @import { Seat } from "../../types/class.js" */

import { forget, recall, remember } from "../../shared/storage.js";
import { t } from "../../shared/text.js";

const STORAGE_KEY = "real-names";
const MAX_NAME_CHARS = 60;

export class RealNames {
  /** Called when names were loaded or forgotten. */
  onchange = () => {};
  /**
   * Real names by a seat's number, or by its name in small letters.
   * @type {Record<string, string>}
   */
  #names = recall(STORAGE_KEY, {});

  get count() {
    return Object.keys(this.#names).length;
  }

  /**
   * Return a seat's real name, or "".
   * @param {Pick<Seat, "number" | "name">} seat
   */
  of(seat) {
    return this.#names[seat.number] ?? this.#names[keyOf(seat.name)] ?? "";
  }

  /**
   * Load a table: a line for each student, with the seat's number or name, and the real name.
   * @param {string} text
   * @throws {Error} with a sentence if it has no such line
   */
  load(text) {
    const names = parseNames(text);
    if (Object.keys(names).length === 0) {
      throw new Error(t("Expected lines such as “Red Fox,Ada Lovelace” or “3,Ada Lovelace”, found none in this file."));
    }
    this.#names = names;
    remember(STORAGE_KEY, names);
    this.onchange();
  }

  /**
   * Forget the real name of a seat that was deleted: another one may get its number.
   * @param {Pick<Seat, "number" | "name">} seat
   */
  forgetSeat(seat) {
    delete this.#names[seat.number];
    delete this.#names[keyOf(seat.name)];
    remember(STORAGE_KEY, this.#names);
    this.onchange();
  }

  forget() {
    this.#names = {};
    forget(STORAGE_KEY);
    this.onchange();
  }
}

/**
 * Return real names by key. Columns may be parted by commas, semicolons or tabs, and be in quotes.
 * @param {string} text
 */
export function parseNames(text) {
  /** @type {Record<string, string>} */
  const names = {};
  for (const line of text.replace(/^\ufeff/, "").split(/\r?\n/)) {
    const cells = [...line.matchAll(/\s*(?:"((?:[^"]|"")*)"|([^,;\t]*))\s*(?:[,;\t]|$)/g)];
    const [seat, name] = cells.map((cell) => (cell[1]?.replaceAll('""', '"') ?? cell[2] ?? "").trim());
    if (seat && name) names[keyOf(seat)] = name.slice(0, MAX_NAME_CHARS);
  }
  return names;
}

/** @param {string} name */
function keyOf(name) {
  return name.toLowerCase().replace(/\s+/g, " ").trim();
}
