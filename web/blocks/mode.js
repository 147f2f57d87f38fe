/** A program of blocks in the tab "Code": the switch to blocks and back, and the Python that they mean. */

/** @import { PythonPart } from "../generated/messages.js" */
/** @import { Panel } from "../panel/panel.js" */
/** @import { AgentBlocks } from "./agent.js" */
/** @import { Program } from "./text.js" */
/** @import { BlocksWorkspace } from "./workspace.js" */

import { freeId } from "../shared/ids.js";
import { joinProgram, splitProgram } from "./text.js";
import { button, element, setText } from "../shared/dom.js";
import { segments } from "../panel/widgets/parts.js";
import { retried } from "../shared/retry.js";
import { t } from "../shared/text.js";

const FAILED = t("The blocks could not be loaded. Is the world still running? Reload the page.");
const DAMAGED = t("The blocks of this program are damaged. This is the Python that came with them.");
const HELP = t("T opens the blocks to choose from; arrow keys go to a block, Enter takes or changes it, M moves it, and Delete removes it. Shift+Alt+A turns on more words for a screen reader. Tab goes on.");

/** @typedef {typeof import("./agent.js") & typeof import("./python.js") & typeof import("./workspace.js")} Modules */

export class BlocksMode {
  /**
   * Called with true or false when the person sees blocks, or no longer.
   * @type {(isOn: boolean) => void}
   */
  onSwitch = () => {};
  #tab;
  #panel;
  /** @type {PythonPart | null} */
  #part = null;
  #agentText = "";
  /** @type {AgentBlocks | null} */
  #agent = null;
  /**
   * The blocks of the program, also of one that went on in Python; null if there are none.
   * @type {Program | null}
   */
  #blocks = null;
  #isOn = false;
  /** True while the first blocks are loaded that the person wants to see. */
  #isOpening = false;
  /**
   * The modules that are loaded with the first blocks.
   * @type {Modules | null}
   */
  #loaded = null;
  /** @type {BlocksWorkspace | null} */
  #workspace = null;
  /** Resolves when the latest blocks are shown. */
  #shown = Promise.resolve();
  /**
   * Ids of blocks by line.
   * @type {string[]}
   */
  #blockOfLine = [];
  #ways = segments(t("Write the program in"), [
    { value: "python", text: "Python", title: t("The Python becomes yours to change; the blocks are kept") },
    { value: "blocks", text: t("Blocks"), title: t("Put the program together from blocks") },
  ], (way) => (way === "blocks" ? this.open() : this.#toPython()));
  #words = element("p", { className: "ai4u-soft", role: "status" });
  #help = element("p", { className: "ai4u-soft ai4u-blocks-keys", id: freeId(), textContent: HELP });
  #frame = element("div", { className: "ai4u-blocks-editor" });
  bar = this.#ways.element;
  element = element("div", { className: "ai4u-blocks", dataset: { ai4uKeys: "" } }, this.#words, this.#frame, this.#help);

  /**
   * @param {Panel} panel
   * @param {object} tab
   * @param {import("../code/editor.js").CodeEditor} tab.editor shows the blocks' Python
   * @param {() => void} tab.changed called when the person has changed the blocks
   * @param {(text: string) => void} tab.replace called with another program
   * @param {(way: "run" | "step") => void} tab.run called when the person runs the program with a shortcut
   */
  constructor(panel, tab) {
    this.#panel = panel;
    this.#tab = tab;
    this.#frame.addEventListener("keydown", (event) => this.#onKey(event), { capture: true });
    this.element.addEventListener("keydown", (event) => event.stopPropagation());
    this.#draw();
  }

  get isOn() {
    return this.#isOn;
  }

  /** True also while the blocks are loaded. */
  get isWanted() {
    return this.#isOn || this.#isOpening;
  }

  /**
   * Offer the blocks of an agent.
   * @param {PythonPart} part
   */
  async setAgent(part) {
    const text = JSON.stringify([part.sensors, part.actuators]);
    if (text === this.#agentText) return;
    [this.#agentText, this.#part] = [text, part];
    if (this.#loaded === null) return;
    this.#agent = this.#loaded.agentBlocks(part);
    this.#workspace?.setAgent(this.#agent);
    if (this.#isOn) this.#show(this.#blocks);
  }

  /**
   * Return a program as it is kept: its Python, and the blocks.
   * @param {string} python
   */
  join(python) {
    return joinProgram(python, this.#blocks, this.#isOn);
  }

  /**
   * Take a program that is shown: return its Python, and show its blocks if it is of blocks.
   * @param {string} text
   */
  take(text) {
    const { python, blocks, isOfBlocks } = splitProgram(text);
    this.#isOpening = false; // that was for the program before
    this.#blocks = blocks;
    this.#set(isOfBlocks);
    if (isOfBlocks) this.#shown = this.#show(blocks);
    return python;
  }

  /**
   * Mark the blocks of lines that ran.
   * @param {number[]} lines
   */
  markRan(lines) {
    if (this.#isOn) this.#workspace?.markRan(lines.map((line) => this.#blockOfLine[line - 1]).filter(Boolean));
  }

  /**
   * Mark the block of a line with a mistake; null removes the mark.
   * @param {number | null} line
   */
  markMistake(line) {
    if (this.#isOn) this.#workspace?.markMistake(line === null ? "" : (this.#blockOfLine[line - 1] ?? ""));
  }

  /**
   * Put the focus onto the block of a line. Returns false if there is none.
   * @param {number} line
   */
  goTo(line) {
    const block = this.#isOn ? this.#blockOfLine[line - 1] : "";
    if (block) this.#workspace.goTo(block);
    return Boolean(block);
  }

  // -- the switch --------------------------------------------------------------------------------

  /** Show the program's blocks, or a first one. */
  async open() {
    if (this.isWanted) return;
    this.#isOpening = true;
    const modules = await this.#load();
    if (!this.#isOpening) return;
    this.#isOpening = false;
    if (modules === null || this.#part === null) return;
    const blocks = this.#blocks ?? modules.FIRST_BLOCKS;
    const { text } = modules.pythonOf(blocks, this.#agent);
    this.#tab.replace(joinProgram(text, blocks, true));
    this.#panel.notice(t("Your Python is kept under Earlier runs."));
    await this.#shown;
    this.#workspace?.focus();
  }

  #toPython() {
    if (!this.#isOn) return;
    this.#set(false);
    this.#tab.changed();
    this.#tab.editor.focus();
  }

  /** @param {boolean} isOn */
  #set(isOn) {
    this.#isOn = isOn;
    this.#tab.editor.isReadOnly = isOn;
    this.#draw();
    this.onSwitch(isOn);
  }

  #draw() {
    this.#frame.hidden = this.#help.hidden = !this.#isOn;
    this.#ways.set(this.#isOn ? "blocks" : "python");
    this.#say("");
  }

  /** @param {string} text */
  #say(text) {
    setText(this.#words, text);
    this.#words.hidden = !text;
    this.element.hidden = !text && !this.#isOn;
  }

  // -- the blocks --------------------------------------------------------------------------------

  /** @param {Program} blocks */
  async #show(blocks) {
    const modules = await this.#load();
    if (modules === null || !this.#isOn || blocks !== this.#blocks) return;
    this.#workspace ??= this.#makeWorkspace(modules);
    this.#workspace.resize();
    try {
      this.#workspace.load(blocks);
      this.#write();
    } catch {
      this.#set(false); // the text of a program may come from anybody
      this.#say(DAMAGED);
    }
  }

  /** @param {Modules} modules */
  #makeWorkspace(modules) {
    const made = new modules.BlocksWorkspace(this.#frame, {
      label: t("Program of blocks"),
      agent: this.#agent,
      ask: (question, start) => this.#ask(question, start),
    });
    made.onChange = () => {
      this.#blocks = made.blocks;
      this.#write();
      this.#tab.changed();
    };
    return made;
  }

  /** Show the Python of the blocks. */
  #write() {
    const { text, blocks } = this.#loaded.pythonOf(this.#workspace.state, this.#agent);
    this.#blockOfLine = blocks;
    this.#tab.editor.text = text;
  }

  async #load() {
    if (this.#loaded !== null) return this.#loaded;
    this.#say(t("Loading the blocks …"));
    try {
      const names = ["agent", "python", "workspace"];
      const modules = await retried(() => Promise.all(names.map((name) => import(`./${name}.js`))));
      const loaded = Object.assign({}, ...modules);
      await retried(loaded.setBlocklyLanguage);
      this.#loaded = loaded;
    } catch {
      this.#say(FAILED);
      return null;
    }
    if (this.#part !== null) this.#agent = this.#loaded.agentBlocks(this.#part);
    this.#draw();
    return this.#loaded;
  }

  /**
   * Ask the person for a name; null if there is no answer.
   * @param {string} question
   * @param {string} start
   * @returns {Promise<string | null>}
   */
  #ask(question, start) {
    return new Promise((resolve) => {
      const input = element("input", { type: "text", value: start, maxLength: 40, id: freeId() });
      const label = element("label", { htmlFor: input.id, textContent: question });
      const form = element("form", { method: "dialog", className: "ai4u-blocks-name" }, label, input, button(t("OK"), () => form.requestSubmit(), { kind: "main" }));
      /** @type {string | null} */
      let answer = null;
      form.addEventListener("submit", () => (answer = input.value.trim() || null));
      const { dialog } = this.#panel.dialog(t("Memory"), form);
      dialog.addEventListener("close", () => resolve(answer));
      input.select();
    });
  }

  /** Ctrl+Enter runs, as in the editor of Python. */
  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
    event.preventDefault();
    event.stopPropagation();
    this.#tab.run(event.shiftKey ? "step" : "run");
  }
}
