/** The tab "Code": a program in Python drives the shown agent. */

/** @import { Emitter } from "../types/events.js" */
/** @import { AgentPart } from "../generated/messages.js" */
/** @import { Panel } from "../panel/panel.js" */
/** @import { Decision, RunDecision, RunEnd } from "./run.js" */
/** @import { Names } from "./start.js" */
/** @import { Example } from "./examples.js" */
/** @import { Told } from "./timeline.js" */

import { BlocksMode } from "../blocks/mode.js";
import { joinProgram } from "../blocks/text.js";
import { freeId } from "../shared/ids.js";
import { CodeConsole } from "./console.js";
import { CodeEditor } from "./editor.js";
import { exampleProgram, ExampleList } from "./examples.js";
import { NameList, VariableList } from "./facts.js";
import { CodeMoment } from "./moment.js";
import { ProgramSection } from "./program.js";
import { CodeRun } from "./run.js";
import { CodeStars } from "./stars.js";
import { outcomeOf, WorldSpeed } from "./speed.js";
import { namesOf, startProgram } from "./start.js";
import { CodeTest } from "./test.js";
import { CodeTimeline } from "./timeline.js";
import { TestTable, testWords } from "./test_table.js";
import { runWords } from "./words.js";
import { button, element, setAttributes, setText } from "../shared/dom.js";
import { retried } from "../shared/retry.js";
import { t } from "../shared/text.js";
import { ProgramReports } from "../classroom/student/program_reports.js";

const FROZEN = t("The browser stopped this page in the background, and your program with it. Press Run to go on.");
const COMMAND_KEY = /Mac|iP(hone|ad)/.test(navigator.platform) ? "Cmd" : "Ctrl";

export class CodeTab {
  #root;
  #panel;
  #run;
  #test;
  /**
   * The latest run or test.
   * @type {CodeRun | CodeTest}
   */
  #active;
  #editor;
  #blocks;
  #program;
  #reports;
  #console = new CodeConsole();
  #variables = new VariableList();
  #testTable = new TestTable((seed) => this.#begin(seed), () => this.#go("run", { seed: this.#test.failure }));
  #nameList = new NameList((code) => this.#editor.insert(code));
  #examples = new ExampleList((example) => this.#chooseExample(example));
  /**
   * The example that the person takes in a scene that is being opened.
   * @type {{example: Example, isOfBlocks: boolean} | null}
   */
  #next = null;
  /** @type {string | null} */
  #key = null;
  /** @type {AgentPart | null} */
  #agent = null;
  /**
   * End of the latest run; null before the first one.
   * @type {(RunEnd & {summary?: string, outcome?: string}) | null}
   */
  #end = null;
  /** Python: "loading", "ready", or a sentence about what went wrong. */
  #python = "loading";
  /**
   * The latest decision.
   * @type {RunDecision | null}
   */
  #latest = null;
  #timeline = new CodeTimeline();
  #moment;
  /**
   * Names that the program reads and writes, and the same as text.
   * @type {Names}
   */
  #names = { readings: [], outputs: [] };
  #namesText = "";
  #isDue = false;
  /** True while the world shows a moment of the past. */
  #isBack = false;
  /** True if the world has stood still since the program waits at a breakpoint. */
  #isHeld = false;
  /** True if the world was paused here for a breakpoint. */
  #hasPaused = false;
  /** True if the person drove at the latest event about it. */
  #wasPerson = false;

  #start = button(t("Run"), () => this.#go("run"), { icon: "play", kind: "main", title: t("Run ({key}+Enter)", { key: COMMAND_KEY }) });
  #here = button("", () => this.#go("run", { isHere: true }), { icon: "proceed", label: t("Go on from here") });
  #goOn = button(t("Go on"), () => this.#run.goOn(false), { icon: "play", kind: "main", title: t("Go on to the next breakpoint ({key}+Enter)", { key: COMMAND_KEY }) });
  #nextLine = button(t("Next line"), () => this.#run.goOn(true), { icon: "forward", title: t("Run this line, and wait again ({key}+Shift+Enter)", { key: COMMAND_KEY }) });
  #stopsText = element("p", { className: "ai4u-soft", role: "status" });
  #stop = button(t("Stop"), () => this.#stopAll(), { icon: "stop", title: t("Stop, and give the robot back") });
  #step = button(t("Step"), () => this.#go("step"), { icon: "forward", title: t("Make one decision, and wait ({key}+Shift+Enter)", { key: COMMAND_KEY }) });
  #tryOut = button(t("Test"), () => this.#runTest(), { icon: "check", title: t("Drive 10 new starts, as fast as possible") });
  #state = element("p", { role: "status" });
  #count = element("span", { className: "ai4u-code-count", ariaHidden: "true" });
  #stateRow = element("div", { className: "ai4u-code-state" }, element("i", { ariaHidden: "true" }), this.#state, this.#count);
  #mistakeText = element("p");
  #goTo = button(t("Go to the line"), () => this.#blocks.goTo(this.#end.line) || this.#editor.goTo(this.#end.line), {});
  #mistake = element("div", { className: "ai4u-code-mistake", role: "alert" }, this.#mistakeText);

