/** The section "Your program": where the program comes from, and where it is kept. */

/** @import { Panel } from "../panel/panel.js" */

import { splitProgram } from "../blocks/text.js";
import { handoutFor, handouts } from "../classroom/student/handout.js";
import { ClassPrograms } from "../classroom/student/programs.js";
import { freeId } from "../shared/ids.js";
import { downloadText, KeptPrograms } from "./keep.js";
import { button, element, fileButton } from "../shared/dom.js";
import { section } from "../panel/widgets/parts.js";
import { copyLink } from "../scenes/share.js";
import { SharedOffer, sharedFor, sharedPrograms } from "../scenes/shared_program.js";

/** Largest program that is read from a file (bytes). */
const MAX_FILE_BYTES = 100_000;
const NOW = "now";

export class ProgramSection {
  element;
  #panel;
  #tab;
  #kept = new KeptPrograms();
  #class = new ClassPrograms({
    source: () => this.#kept.source,
    take: (source) => this.#takeFromClass(source),
    keep: (source) => this.#keepAsRun(source),
  });
  #scene = "";
  #agent = "";
  /**
   * Name of the file; null before the first program.
   * @type {string | null}
   */
  #name = null;
  /** The program that a person begins with. */
  #first = "";
  #runs = element("select", { id: freeId() });
  /** A program that came with a link. */
  shared;
  /** Button that takes the teacher's program; hidden if there is none. */
  offer = button("Take the program from your teacher", () => this.#takeRun("teacher"), { icon: "download" });

  /**
   * @param {Panel} panel
   * @param {object} tab
   * @param {() => string} tab.text returns the program in the editor
   * @param {(text: string) => void} tab.show puts another one there, and forgets how the one before ended
   * @param {() => boolean} tab.isBusy returns true while the program drives
   */
  constructor(panel, tab) {
    this.#panel = panel;
    this.#tab = tab;
    this.#runs.addEventListener("change", () => this.#takeRun(this.#runs.value));
    const label = element("label", { htmlFor: this.#runs.id, textContent: "Earlier runs" });
    const tools = element(
      "div",
      { className: "ai4u-code-tools" },
      element("div", { className: "ai4u-inline ai4u-code-runs" }, label, this.#runs),
      button("Download .py", () => downloadText(`${this.#name ?? "program"}.py`, tab.text()), { icon: "download" }),
      button("Copy link", () => this.#copyLink(), { icon: "copy", title: "Copy a link to this scene with your program" }),
      fileButton("Open .py", ".py,text/x-python,text/plain", (file) => this.#openFile(file)),
    );
    this.element = section("code-program", "Your program", {}, tools, this.#class.element);
    this.shared = new SharedOffer((source) => this.replace(source));
    handouts.addEventListener("change", () => this.#onHandout());
    sharedPrograms.addEventListener("change", () => this.#draw());
  }

  /**
   * Show the program of an agent in a scene; the first one if there is no other.
   * @param {string} scene
   * @param {string} agent
   * @param {string} first
   */
  open(scene, agent, first) {
    [this.#scene, this.#agent, this.#name, this.#first] = [scene, agent, `${scene}-${agent}`, first];
    this.#kept.open(scene, agent);
    this.#tab.show(this.#kept.source ?? handoutFor(scene) ?? first);
    this.#class.open(scene, agent);
    this.#draw();
  }

  /**
   * Keep a program that the person has changed.
   * @param {string} text
   */
  changed(text) {
    this.#kept.source = text;
    this.#class.changed(text);
    if (this.#runs.value !== NOW) this.#runs.value = NOW;
  }

  /**
   * Keep a program that runs.
   * @param {string} text
   */
  ran(text) {
    this.#kept.addRun(text);
    this.#class.ran(text);
    this.#draw();
  }

  /** @param {File} file */
  async #openFile(file) {
    if (file.size > MAX_FILE_BYTES) {
      this.#panel.notice(`${file.name}: expected a program (.py), got ${file.size} bytes.`, "error");
      return;
    }
    this.replace((await file.text()).replaceAll("\r\n", "\n"));
  }

  /**
   * Take another program; the present one is kept among the runs.
   * @param {string} text
   */
  replace(text) {
    this.#kept.addRun(this.#tab.text());
    this.#tab.show(text);
    this.changed(text);
    this.#draw();
  }

  /**
   * Take the program that the class has, from another device.
   * @param {string} source
   */
  #takeFromClass(source) {
    if (this.#kept.source !== null) this.#kept.addRun(this.#kept.source);
    this.#kept.source = source;
    this.#tab.show(source);
    this.#draw();
  }

  /** @param {string} source */
  #keepAsRun(source) {
    if (this.#kept.runs.some((run) => run.source === source)) return;
    this.#kept.addRun(source);
    this.#draw();
  }

  /** Begin with a program that the teacher gives, or offer it to a person who has one already. */
  #onHandout() {
    if (this.#name === null) return;
    const source = handoutFor(this.#scene);
    if (source !== null && this.#kept.source === null && !this.#tab.isBusy()) this.#tab.show(source);
    this.#draw();
  }

  /** @param {string} value of the list of runs */
  #takeRun(value) {
    if (value === "start") this.replace(this.#first);
    else if (value === "teacher") this.#takeHandout();
    else {
      const run = this.#kept.runs.find(({ at }) => String(at) === value);
      if (run !== undefined) this.replace(run.source); // else another page of this browser has kept more runs since
    }
  }

  #takeHandout() {
    const source = handoutFor(this.#scene);
    this.replace(source);
    this.#keepAsRun(source); // so it is there after it was changed, and not offered again
  }

  async #copyLink() {
    this.#panel.notice(await copyLink({ agent: this.#agent, source: this.#tab.text() }));
  }

  #draw() {
    const shared = sharedFor(this.#scene, this.#agent);
    this.shared.update(shared === this.#tab.text() ? null : shared);
    const runs = this.#kept.runs.map(({ at, source }) => {
      const lines = splitProgram(source).python.trim().split("\n").length;
      return element("option", { value: at, textContent: `${when(at)} · ${lines} lines` });
    });
    const now = element("option", { value: NOW, textContent: runs.length ? "Choose one" : "None yet" });
    const first = element("option", { value: "start", textContent: "The first program" });
    const handout = handoutFor(this.#scene);
    const teachers = handout === null ? [] : [element("option", { value: "teacher", textContent: "From your teacher" })];
    this.#runs.replaceChildren(now, ...runs, ...teachers, first);
    this.#runs.value = NOW;
    const isKnown = this.#tab.text() === handout || this.#kept.runs.some(({ source }) => source === handout);
    this.offer.hidden = handout === null || isKnown;
  }
}

/** @param {number} at milliseconds since 1970 */
function when(at) {
  const date = new Date(at);
  const isToday = date.toDateString() === new Date().toDateString();
  return isToday ? date.toLocaleTimeString() : date.toLocaleString();
}
