/** Our panel beside viser's canvas: its frame, its tabs, and what they share. */

/** @import { Commands, PanelParts, Show } from "../generated/messages.js" */
import { button, element, setAttributes } from "../shared/dom.js";
import { openDialog } from "./dialog.js";
import { DriveTab } from "./drive/tab.js";
import { focusWorld, returnFocus } from "./focus.js";
import { Layout } from "./layout.js";
import { Notices } from "./notices.js";
import { segments } from "./widgets/parts.js";
import { RunControls } from "./run.js";
import { installShortcuts } from "./shortcuts.js";
import { ScenePicker } from "./scenes.js";
import { PanelSocket } from "./socket.js";
import { Tabs } from "./tabs.js";
import { ViewControls } from "./view.js";
import { retried } from "../shared/retry.js";
import { recall, remember } from "../shared/storage.js";

const TABS = [["drive", "Drive"], ["build", "Build"], ["world", "World"], ["code", "Code"], ["past", "Past"]];
const MAX_FILE_NAME_CHARS = 80;
/** Name of the part that a tab shows; that of an option's tab is the tab's own. */
const PART_OF_TAB = { drive: "agent", build: "blocks", world: "world", code: "agent", past: "past" };
/** Modules of the tabs that are loaded when they are first opened. */
const LOADERS = {
  drive: async () => DriveTab,
  build: async () => (await import("./build/tab.js")).BuildTab,
  world: async () => (await import("./world/tab.js")).WorldTab,
  code: async () => (await import("../code/tab.js")).CodeTab,
  past: async () => (await import("./past/tab.js")).PastTab,
};

/**
 * Make the panel and put it into the page.
 * @param {{agent: string | null, take: () => void, letGo: () => void}} driving the agent in the page's address or null, and
 *   how a person drives it
 * @param {HTMLElement} dock the keys on the screen
 */
export function startPanel(driving, dock) {
  const panel = new Panel(driving, window.ai4uPageId);
  panel.start(dock);
  installShortcuts(panel);
  return panel;
}

