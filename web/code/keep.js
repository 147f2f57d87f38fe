/** Programs that this browser keeps: the named ones of each agent and scene, and those of its latest runs. */

import { roomOfPage } from "../shared/room.js";
import { forget, recall, remember } from "../shared/storage.js";

/** Most runs whose programs are kept, for each agent and scene. */
const MAX_RUNS = 50;
/** Most characters of all of them together. */
const MAX_RUNS_CHARS = 200_000;
/** Most named programs of an agent in a scene, and most characters of a name. */
export const [MAX_PROGRAMS, MAX_NAME_CHARS] = [30, 40];
/** Name of a program that has got none. */
export const FIRST_NAME = "Program 1";

/** @typedef {{at: number, source: string, name?: string}} KeptRun at milliseconds since 1970 */
/** @typedef {{name: string, source: string | null}} NamedProgram source is null as long as nothing was written */

export class KeptPrograms {
  #key = "";

  /**
   * Use the programs of an agent in a scene.
   * @param {string} scene
   * @param {string} agent
   */
  open(scene, agent) {
    const room = roomOfPage(); // students of a class may use one device in turn
    this.#key = `${room && `${room}/`}${scene}-${agent}`;
  }

  /**
   * The present program; null if the person has written none.
   * @returns {string | null}
   */
  get source() {
    return recall(`code-${this.#key}`, null);
  }

  set source(source) {
    if (source === null) forget(`code-${this.#key}`);
    else remember(`code-${this.#key}`, source);
  }

  // -- named programs ----------------------------------------------------------------------------

  /** The name of the present program. */
  get name() {
    const { list, at } = this.#programs;
    return list[at].name;
  }

  /** The names of all programs. */
  get names() {
    return this.#programs.list.map(({ name }) => name);
  }

  /**
   * Return a name that no program has: the one that is asked for, or with a number behind it.
   * @param {string} wanted
   */
  freeName(wanted) {
    const name = wanted.trim().slice(0, MAX_NAME_CHARS) || FIRST_NAME;
    const taken = new Set(this.names);
    if (!taken.has(name)) return name;
    const [, stem, digits] = /^(.*?)(?: (\d{1,4}))?$/.exec(name);
    let count = Number(digits ?? 1) + 1;
    while (taken.has(`${stem} ${count}`)) count += 1;
    return `${stem} ${count}`;
  }

  /**
   * Make another program the present one.
   * @param {string} name nothing happens if none has it: another page may have removed it
   */
  choose(name) {
    const { list } = this.#programs;
    const at = list.findIndex((program) => program.name === name);
    if (at >= 0) this.#keep(list, at);
  }

  /**
   * Add a program, which becomes the present one.
   * @param {string} name a free one
   * @param {string | null} source
   */
  add(name, source) {
    const { list } = this.#programs;
    this.#keep([...list, { name, source }], list.length);
  }

  /**
   * List programs whose texts are elsewhere.
   * @param {string[]} names
   */
  learn(names) {
    const { list, at } = this.#programs;
    const known = new Set(this.names);
    const others = names.filter((name) => !known.has(name)).map((name) => /** @type {NamedProgram} */ ({ name, source: null }));
    if (others.length) this.#keep([...list, ...others].slice(0, MAX_PROGRAMS), at);
  }

  /**
   * Rename the present program.
   * @param {string} name a free one
   */
  rename(name) {
    const { list, at } = this.#programs;
    list[at].name = name;
    this.#keep(list, at);
  }

  /** Delete the present program; the one before it becomes the present one. */
  remove() {
    const { list, at } = this.#programs;
    const rest = list.filter((_, index) => index !== at);
    this.#keep(rest.length ? rest : [{ name: FIRST_NAME, source: null }], Math.max(at - 1, 0));
  }

  /** All programs, and the place of the present one among them. */
  get #programs() {
    const kept = recall(`code-programs-${this.#key}`, null);
    /** @type {NamedProgram[]} */
    const named = (Array.isArray(kept?.list) ? kept.list : []).filter(isNamed);
    const list = named.length ? named : [{ name: FIRST_NAME, source: null }];
    const at = Math.min(Math.max(Math.trunc(kept?.at) || 0, 0), list.length - 1);
    list[at] = { name: list[at].name, source: this.source };
    return { list, at };
  }

  /**
   * @param {NamedProgram[]} list
   * @param {number} at place of the present one, whose text is kept apart
   */
  #keep(list, at) {
    const kept = list.map(({ name, source }, index) => ({ name, source: index === at ? null : source }));
    remember(`code-programs-${this.#key}`, { at, list: kept });
    this.source = list[at].source;
  }

  // -- runs --------------------------------------------------------------------------------------

  /**
   * The programs of the latest runs, newest first.
   * @returns {KeptRun[]}
   */
  get runs() {
    const runs = recall(`code-runs-${this.#key}`, []);
    return Array.isArray(runs) ? runs.filter(({ source }) => typeof source === "string") : [];
  }

  /**
   * Keep a program that runs, unless it is that of the run before.
   * @param {string} source
   */
  addRun(source) {
    const before = this.runs;
    if (before[0]?.source === source) return;
    let chars = 0;
    const runs = [{ at: Date.now(), source, name: this.name }, ...before].slice(0, MAX_RUNS);
    remember(`code-runs-${this.#key}`, runs.filter((run) => (chars += run.source.length) <= MAX_RUNS_CHARS));
  }
}

/** @param {unknown} program from storage, which may hold anything */
function isNamed(program) {
  const { name, source } = /** @type {NamedProgram} */ (program ?? {});
  return typeof name === "string" && (source === null || typeof source === "string");
}

/**
 * Give the person a text as a file.
 * @param {string} name
 * @param {string} text
 */
export function downloadText(name, text) {
  const url = URL.createObjectURL(new Blob([text], { type: "text/x-python" }));
  const link = document.createElement("a");
  Object.assign(link, { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
