/** The tab "Code": a program in Python drives the shown agent. */

import { handoutFor, handouts } from "./class_handout.js";
import { ClassPrograms } from "./class_programs.js";
import { CodeConsole } from "./code_console.js";
import { CodeEditor } from "./code_editor.js";
import { NameList, VariableList } from "./code_facts.js";
import { downloadText, KeptPrograms } from "./code_keep.js";
import { CodeRun } from "./code_run.js";
import { outcomeOf, WorldSpeed } from "./code_speed.js";
import { namesOf, startProgram } from "./code_start.js";
import { CodeTest } from "./code_test.js";
import { TestTable, testWords } from "./code_test_table.js";
import { runWords } from "./code_words.js";
import { button, element, setAttributes, setText } from "./dom.js";
import { freeId, section } from "./panel_parts.js";
import { fileButton } from "./panel_scene_files.js";

/** Largest program that is read from a file (bytes). */
const MAX_FILE_BYTES = 100_000;
const NOW = "now";
const COMMAND_KEY = /Mac|iP(hone|ad)/.test(navigator.platform) ? "Cmd" : "Ctrl";

export class CodeTab {
  #panel;
  #run;
  #test;
  /** What ran last: the run or the test. */
  #active;
  #editor;
  #kept = new KeptPrograms();
  #class = new ClassPrograms({
    source: () => this.#kept.source,
    take: (source) => this.#takeFromClass(source),
    keep: (source) => this.#keepAsRun(source),
  });
  #console = new CodeConsole();
  #variables = new VariableList();
  #testTable = new TestTable((seed) => this.#begin(seed), () => this.#go("run", this.#test.failure));
  #nameList = new NameList((code) => this.#editor.insert(code));
  #key = null;
  #agent = null;
  /** How the latest run ended; null before the first one. */
  #end = null;
  /** Python: "loading", "ready", or a sentence about what went wrong. */
  #python = "loading";
  /** The latest decision. */
  #latest = null;
  /** Names that the program reads and writes, and the same as text. */
  #names = { readings: [], outputs: [] };
  #namesText = "";
  #isDue = false;
  /** True if the person drove at the latest event about it. */
  #wasPerson = false;

  #start = button("Run", () => this.#go("run"), { icon: "play", kind: "main", title: `Run (${COMMAND_KEY}+Enter)` });
  #stop = button("Stop", () => this.#stopAll(), { icon: "stop", title: "Stop, and give the robot back" });
  #step = button("Step", () => this.#go("step"), { icon: "forward", title: `Make one decision, and wait (${COMMAND_KEY}+Shift+Enter)` });
  #tryOut = button("Test", () => this.#runTest(), { icon: "check", title: "Drive 10 unseen starts, as fast as it goes" });
  #state = element("p", { role: "status" });
  #count = element("span", { className: "ai4u-code-count", ariaHidden: "true" });
  #stateRow = element("div", { className: "ai4u-code-state" }, element("i", { ariaHidden: "true" }), this.#state, this.#count);
  #mistakeText = element("p");
  #goTo = button("Go to the line", () => this.#editor.goTo(this.#end.line), {});
  #mistake = element("div", { className: "ai4u-code-mistake", role: "alert" }, this.#mistakeText);
  #runs = element("select", { id: freeId() });
  #offer = button("Take the program from your teacher", () => this.#takeRun("teacher"), { icon: "download" });

  /** @param parts of CodeRun and CodeTest */
  constructor(root, panel, parts = {}) {
    this.#panel = panel;
    this.#run = new CodeRun({ prepare: () => this.#wake(), beginAgain: () => this.#tryAgain(), ...parts });
    this.#test = new CodeTest({
      warm: () => this.#run.warm(),
      speed: new WorldSpeed(panel),
      prepare: () => this.#wake(),
      outcome: (percept, seed) => outcomeOf(panel, percept, seed),
      ...parts,
    });
    this.#active = this.#run;
    const help = element("p", { className: "ai4u-soft", id: freeId() });
    help.textContent = `${COMMAND_KEY}+Enter runs the program. Tab indents; Escape, then Tab leaves the editor.`;
    const frame = element("div", { className: "ai4u-code-editor" });
    const keys = [
      { key: "Ctrl-Enter", mac: "Cmd-Enter", run: () => this.#go("run") },
      { key: "Ctrl-Shift-Enter", mac: "Cmd-Shift-Enter", run: () => this.#go("step") },
    ];
    this.#editor = new CodeEditor(frame, { label: "Program in Python", describedBy: help.id, keys });
    this.#editor.onChange = (text) => this.#onEdit(text);
    const buttons = element("div", { className: "ai4u-code-buttons" }, this.#start, this.#step, this.#tryOut, this.#stop);
    const sections = [this.#testTable.element, this.#console.element, this.#variables.element, this.#nameList.element, this.#tools()];
    root.classList.add("ai4u-code");
    const head = element("div", { className: "ai4u-code-head" }, buttons, this.#stateRow);
    root.append(head, this.#offer, frame, this.#mistake, help, ...sections);
    this.#listen();
    this.#drawState();
    this.#warm();
  }

  /** @param agent as "agent" in the protocol */
  update(agent) {
    const python = this.#panel.part("python");
    if (python?.agent !== agent.id) return; // it comes next
    this.#agent = agent;
    const names = namesOf(agent.sensors, python.actuators);
    const text = JSON.stringify(names);
    if (text !== this.#namesText) this.#setNames(names, text);
    this.#open();
  }

  #setNames(names, text) {
    this.#namesText = text;
    this.#names = names;
    this.#nameList.update(names);
    this.#editor.setNames({
      readings: names.readings.map(({ key }) => key),
      outputs: names.outputs.map(({ name }) => name),
    });
  }

  #tools() {
    this.#runs.addEventListener("change", () => this.#takeRun(this.#runs.value));
    const label = element("label", { htmlFor: this.#runs.id, textContent: "Earlier runs" });
    const tools = element(
      "div",
      { className: "ai4u-code-tools" },
      element("div", { className: "ai4u-inline ai4u-code-runs" }, label, this.#runs),
      button("Download .py", () => downloadText(`${this.#key ?? "program"}.py`, this.#editor.text), { icon: "download" }),
      fileButton("Open .py", ".py,text/x-python,text/plain", (file) => this.#openFile(file)),
    );
    return section("code-program", "Your program", {}, tools, this.#class.element);
  }

  #listen() {
    for (const each of [this.#run, this.#test]) {
      each.addEventListener("change", () => {
        this.#panel.hasProgram = this.#active.isOn && this.#active.phase !== "loading";
        this.#drawSoon();
      });
    }
    this.#test.addEventListener("end", ({ detail }) => this.#onEnd({ ...detail, summary: testWords(this.#test) }));
    this.#panel.addEventListener("driver", () => {
      if (this.#isPerson && !this.#wasPerson) this.#test.stop("You drive, so the test was ended.");
      this.#wasPerson = this.#isPerson;
    });
    this.#run.addEventListener("printed", ({ detail }) => this.#console.add(detail.number, detail.text));
    this.#run.addEventListener("decision", ({ detail }) => {
      this.#latest = detail;
      this.#drawSoon();
    });
    this.#run.addEventListener("end", ({ detail }) => this.#onEnd(detail));
    this.#panel.addEventListener("agent", () => (this.#agent = null));
    this.#panel.addEventListener("part:python", () => {
      const agent = this.#panel.part("agent");
      if (agent !== null) this.update(agent);
    });
    for (const type of ["driver", "part:run"]) this.#panel.addEventListener(type, () => this.#drawSoon());
    addEventListener("pagehide", () => this.#stopAll());
    handouts.addEventListener("change", () => this.#onHandout());
  }

  // -- the program -------------------------------------------------------------------------------

  get #scene() {
    return this.#panel.part("scene")?.scene ?? "scene";
  }

  /** Show the program of the present agent and scene. */
  #open() {
    const key = `${this.#scene}-${this.#agent.id}`;
    if (key === this.#key) return;
    this.#run.stop();
    this.#test.clear();
    this.#key = key;
    this.#kept.open(this.#scene, this.#agent.id);
    this.#editor.text = this.#kept.source ?? handoutFor(this.#scene) ?? startProgram(this.#names);
    this.#class.open(this.#scene, this.#agent.id);
    this.#forget();
    this.#console.clear();
    this.#drawRuns();
  }

  #onEdit(text) {
    this.#keep(text);
    this.#editor.markRan([]);
    if (this.#runs.value !== NOW) this.#runs.value = NOW;
  }

  async #openFile(file) {
    if (file.size > MAX_FILE_BYTES) {
      this.#panel.notice(`${file.name}: expected a program (.py), got ${file.size} bytes.`, "error");
      return;
    }
    this.#replace((await file.text()).replaceAll("\r\n", "\n"));
  }

  /** Take another program; the present one is kept among the runs. */
  #replace(text) {
    this.#kept.addRun(this.#editor.text);
    this.#editor.text = text;
    this.#keep(text);
    this.#forget();
    this.#drawRuns();
  }

  #keep(text) {
    this.#kept.source = text;
    this.#class.changed(text);
  }

  /** Take the program that the class has, from another device. */
  #takeFromClass(source) {
    if (this.#kept.source !== null) this.#kept.addRun(this.#kept.source);
    this.#editor.text = this.#kept.source = source;
    this.#forget();
    this.#drawRuns();
  }

  #keepAsRun(source) {
    if (this.#kept.runs.some((run) => run.source === source)) return;
    this.#kept.addRun(source);
    this.#drawRuns();
  }

  /** Begin with a program that the teacher gives, or offer it to a person who has one already. */
  #onHandout() {
    if (this.#key === null) return;
    const source = handoutFor(this.#scene);
    if (source !== null && this.#kept.source === null && !this.#run.isOn) this.#editor.text = source;
    this.#drawRuns();
  }

  #takeRun(value) {
    if (value === "start") this.#replace(startProgram(this.#names));
    else if (value === "teacher") this.#takeHandout();
    else if (value !== NOW) this.#replace(this.#kept.runs.find(({ at }) => String(at) === value).source);
  }

  #takeHandout() {
    const source = handoutFor(this.#scene);
    this.#replace(source);
    this.#keepAsRun(source); // so it is there after it was changed, and not offered again
  }

  #drawRuns() {
    const runs = this.#kept.runs.map(({ at, source }) => {
      const lines = source.trim().split("\n").length;
      return element("option", { value: at, textContent: `${when(at)} · ${lines} lines` });
    });
    const now = element("option", { value: NOW, textContent: runs.length ? "Choose one" : "None yet" });
    const first = element("option", { value: "start", textContent: "The first program" });
    const handout = handoutFor(this.#scene);
    const teachers = handout === null ? [] : [element("option", { value: "teacher", textContent: "From your teacher" })];
    this.#runs.replaceChildren(now, ...runs, ...teachers, first);
    this.#runs.value = NOW;
    const isKnown = this.#editor.text === handout || this.#kept.runs.some(({ source }) => source === handout);
    this.#offer.hidden = handout === null || isKnown;
  }

  // -- runs --------------------------------------------------------------------------------------

  /** Begin to run, or make a step. Returns true: the key is used. */
  #go(way, seed = null) {
    if (this.#agent === null) return true;
    this.#test.stop();
    this.#active = this.#run;
    const source = this.#editor.text;
    if (this.#run.phase === "off" || way === "run") this.#console.clear();
    this.#noteStart(source);
    this.#run[way](source, this.#agent.id, seed);
    return true;
  }

  #runTest() {
    if (this.#agent === null) return;
    this.#stopAll();
    this.#panel.driving?.letGo(); // else whoever drove just before would go on
    this.#active = this.#test;
    this.#console.clear();
    this.#noteStart(this.#editor.text);
    this.#test.run(this.#editor.text, this.#agent.id);
  }

  /** Begin an episode with a seed, for the person to watch. */
  #begin(seed) {
    this.#stopAll();
    this.#panel.send("seed", { seed: String(seed) });
  }

  #stopAll() {
    this.#run.stop();
    this.#test.stop();
  }

  /** Keep a program that runs, and forget how the one before ended. */
  #noteStart(source) {
    this.#forget();
    this.#kept.addRun(source);
    this.#drawRuns();
    this.#class.ran(source);
  }

  /** Forget how the run before ended. */
  #forget() {
    this.#end = this.#latest = null;
    this.#mistakeText.textContent = "";
    this.#goTo.remove();
    this.#editor.markMistake(null);
    this.#editor.markRan([]);
    this.#variables.update({});
    this.#drawSoon();
  }

  #onEnd(end) {
    this.#end = end;
    setText(this.#mistakeText, end.line === null ? end.text : `Line ${end.line}: ${end.text}`);
    if (end.line !== null) {
      this.#mistake.append(this.#goTo);
      this.#editor.markMistake(end.line);
    }
    this.#drawSoon();
  }

  async #warm() {
    try {
      await this.#run.warm();
      this.#python = "ready";
    } catch (error) {
      this.#python = error.message;
    }
    this.#drawState();
  }

  /** True while the person drives in the program's place. */
  get #isPerson() {
    return Boolean(this.#panel.driver?.hello?.instead);
  }

  /** Let a paused world run. */
  async #wake() {
    if (this.#panel.part("run")?.is_paused) await this.#panel.send("resume", {}, { quiet: true });
  }

  /** Begin an episode with the same start, unless that disturbs another person. */
  async #tryAgain() {
    const agents = this.#panel.part("scene")?.agents ?? [];
    if (agents.some(({ id, is_person: isPerson }) => isPerson && id !== this.#agent.id)) return false;
    return (await this.#panel.send("try_again", {}, { quiet: true })).ok;
  }

  // -- drawing -----------------------------------------------------------------------------------

  /** Draw once in a frame, however many decisions there are. */
  #drawSoon() {
    if (this.#isDue) return;
    this.#isDue = true;
    requestAnimationFrame(() => {
      this.#isDue = false;
      this.#drawState();
      if (this.#latest === null) return;
      this.#editor.markRan(this.#latest.lines);
      this.#variables.update(this.#latest.variables);
    });
  }

  #drawState() {
    const { phase, decision, success, start, isOn } = this.#active;
    const isPaused = Boolean(this.#panel.part("run")?.is_paused);
    const shown = { phase, decision, success, start, isPerson: this.#isPerson, isPaused, python: this.#python, end: this.#end };
    const { kind, text, count } = runWords(shown);
    setText(this.#state, text);
    setText(this.#count, count);
    setAttributes(this.#stateRow, { "data-kind": kind });
    this.#stop.disabled = !isOn;
    this.#testTable.update(this.#test);
    this.#mistake.hidden = !this.#mistakeText.textContent;
  }
}

function when(at) {
  const date = new Date(at);
  const isToday = date.toDateString() === new Date().toDateString();
  return isToday ? date.toLocaleTimeString() : date.toLocaleString();
}