export class Panel extends EventTarget {
  /**
   * The parts that this page looks at.
   * @type {Omit<Show, "type">}
   */
  shown;
  /** True while a program of this page has the agent. */
  hasProgram = false;
  /** The latest episode in which a program of this page decided: {agent, episode, isTest}; null if there is none. */
  program = null;
  /** The person drives with it: {agent, take(), letGo()} of the page. */
  driving;
  #parts = new Map();
  #loaders = { ...LOADERS };
  #opened = new Map();
  #socket;
  #run;
  #notices = new Notices();
  #body = element("div", { className: "ai4u-panel-body" });
  #fold = button("", () => this.layout.fold(!this.layout.isFolded), { label: "Fold the panel", kind: "quiet", icon: "down" });
  #modes = segments("How much to show", [
    { value: "simple", text: "Simple" },
    { value: "details", text: "Details" },
  ], (mode) => this.#setDetails(mode === "details"));
  #undo = button("", () => this.send("undo"), { icon: "undo", label: "Undo", kind: "quiet" });
  #redo = button("", () => this.send("redo"), { icon: "redo", label: "Redo", kind: "quiet" });
  #tabs = new Tabs(TABS, (name, root) => this.#openTab(name, root));
  details = recall("panel-details", false);
  layout = new Layout((isFolded) => this.#onFold(isFolded));
  element = element("aside", { className: "ai4u-panel", ariaLabel: "Panel" });

  constructor(driving, pageId) {
    super();
    this.driving = driving;
    this.shown = { agent: driving.agent ?? "", tabs: [], block: null, body: null, episode: null };
    const query = new URLSearchParams({ page: pageId, ...(driving.agent === null ? {} : { agent: driving.agent }) });
    this.#socket = new PanelSocket(`ws/panel?${query}`);
    this.#socket.onconnected = (isConnected) => this.#onConnected(isConnected);
    this.#socket.onmessage = (message) => this.#receive(message);
    const scenes = new ScenePicker(this);
    const head = element("header", { className: "ai4u-panel-head" }, scenes.element, this.#modes.element, this.#fold);
    const history = element("div", { className: "ai4u-history" }, this.#undo, this.#redo);
    this.#run = new RunControls(this);
    this.#body.append(
      element("div", { className: "ai4u-panel-top" }, this.#run.element, new ViewControls(this, history).element),
      element("div", { className: "ai4u-panel-rest" }, ...this.#tabs.elements),
    );
    this.element.append(this.layout.handle, head, this.#body, this.#notices.element);
    returnFocus(this.element);
    this.#setDetails(this.details);
    this.addEventListener("part:scene", (event) => this.#onScene(/** @type {CustomEvent} */ (event).detail));
    this.addEventListener("part:tabs", (event) => this.#addTabs(/** @type {CustomEvent} */ (event).detail));
  }

  /** Put the panel into the page and connect it. */
  start(dock) {
    document.body.append(this.element);
    this.layout.arrange();
    this.layout.observeDock(dock);
    this.#tabs.start();
    this.#socket.open();
  }

  /**
   * Send a command. The promise never rejects: it gives {ok: true, text, ...} or {ok: false, text, problems, ...}.
   * An error is shown, unless problems tell a form more; the text of a result is, unless `quiet` is set.
   * @template {keyof Commands} Name
   * @param {Name} command
   * @param {Commands[Name]} [args]
   * @param {{quiet?: boolean}} [options]
   * @returns {Promise<any>}
   */
  async send(command, args, { quiet = false } = {}) {
    const answer = await this.#socket.command(command, args);
    if (!answer.ok && !answer.problems.length) this.notice(answer.text, "error");
    else if (answer.ok && !quiet) this.notice(answer.text);
    return answer;
  }

  /**
   * Send a file, and a command about it.
   * @param {"load_text" | "open_recording"} command
   * @param {File} file
   */
  async sendFile(command, file) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    this.#socket.upload(bytes);
    return this.send(command, { name: file.name.slice(-MAX_FILE_NAME_CHARS), size: bytes.length });
  }

  /**
   * Change what this page looks at.
   * @param {Partial<Show>} changes
   */
  show(changes) {
    const before = this.shown;
    this.shown = { ...before, ...changes };
    if (JSON.stringify(before) === JSON.stringify(this.shown)) return;
    this.#socket.show(this.shown);
    if (before.agent !== this.shown.agent) this.dispatchEvent(new Event("agent"));
  }

  /** Say something in a fixed place; level "error" stays until it is closed. @param action as of Notices.show */
  notice(text, level = "info", action = null) {
    this.#notices.show(text, level, action);
  }

  /**
   * Return the latest part of a name, or null.
   * @template {string} Name
   * @param {Name} name
   * @returns {(Name extends keyof PanelParts ? PanelParts[Name] : any) | null}
   */
  part(name) {
    return this.#parts.get(name) ?? null;
  }

  openTab(name) {
    this.#tabs.choose(name);
  }

  /** Open a modal window: {dialog, body, close()}. */
  dialog(title, ...children) {
    return openDialog(title, ...children);
  }

  focusWorld() {
    focusWorld();
  }

  /** Name this page's own program, which the server knows as a script like any other. */
  named(hello) {
    const rename = (driver) => (driver && this.hasProgram ? "Your program" : driver);
    return { ...hello, others: rename(hello.others), instead: rename(hello.instead) };
  }

  /** Show who drives: the arguments of DriverStatus.draw. */
  drawDriver(status) {
    this.driver = status;
    if (status.hello.agent && !this.shown.agent) this.show({ agent: status.hello.agent });
    this.dispatchEvent(new CustomEvent("driver", { detail: status }));
  }

  /** Show the best time (s) of whoever drives, the person or the program; nothing for null or "". */
  drawBest(time, isPrograms) {
    this.#run.drawBest(time, isPrograms);
  }

  #setDetails(isOn) {
    this.details = isOn;
    remember("panel-details", isOn);
    this.#modes.set(isOn ? "details" : "simple");
    document.documentElement.toggleAttribute("data-ai4u-details", isOn);
    this.dispatchEvent(new Event("details"));
  }

  #onFold(isFolded) {
    const label = isFolded ? "Open the panel" : "Fold the panel";
    setAttributes(this.#fold, { "aria-expanded": isFolded ? "false" : "true", "aria-label": label, title: label });
    this.#body.inert = isFolded;
  }

  #onConnected(isConnected) {
    this.element.toggleAttribute("data-lost", !isConnected);
    if (isConnected) this.#socket.show(this.shown);
    this.dispatchEvent(new Event(isConnected ? "connected" : "disconnected"));
  }

  #receive(message) {
    if (message.type === "part") {
      this.#parts.set(message.name, message);
      this.dispatchEvent(new CustomEvent(`part:${message.name}`, { detail: message }));
      if ((PART_OF_TAB[this.#tabs.open] ?? this.#tabs.open) === message.name) this.#opened.get(this.#tabs.open)?.update(message);
      this.#showHistory();
    } else if (message.type === "note") {
      this.notice(message.text, message.level);
    } else if (message.type === "stand_in") {
      this.dispatchEvent(new CustomEvent("stand_in", { detail: message }));
    } else if (message.type === "selected") {
      if (message.agent) this.show({ agent: message.agent });
      this.dispatchEvent(new CustomEvent("selected", { detail: message }));
    }
  }

  /** @param {PanelParts["scene"]} scene */
  #onScene(scene) {
    this.#tabs.setVisible("build", scene.can_edit);
    this.#tabs.setVisible("world", scene.can_edit);
    this.#tabs.setVisible("code", scene.agents.length > 0);
    this.#tabs.setVisible("past", scene.has_past);
    const isThere = scene.agents.some(({ id }) => id === this.shown.agent);
    if (!isThere && scene.agents.length) this.show({ agent: scene.agents[0].id });
  }

  /** Add the tabs of options: {tabs: [{name, title}]}. */
  #addTabs({ tabs }) {
    for (const { name, title } of tabs) {
      if (name in this.#loaders) continue; // the part comes again after a reconnect
      this.#loaders[name] = async () => (await import(`../options/${name}.js`)).Tab;
      this.#tabs.add(name, title);
    }
  }

  async #openTab(name, root) {
    const parts = name === "code" ? [PART_OF_TAB.code, PART_OF_TAB.past] : [PART_OF_TAB[name] ?? []].flat();
    this.show({ tabs: parts });
    this.#showHistory();
    if (!this.#opened.has(name)) {
      this.#opened.set(name, null);
      try {
        const Tab = await retried(this.#loaders[name]);
        this.#opened.set(name, new Tab(root, this));
      } catch (error) {
        this.#opened.delete(name);
        this.notice(`This tab could not be loaded: ${error.message}. Reload the page.`, "error");
        return;
      }
    }
    const part = this.part(PART_OF_TAB[name] ?? name);
    if (part !== null && this.#tabs.open === name) this.#opened.get(name)?.update(part);
  }

  /** Show the buttons to undo and redo while a tab is open that changes the scene. */
  #showHistory() {
    const part = ["build", "world"].includes(this.#tabs.open) ? this.part(PART_OF_TAB[this.#tabs.open]) : null;
    for (const [control, name, label] of [[this.#undo, "Undo", part?.undo?.label], [this.#redo, "Redo", part?.redo?.label]]) {
      control.hidden = part === null;
      control.disabled = !label;
      setAttributes(control, { "aria-label": `${name} ${label || ""}`.trim(), title: `${name} ${label || ""}`.trim() });
    }
  }
}
