/** The person's programs: the bar with their names, and the section "Your program" on where they come from and are kept. */

/** @import { Panel } from "../panel/panel.js" */

import { splitProgram } from "../blocks/text.js";
import { handoutFor, handouts } from "../classroom/student/handout.js";
import { ClassPrograms } from "../classroom/student/programs.js";
import { freeId } from "../shared/ids.js";
import { downloadText, FIRST_NAME, KeptPrograms, MAX_NAME_CHARS, MAX_PROGRAMS } from "./keep.js";
import { ask } from "../shared/dialog.js";
import { field, showForm } from "../shared/form_dialog.js";
import { button, element, fileButton } from "../shared/dom.js";
import { t } from "../shared/text.js";
import { section } from "../panel/widgets/parts.js";
import { copyLink } from "../scenes/share.js";
import { SharedOffer, sharedFor, sharedPrograms } from "../scenes/shared_program.js";

/** Largest program that is read from a file (bytes). */
const MAX_PROGRAM_BYTES = 100_000;
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
    learn: (agents) => this.#learn(agents),
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
  #names = element("select", { ariaLabel: t("Program") });
  /** The names of the programs, and buttons to make, rename, copy and delete one. */
  bar = element("div", { className: "ai4u-code-programs" }, this.#names);
  #runs = element("select", { id: freeId() });
  /** A program that came with a link. */
  shared;
  /** Button that takes the teacher's program; hidden if there is none. */
  offer = button(t("Take the program from your teacher"), () => this.#takeRun("teacher"), { icon: "download" });

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
    this.#names.addEventListener("change", () => this.#choose(this.#names.value));
    this.bar.append(
      button("", () => this.add(FIRST_NAME, null), { icon: "add", label: t("New program"), kind: "quiet" }),
      button("", () => this.#rename(), { icon: "text", label: t("Rename this program"), kind: "quiet" }),
      button("", () => this.add(this.#kept.name, this.#tab.text()), { icon: "copy", label: t("Copy this program"), kind: "quiet" }),
      button("", () => this.#remove(), { icon: "trash", label: t("Delete this program"), kind: "quiet" }),
    );
    const label = element("label", { htmlFor: this.#runs.id, textContent: t("Earlier runs") });
    const tools = element(
      "div",
      { className: "ai4u-code-tools" },
      element("div", { className: "ai4u-inline ai4u-code-runs" }, label, this.#runs),
      button(t("Download .py"), () => downloadText(`${this.#fileName}.py`, tab.text()), { icon: "download" }),
      button(t("Copy link"), () => this.#copyLink(), { icon: "copy", title: t("Copy a link to this scene with your program") }),
      fileButton(t("Open .py"), ".py,text/x-python,text/plain", (file) => this.#openFile(file)),
    );
    this.element = section("code-program", t("Your program"), {}, tools, this.#class.element);
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
    this.#class.open(scene, this.#place);
    this.#draw();
  }

  /**
   * Take another program to begin with: the robot has become another one.
   * @param {string} first
   */
  setFirst(first) {
    const isUntouched = this.#kept.source === null && this.#tab.text() === this.#first;
    this.#first = first;
    if (isUntouched) this.#tab.show(first);
  }

  /**
   * Add a program, and show it.
   * @param {string} name that it gets, with a number behind it if another one has it
   * @param {string | null} source null for the one that a person begins with
   * @returns {boolean} false if there are too many
   */
  add(name, source) {
    if (this.#kept.names.length >= MAX_PROGRAMS) {
      this.#panel.notice(t("This scene has {count} programs already. Delete one first.", { count: MAX_PROGRAMS }), "error");
      return false;
    }
    this.#kept.add(this.#kept.freeName(name), source);
    this.#showPresent();
    return true;
  }

  /** @param {string} name */
  #choose(name) {
    this.#kept.choose(name);
    this.#showPresent();
  }

  async #rename() {
    const input = element("input", { type: "text", value: shownName(this.#kept.name), maxLength: MAX_NAME_CHARS, required: true });
    const answer = showForm({ title: t("Rename the program"), content: [field(t("Name"), input)], yes: t("Rename") }, () => {
      const name = input.value.trim();
      if (!name) throw new Error(t("Expected a name, got nothing. Write one or two words, such as Wall follower."));
      if (name === shownName(this.#kept.name)) return;
      this.#class.removed(this.#scene, this.#place);
      this.#kept.rename(this.#kept.freeName(name));
      this.#class.open(this.#scene, this.#place);
    });
    input.select();
    if (await answer) this.#draw();
  }

  async #remove() {
    const { name } = this.#kept;
    if (!(await ask({ title: t("Delete “{name}”?", { name: shownName(name) }), text: t("Its text stays under Earlier runs."), yes: t("Delete") }))) return;
    this.#kept.addRun(this.#tab.text());
    this.#class.removed(this.#scene, this.#place);
    this.#kept.remove();
    this.#showPresent();
  }

  /** Show the program that has become the present one. */
  #showPresent() {
    this.#tab.show(this.#kept.source ?? this.#first);
    this.#class.open(this.#scene, this.#place);
    this.#draw();
  }

  /** The agent of the present program, as the class knows it: with a name behind a slash, if it has got one. */
  get #place() {
    const { name } = this.#kept;
    return name === FIRST_NAME ? this.#agent : `${this.#agent}/${name}`;
  }

  /**
   * List the programs that the class has, from another device.
   * @param {string[]} agents with names behind a slash
   */
  #learn(agents) {
    const start = `${this.#agent}/`;
    const names = agents.filter((agent) => agent.startsWith(start)).map((agent) => agent.slice(start.length));
    this.#kept.learn(names);
    const isNew = this.#kept.source === null && this.#kept.name === FIRST_NAME && !agents.includes(this.#agent);
    if (isNew && names.length) this.#choose(names[0]);
    else this.#draw();
  }

  /** Name of the program's file, without its ending. */
  get #fileName() {
    const { name } = this.#kept;
    return name === FIRST_NAME ? (this.#name ?? "program") : name.replace(/[^\p{L}\p{N}-]+/gu, "_");
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
    if (file.size > MAX_PROGRAM_BYTES) {
      this.#panel.notice(t("{name}: expected a program (.py), got {bytes} bytes.", { name: file.name, bytes: file.size }), "error");
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
    const { name: present, names } = this.#kept;
    this.#names.replaceChildren(...names.map((name) => element("option", { value: name, textContent: shownName(name) })));
    this.#names.value = present;
    const shared = sharedFor(this.#scene, this.#agent);
    this.shared.update(shared === this.#tab.text() ? null : shared);
    const runs = this.#kept.runs.map(({ at, source, name = FIRST_NAME }) => {
      const lines = splitProgram(source).python.trim().split("\n").length;
      return element("option", { value: at, textContent: t("{name} · {time} · {lines} lines", { name: shownName(name), time: when(at), lines }) });
    });
    const now = element("option", { value: NOW, textContent: runs.length ? t("Choose one") : t("None yet") });
    const first = element("option", { value: "start", textContent: t("The first program") });
    const handout = handoutFor(this.#scene);
    const teachers = handout === null ? [] : [element("option", { value: "teacher", textContent: t("From your teacher") })];
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

/**
 * Return a program's name as it is shown: the ones that nobody chose are kept in English.
 * @param {string} name
 */
function shownName(name) {
  const number = /^Program (\d+)$/.exec(name)?.[1];
  return number ? t("Program {number}", { number }) : name;
}
