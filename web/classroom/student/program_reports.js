/** Tells the class how the person's program runs, and which mistake stopped it: the teacher sees who needs help. */

import { roomOfPage } from "../../shared/room.js";

const ADDRESS = "../../api/program/run";
/** Delay before the class is told again if it can't be reached (ms). */
const RETRY_MS = 10_000;
/** Longest sentence; the class takes a bit more. */
const MAX_TEXT_CHARS = 600;
/** Kinds of mistakes outside of Python, by the kind that the class knows. */
const KINDS = { endless: "endless", too_large: "memory" };

export class ProgramReports {
  #isInClass = roomOfPage() !== "";
  /** The latest news, and those that the class has, as text. */
  #latest = null;
  #told = "";
  #isBusy = false;
  #timer = 0;

  /** @param runs a CodeRun and a CodeTest */
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

/** Return what the class is told of a run's end. */
function reportOf({ reason, text, line, kind }) {
  if (reason !== "mistake") return { state: "ended" };
  return { state: "mistake", kind: KINDS[kind] ?? kind ?? "", text: text.slice(0, MAX_TEXT_CHARS), line: line ?? 0 };
}
