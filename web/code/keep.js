/** Programs that this browser keeps: the present one of each agent and scene, and those of its latest runs. */

import { roomOfPage } from "../shared/room.js";
import { forget, recall, remember } from "../shared/storage.js";

/** Most runs whose programs are kept, for each agent and scene. */
const MAX_RUNS = 50;
/** Most characters of all of them together. */
const MAX_RUNS_CHARS = 200_000;

/** @typedef {{at: number, source: string}} KeptRun at milliseconds since 1970 */

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
    const runs = [{ at: Date.now(), source }, ...before].slice(0, MAX_RUNS);
    remember(`code-runs-${this.#key}`, runs.filter((run) => (chars += run.source.length) <= MAX_RUNS_CHARS));
  }
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