  /**
   * @param {HTMLElement} root
   * @param {Panel} panel
   * @param {ConstructorParameters<typeof CodeRun>[0]} [parts] of CodeRun and CodeTest
   */
  constructor(root, panel, parts = {}) {
    this.#root = root;
    this.#panel = panel;
    this.#run = new CodeRun({ prepare: () => this.#wake(), hold: (on) => this.#holdAtBreakpoint(on), beginAgain: () => this.#tryAgain(), ...parts });
    this.#test = new CodeTest({
      warm: () => this.#run.warm(),
      speed: new WorldSpeed(panel),
      prepare: () => this.#wake(),
      outcome: (percept, seed) => outcomeOf(panel, percept, seed),
      ...parts,
    });
    this.#reports = new ProgramReports(this.#run, this.#test);
    const stars = new CodeStars(panel, this.#run, this.#test);
    this.#stateRow.append(stars.row.element);
    this.#active = this.#run;
    this.#moment = new CodeMoment(panel);
    const help = element("p", { className: "ai4u-soft", id: freeId() });
    help.textContent = t("{key}+Enter runs the program. A click on a line's number, or F9, lets it wait there. Tab indents; Escape, then Tab leaves the editor.", { key: COMMAND_KEY });
    const frame = element("div", { className: "ai4u-code-editor" });
    const keys = [
      { key: "Ctrl-Enter", mac: "Cmd-Enter", run: () => this.#go("run") },
      { key: "Ctrl-Shift-Enter", mac: "Cmd-Shift-Enter", run: () => this.#go("step") },
    ];
    this.#editor = new CodeEditor(frame, { label: t("Program in Python"), describedBy: help.id, keys });
    this.#editor.onChange = () => this.#onChange();
    this.#editor.onStops = (lines, added) => this.#setStops(lines, added);
    this.#blocks = new BlocksMode(panel, {
      editor: this.#editor,
      changed: () => this.#onChange(),
      replace: (text) => this.#program.replace(text),
      run: (way) => this.#go(way),
    });
    this.#blocks.onSwitch = (isOn) => {
      panel.programWay = isOn ? "blocks" : "python";
      panel.dispatchEvent(new Event("way"));
    };
    this.#program = new ProgramSection(panel, {
      text: () => this.#blocks.join(this.#editor.text),
      show: (text) => this.#showProgram(text),
      isBusy: () => this.#run.isOn,
    });
    const buttons = element("div", { className: "ai4u-code-buttons" }, this.#start, this.#here, this.#step, this.#tryOut, this.#goOn, this.#nextLine, this.#stop);
    const lists = [this.#testTable.element, this.#console.element, this.#variables.element, this.#examples.element];
    const sections = [...lists, stars.element, this.#nameList.element, this.#program.element];
    root.classList.add("ai4u-code");
    const head = element("div", { className: "ai4u-code-head" }, buttons, this.#stateRow);
    const way = element("div", { className: "ai4u-code-way" }, this.#program.bar, this.#blocks.bar);
    const body = element("div", { className: "ai4u-code-body" }, this.#blocks.element, element("div", {}, frame, help, this.#stopsText));
    const both = [this.#moment.element, this.#program.offer, this.#program.shared.element, way, body, this.#mistake];
    root.append(head, ...both, ...sections);
    this.#listen();
    this.#drawState();
    this.#warm();
  }

  /** @param {AgentPart} agent */
  update(agent) {
    const python = this.#panel.part("python");
    if (python?.agent !== agent.id) return; // it comes next
    this.#agent = agent;
    const names = namesOf(agent.sensors, python.actuators);
    const text = JSON.stringify(names);
    this.#blocks.setAgent(python);
    if (text !== this.#namesText) this.#setNames(names, text);
    this.#open();
  }

  /**
   * @param {Names} names
   * @param {string} text
   */
  #setNames(names, text) {
    this.#namesText = text;
    this.#names = names;
    if (this.#key !== null) this.#program.setFirst(startProgram(names)); // the parts of a new scene come one after another
    this.#nameList.update(names);
    this.#editor.setNames({
      readings: names.readings.map(({ key }) => key),
      outputs: names.outputs.map(({ name }) => name),
    });
  }

  #listen() {
    for (const run of [this.#run, this.#test]) this.#watch(run);
    this.#test.addEventListener("end", ({ detail }) => {
      this.#onEnd({ ...detail, summary: testWords(this.#test) });
    });
    this.#panel.addEventListener("driver", () => {
      if (this.#isPerson && !this.#wasPerson) {
        this.#test.stop(t("You're driving, so the test was ended."));
        this.#reports.end();
      }
      this.#wasPerson = this.#isPerson;
    });
    this.#run.addEventListener("printed", ({ detail }) => this.#console.add(detail.number, detail.text));
    this.#run.addEventListener("decision", ({ detail }) => {
      this.#latest = detail;
      this.#variables.note(detail.variables);
      this.#drawSoon();
    });
    this.#run.addEventListener("end", ({ detail }) => this.#onEnd(detail));
    this.#panel.addEventListener("agent", () => (this.#agent = null));
    this.#panel.addEventListener("part:python", () => {
      const agent = this.#panel.part("agent");
      if (agent !== null) this.update(agent);
    });
    this.#panel.addEventListener("part:scene", () => this.#examples.update(this.#panel.part("scene")));
    this.#examples.update(this.#panel.part("scene"));
    this.#panel.addEventListener("part:run", () => this.#noteOutcome());
    this.#panel.addEventListener("part:run", ({ detail }) => this.#followPause(detail.is_paused));
    for (const type of ["driver", "part:run", "part:past"]) this.#panel.addEventListener(type, () => this.#drawSoon());
    addEventListener("pagehide", () => this.#stopAll());
    document.addEventListener("freeze", () => this.#stopAll(FROZEN)); // else the world would wait for it in vain
  }

  /** @param {Emitter<{change: null, decision: Decision}> & {agent: string}} run the run, or the test */
  #watch(run) {
    run.addEventListener("decision", ({ detail }) => {
      this.#timeline.add(detail.episode, detail.number, detail.source, detail);
      this.#panel.program = { agent: run.agent, episode: detail.episode, isTest: run === this.#test };
    });
    run.addEventListener("change", () => {
      this.#panel.hasProgram = this.#active.isOn && this.#active.phase !== "loading";
      this.#drawSoon();
    });
  }

  // -- the program -------------------------------------------------------------------------------

  /** Show the program of the present agent and scene. */
  #open() {
    const scene = this.#panel.part("scene")?.scene ?? "scene";
    const key = `${scene}-${this.#agent.id}`;
    if (key === this.#key) return;
    this.#run.stop();
    this.#test.clear();
    this.#reports.end();
    this.#key = key;
    this.#timeline.clear();
    this.#clear();
    this.#program.open(scene, this.#agent.id, startProgram(this.#names));
    const next = this.#next;
    this.#next = null;
    if (next?.example.scene === scene) this.#takeExample(next.example, next.isOfBlocks);
  }

  /**
   * Take an example in its own scene.
   * @param {Example} example
   */
  async #chooseExample(example) {
    const isOfBlocks = this.#blocks.isWanted;
    if (this.#panel.part("scene")?.scene === example.scene) {
      this.#takeExample(example, isOfBlocks, true);
      return;
    }
    this.#next = { example, isOfBlocks };
    const { ok } = await this.#panel.send("open_scene", { name: example.scene, is_saved: false });
    if (!ok) this.#next = null;
  }

  /**
   * Add an example to the person's programs.
   * @param {Example} example
   * @param {boolean} isOfBlocks
   * @param {boolean} [isLast] false if the robot's own part may still be on its way
   * @returns {Promise<void>}
   */
  async #takeExample(example, isOfBlocks, isLast = false) {
    const part = this.#panel.part("python");
    const made = await exampleProgram(example, part);
    if (made === null && this.#panel.part("python") !== part) return this.#takeExample(example, isOfBlocks, isLast); // it came meanwhile
    if (made === null && !isLast) {
      this.#panel.addEventListener("part:python", () => this.#takeExample(example, isOfBlocks, true), { once: true });
      return;
    }
    if (made === null) {
      this.#panel.notice(t("The example needs the robot of {scene}, and this one has other senses. Open the scene again.", { scene: example.sceneTitle }), "error");
      return;
    }
    const text = isOfBlocks ? joinProgram(made.python, made.blocks, true) : made.python;
    if (!this.#program.add(example.title, text)) return;
    this.#root.scrollIntoView(); // the examples stand below the editor
    this.#panel.notice(t("This is a new program. Choose another one in the list above it."));
  }

  /** @param {string} text */
  #showProgram(text) {
    this.#editor.text = this.#blocks.take(text);
    this.#forget();
  }

  #onChange() {
    this.#program.changed(this.#blocks.join(this.#editor.text));
    this.#markRan([]);
  }

  // -- runs --------------------------------------------------------------------------------------

  /**
   * Begin to run, or make a step. Returns true: the key is used.
   * @param {"run" | "step"} way
   * @param {Parameters<CodeRun["run"]>[2]} [from] of a run
   */
  #go(way, from = {}) {
    if (this.#agent === null) return true;
    if (this.#run.phase === "waiting") {
      this.#run.goOn(way === "step");
      return true;
    }
    this.#test.stop();
    this.#active = this.#run;
    const source = this.#editor.text;
    if (this.#run.phase === "off" || way === "run") this.#clear();
    this.#noteStart(source);
    // checks of a mission count decisions: on a slow computer, most would be missing
    const isWaitedFor = ["open", "hidden"].includes(document.documentElement.dataset.ai4uMission);
    if (way === "run") this.#run.run(source, this.#agent.id, { ...from, isWaitedFor });
    else this.#run.step(source, this.#agent.id);
    return true;
  }

  /**
   * Take other breakpoints, also while a program runs.
   * @param {number[]} lines
   * @param {number | null} added the one that was set; null for none
   */
  #setStops(lines, added) {
    this.#run.stops = lines;
    const words = added === null ? "" : t("The program will wait at line {line}.", { line: added });
    const all = t("Breakpoints: line {lines}", { lines: [...lines].sort((a, b) => a - b).join(", ") });
    setText(this.#stopsText, lines.length ? [words, all].filter(Boolean).join(" ") : "");
  }

  /**
   * Let the world wait with the program, unless that disturbs another person, or go on.
   * @param {boolean} on
   */
  async #holdAtBreakpoint(on) {
    this.#isHeld = false;
    const isNews = on ? this.#isAlone : this.#hasPaused;
    this.#hasPaused = on && isNews;
    if (isNews) await this.#panel.send(on ? "pause" : "resume", {}, { quiet: true });
  }

  /**
   * Go on if the person lets the world go on while the program waits.
   * @param {boolean} isPaused
   */
  #followPause(isPaused) {
    if (this.#run.phase !== "waiting") return;
    if (this.#isHeld && !isPaused) this.#run.goOn(false);
    this.#isHeld = isPaused;
  }

  /**
   * Let the program drive from some starts, for "Try many"; the promise rejects with a sentence if it can't go on.
   * @param {number[]} seeds
   * @returns {Promise<import("./test.js").Start[]>}
   */
  async driveFrom(seeds) {
    if (this.#agent === null) throw new Error(t("This robot has no program. Open the tab Code first."));
    this.#runTest(seeds);
    return new Promise((resolve, reject) => {
      const end = (/** @type {CustomEvent<RunEnd>} */ { detail: { reason, text } }) =>
        reason === "tested" ? resolve(this.#test.rows) : reject(new Error(text || t("stopped")));
      this.#test.addEventListener("end", end, { once: true });
    });
  }

  /** @param {number[]} [seeds] */
  #runTest(seeds) {
    if (this.#agent === null) return;
    this.#stopAll();
    this.#panel.driving?.letGo(); // else whoever drove just before would go on
    this.#active = this.#test;
    this.#clear();
    this.#noteStart(this.#editor.text);
    this.#test.run(this.#editor.text, this.#agent.id, seeds);
  }

  /**
   * Begin an episode with a seed, for the person to watch.
   * @param {number} seed
   */
  #begin(seed) {
    this.#stopAll();
    this.#panel.send("seed", { seed: String(seed) });
  }

  #stopAll(text = "") {
    this.#run.stop(text);
    this.#test.stop(text);
  }

  /**
   * Keep a program that runs, and forget how the one before ended.
   * @param {string} source
   */
  #noteStart(source) {
    this.#forget();
    this.#program.ran(this.#blocks.join(source));
  }

  /** Forget how the run before ended. */
  #forget() {
    this.#end = this.#latest = null;
    this.#mistakeText.textContent = "";
    this.#goTo.remove();
    this.#markMistake(null);
    this.#markRan([]);
    this.#variables.update({});
    this.#drawSoon();
  }

  /** Empty the output, and the curves of the variables. */
  #clear() {
    this.#console.clear();
    this.#variables.clear();
  }

  /** @param {RunEnd & {summary?: string}} end */
  #onEnd(end) {
    this.#end = end;
    setText(this.#mistakeText, end.line === null ? end.text : t("Line {line}: {text}", { line: end.line, text: end.text }));
    if (end.line !== null) {
      this.#mistake.append(this.#goTo);
      this.#markMistake(end.line);
    }
    if (end.reason === "mistake") this.#hold();
    this.#noteOutcome();
    this.#drawSoon();
  }

  /** Note the world's word for the end of the episode: it may come before the program's end or after it. */
  #noteOutcome() {
    const run = this.#panel.part("run");
    if (this.#end?.reason === "over" && run?.result && run.decision === this.#end.percept.step) this.#end.outcome ??= run.result;
  }

  /** Let the world wait while the person looks for a mistake, unless that disturbs another person. */
  #hold() {
    if (this.#isAlone) this.#panel.send("pause", {}, { quiet: true });
  }

  async #warm() {
    try {
      await retried(() => this.#run.warm());
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

  /** True unless another person drives in this world, too. */
  get #isAlone() {
    const agents = this.#panel.part("scene")?.agents ?? [];
    return !agents.some(({ id, is_person: isPerson }) => isPerson && id !== this.#agent.id);
  }

  /** Let a paused world run; a network that is watched gives the robot back first. */
  async #wake() {
    if (this.#panel.watch?.isOn) await this.#panel.watch.stop();
    if (this.#panel.part("run")?.is_paused) await this.#panel.send("resume", {}, { quiet: true });
  }

  /** Begin an episode with the same start, unless that disturbs another person. */
  async #tryAgain() {
    if (!this.#isAlone) return false;
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
      this.#drawDecision();
    });
  }

  /** Show what the program did at the latest decision, or at the one to which the person went back. */
  #drawDecision() {
    const past = this.#panel.part("past");
    const playing = past?.is_showing ? past.playing : null;
    const isBack = this.#isBack;
    this.#isBack = playing !== null;
    const { moment } = this.#run;
    this.#editor.markWaiting(moment?.line ?? null);
    if (moment !== null) {
      this.#moment.update(null);
      this.#drawTold({ lines: [], printed: "", variables: moment.variables }, false);
      return;
    }
    if (playing === null) {
      this.#moment.update(null);
      if (this.#latest !== null) this.#drawTold(this.#latest, this.#latest.source === this.#editor.text);
      else if (isBack) this.#drawTold(null, false);
      return;
    }
    const told = this.#timeline.at(playing.world_episode, playing.step + 1);
    const isSame = told?.source === this.#editor.text;
    this.#moment.update(playing, told, isSame);
    this.#drawTold(told, isSame);
  }

  /**
   * @param {Told | null} told
   * @param {boolean} isSame
   */
  #drawTold(told, isSame) {
    this.#markRan(isSame ? told.lines : []);
    this.#variables.update(told?.variables ?? {});
  }

  /** @param {number[]} lines */
  #markRan(lines) {
    this.#editor.markRan(lines);
    this.#blocks.markRan(lines);
  }

  /** @param {number | null} line */
  #markMistake(line) {
    this.#editor.markMistake(line);
    this.#blocks.markMistake(line);
  }

  #drawState() {
    const { phase, decision, isOn } = this.#active;
    const [{ success }, { start }] = [this.#run, this.#test];
    const isPaused = Boolean(this.#panel.part("run")?.is_paused);
    const waitsAt = this.#run.moment?.line ?? null;
    const isWaiting = phase === "waiting";
    for (const each of [this.#start, this.#here, this.#step, this.#tryOut]) each.hidden = isWaiting;
    this.#goOn.hidden = this.#nextLine.hidden = !isWaiting;
    const shown = { phase, waitsAt, decision, success, start, isPerson: this.#isPerson, isPaused, python: this.#python, end: this.#end };
    const { kind, text, count } = runWords(shown);
    setText(this.#state, text);
    setAttributes(this.#state, { title: text }); // it may be cut
    setText(this.#count, count);
    setAttributes(this.#stateRow, { "data-kind": kind });
    this.#stop.disabled = !isOn;
    this.#testTable.update(this.#test);
    this.#mistake.hidden = !this.#mistakeText.textContent;
  }
}
