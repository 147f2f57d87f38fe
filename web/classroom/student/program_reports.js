/** Tells the class how the person's program runs, and which mistake stopped it: the teacher sees who needs help. */

/** @import { RunEnd } from "../../code/run.js" */
/** @import { Emitter } from "../../types/events.js" */

import { roomOfPage } from "../../shared/room.js";

const ADDRESS = "../../api/program/run";
/** Delay before a report is sent again if the class can't be reached (ms). */
const RETRY_MS = 10_000;
/** Longest sentence; the class takes a bit more. */
const MAX_TEXT_CHARS = 600;
/**
 * Kinds of mistakes as the class knows them, by the kind outside of Python.
 * @type {Record<string, string>}
 */
const KINDS = { endless: "endless", too_large: "memory" };

/** @typedef {{state: string, kind?: string, text?: string, line?: number}} Report */

export class ProgramReports {
  #isInClass = roomOfPage() !== "";
  /** @type {Report | null} */
  #latest = null;
  /** The report that the class has, as text. */
  #told = "";
  #isBusy = false;
  #timer = 0;

  /** @param {(Emitter<{end: RunEnd}> & {phase: string})[]} runs a CodeRun and a CodeTest */
  constructor(...runs) {
    if (!this.#isInClass) return;
    for (const run of runs) {
      run.addEventListener("change", () => ["running", "stepping", "testing"].includes(run.phase) && this.#tell({ state: "running" }));
      run.addEventListener("end", ({ detail }) => this.#tell(reportOf(detail)));
    }
  }

  /** Tell that the latest mistake is of the past: another program is open, or the person drives. */
  end() {
    if (this.#isInClass && this.#latest?.state === "mistake") this.#tell({ state: "ended" });
  }

  /** @param {Report} report */
  #tell(report) {
    this.#latest = report;
    this.#send();
  }

  async #send() {
    if (this.#isBusy || !this.#isInClass) return;
    clearTimeout(this.#timer);
    this.#isBusy = true;
    let isReached = true;
    while (isReached && this.#told !== JSON.stringify(this.#latest)) isReached = await this.#put(JSON.stringify(this.#latest));
    this.#isBusy = false;
    if (!isReached && this.#isInClass) this.#timer = setTimeout(() => this.#send(), RETRY_MS);
  }

  /** @param {string} body */
  async #put(body) {
    try {
      const answer = await fetch(ADDRESS, { method: "PUT", headers: { "Content-Type": "application/json" }, body });
      if (answer.status === 403) this.#isInClass = false; // a teacher who looks in, or a student who was sent out
      if (answer.status === 429 || answer.status >= 500) return false;
      this.#told = body;
      return this.#isInClass;
    } catch {
      return false;
    }
  }
}

/**
 * Return what the class is told of a run's end.
 * @param {RunEnd} end
 * @returns {Report}
 */
function reportOf({ reason, text, line, kind }) {
  if (reason !== "mistake") return { state: "ended" };
  return { state: "mistake", kind: KINDS[kind] ?? kind ?? "", text: text.slice(0, MAX_TEXT_CHARS), line: line ?? 0 };
}
