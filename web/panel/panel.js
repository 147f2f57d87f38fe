/** Our panel beside viser's canvas: its frame, its tabs, and what they share. */

/**
 * @import { Commands, ScenePart, Show } from "../generated/messages.js"
 * @import { DriverView } from "../page/driver_status.js"
 * @import { EmitterClass } from "../types/events.js"
 * @import { AnswerTo, PanelEvents, PanelMessage, Parts, TabsPart } from "../types/panel.js"
 * @import { NoticeAction } from "./notices.js"
 * @import { Palette } from "./world/palette.js"
 */
import { button, element, setAttributes, setText } from "../shared/dom.js";
import { openDialog } from "./dialog.js";
import { DriveTab } from "./drive/tab.js";
import { focusWorld, returnFocus } from "./focus.js";
import { MissionCard } from "../missions/card.js";
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
import { t } from "../shared/text.js";

const TABS = [["drive", t("Drive")], ["build", t("Build")], ["world", t("World")], ["code", t("Code")], ["past", t("Past")]];
const MAX_FILE_NAME_CHARS = 80;
/**
 * Name of the part that a tab shows; that of an option's tab is the tab's own.
 * @type {Record<string, Show["tabs"][number]>}
 */
const PART_OF_TAB = { drive: "agent", build: "blocks", world: "world", code: "agent", past: "past" };
/** @type {Record<string, Show["tabs"]>} parts that tabs need besides their own */
const MORE_PARTS = { code: ["past"], build: ["world"] };
const BUILDING = ["build", "world"];
/** @typedef {{update(part: Parts[keyof Parts]): void}} Tab takes each part of its name */
/** @typedef {new (root: HTMLElement, panel: Panel) => Tab} TabClass */
/** @typedef {{agent: string | null, take: () => void, letGo: () => void}} Driving */

/**
 * Modules of the tabs that are loaded when they are first opened.
 * @type {Record<string, () => Promise<TabClass>>}
 */
const LOADERS = {
  drive: async () => DriveTab,
  build: async () => (await import("./build/tab.js")).BuildTab,
  world: async () => (await import("./world/tab.js")).WorldTab,
  code: async () => (await import("../code/tab.js")).CodeTab,
  past: async () => (await import("./past/tab.js")).PastTab,
};

/**
 * Make the panel and put it into the page.
 * @param {Driving} driving the agent in the page's address or null, and how a person drives it
 * @param {HTMLElement} dock the keys on the screen
 */
export function startPanel(driving, dock) {
  const panel = new Panel(driving, window.ai4uPageId);
  panel.start(dock);
  installShortcuts(panel);
  return panel;
}

export class Panel extends /** @type {EmitterClass<PanelEvents>} */ (EventTarget) {
  /**
   * The parts that this page looks at.
   * @type {Omit<Show, "type">}
   */
  shown;
  /**
   * The things to add to the world, once a tab has been open that builds it.
   * @type {Palette | null}
   */
  palette = null;
  /** True while a program of this page has the agent. */
  hasProgram = false;
  /**
   * Way in which the program in the tab "Code" is written; empty before that tab was open.
   * @type {"" | "python" | "blocks"}
   */
  programWay = "";
  /**
   * The latest episode in which a program of this page decided; null if there is none.
   * @type {{agent: string, episode: number, isTest: boolean} | null}
   */
  program = null;
  /** The person drives with it. */
  driving;
  /**
   * The driver; null before it is known.
   * @type {DriverView | null}
   */
  driver = null;
  /** The latest parts by name; those that have not come yet are missing. */
  #parts = /** @type {Parts} */ ({});
  #loaders = { ...LOADERS };
  /**
   * Tabs by name; null while one is loaded.
   * @type {Map<string, Tab | null>}
   */
  #opened = new Map();
  #socket;
  #run;
  #notices = new Notices();
  #body = element("div", { className: "ai4u-panel-body" });
  #fold = button("", () => this.layout.fold(!this.layout.isFolded), { label: t("Fold the panel"), kind: "quiet", icon: "down" });
  #modes = segments(t("How much to show"), [
    { value: "simple", text: t("Simple") },
    { value: "details", text: t("Details") },
  ], (mode) => this.#setDetails(mode === "details"));
  #more = button("", () => this.#foldTop(!this.#isTopFolded), { icon: "down", label: t("Goal, score and camera"), kind: "quiet" });
  #top = element("div", { className: "ai4u-panel-top" });
  /** Headings for screen readers: the scene, and what can be done with it. */
  #heading = element("h1", { className: "ai4u-hidden-text" });
  #undo = button("", () => this.send("undo"), { icon: "undo", label: t("Undo"), kind: "quiet" });
  #redo = button("", () => this.send("redo"), { icon: "redo", label: t("Redo"), kind: "quiet" });
  #tabs = new Tabs(TABS, (name, root) => this.#openTab(name, root));
  /** @type {boolean} */
  details = recall("panel-details", false);
  layout = new Layout((isFolded) => this.#onFold(isFolded));
  element = element("aside", { className: "ai4u-panel", ariaLabel: t("Panel") });

  /**
   * @param {Driving} driving
   * @param {string} pageId
   */
  constructor(driving, pageId) {
    super();
    this.driving = driving;
    this.shown = { agent: driving.agent ?? "", tabs: [], block: null, body: null, others: [], episode: null };
    const query = new URLSearchParams({ page: pageId, ...(driving.agent === null ? {} : { agent: driving.agent }) });
    this.#socket = new PanelSocket(`ws/panel?${query}`);
    this.#socket.onconnected = (isConnected) => this.#onConnected(isConnected);
    this.#socket.onmessage = (message) => this.#receive(message);
    const scenes = new ScenePicker(this);
    const head = element("header", { className: "ai4u-panel-head" }, this.#heading, scenes.element, this.#modes.element, this.#fold);
    const history = element("div", { className: "ai4u-history" }, this.#undo, this.#redo);
    this.#run = new RunControls(this);
    this.#top.append(this.#run.element, new ViewControls(this, history).element, this.#more);
    this.#body.append(
      this.#top,
      element("div", { className: "ai4u-panel-rest" }, element("h2", { className: "ai4u-hidden-text", textContent: t("Tabs") }), ...this.#tabs.elements),
    );
    const mission = new MissionCard(this);
    this.element.append(this.layout.handle, head, mission.element, this.#body, this.#notices.element);
    returnFocus(this.element);
    this.#setDetails(this.details);
    this.addEventListener("part:scene", ({ detail }) => this.#onScene(detail));
    this.addEventListener("part:tabs", ({ detail }) => this.#addTabs(detail));
  }

  /**
   * Put the panel into the page and connect it.
   * @param {HTMLElement} dock the keys on the screen
   */
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
   * @returns {Promise<AnswerTo<Name>>}
   */
  async send(command, args, { quiet = false } = {}) {
    const answer = await this.#socket.command(command, args);
    if (!answer.ok && !answer.problems.length) this.notice(answer.text, "error");
    else if (answer.ok && !quiet) this.notice(answer.text);
    return /** @type {AnswerTo<Name>} */ (answer);
  }

  /**
   * Send a file, and a command about it.
   * @template {"lay_picture" | "load_text" | "open_recording" | "teach_open"} Name
   * @param {Name} command
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
    if (before.body !== this.shown.body || before.others !== this.shown.others) this.dispatchEvent(new Event("shown"));
  }

  /**
   * Say something in a fixed place; level "error" stays until it is closed.
   * @param {string} text
   * @param {string} [level]
   * @param {NoticeAction | null} [action]
   */
  notice(text, level = "info", action = null) {
    this.#notices.show(text, level, action);
  }

  /**
   * Celebrate over the picture what a robot has just reached.
   * @param {string} text
   */
  celebrate(text) {
    this.dispatchEvent(new CustomEvent("celebrate", { detail: text }));
  }

  /**
   * Return the latest part of a name, or null.
   * @template {keyof Parts} Name
   * @param {Name} name
   * @returns {Parts[Name] | null}
   */
  part(name) {
    return this.#parts[name] ?? null;
  }

  /** The network that is watched, and the race against one. */
  get watch() {
    return this.#run.watch;
  }

  /** Name of the open tab; null before the first one is open. */
  get tab() {
    return this.#tabs.open;
  }

  /** The tab "Code"; null before it was open for the first time. */
  get code() {
    return /** @type {import("../code/tab.js").CodeTab | null} */ (this.#opened.get("code") ?? null);
  }

  /** @param {string} name */
  openTab(name) {
    this.#tabs.choose(name);
  }

  /**
   * Open a modal window: {dialog, body, close()}.
   * @param {string} title
   * @param {HTMLElement[]} children
   */
  dialog(title, ...children) {
    return openDialog(title, ...children);
  }

  focusWorld() {
    focusWorld();
  }

  /**
   * Name this page's own program, which the server knows as a script like any other.
   * @param {DriverView["hello"]} hello
   */
  named(hello) {
    const rename = (/** @type {string} */ driver) => (driver && this.hasProgram ? t("Your program") : driver);
    return { ...hello, others: rename(hello.others), instead: rename(hello.instead) };
  }

  /**
   * Show who drives.
   * @param {DriverView} status
   */
  drawDriver(status) {
    this.driver = status;
    if (status.hello.agent && !this.shown.agent) this.show({ agent: status.hello.agent });
    this.dispatchEvent(new CustomEvent("driver", { detail: status }));
  }

  /**
   * Show the best time (s) of a kind of driver.
   * @param {number | null} time null for none
   * @param {string} by the kind, as of results.js
   */
  drawBest(time, by) {
    this.#run.drawBest(time, by);
  }

  /** @param {boolean} isOn */
  #setDetails(isOn) {
    this.details = isOn;
    remember("panel-details", isOn);
    this.#modes.set(isOn ? "details" : "simple");
    document.documentElement.toggleAttribute("data-ai4u-details", isOn);
    this.dispatchEvent(new Event("details"));
  }

  /** @param {boolean} isFolded */
  #onFold(isFolded) {
    const label = isFolded ? t("Open the panel") : t("Fold the panel");
    setAttributes(this.#fold, { "aria-expanded": isFolded ? "false" : "true", "aria-label": label, title: label });
    this.#body.inert = isFolded;
    this.#showPalette();
    this.dispatchEvent(new Event("tab"));
  }

  /** Show the palette while a tab is open that builds the world. */
  async #showPalette() {
    const isBuilding = () => !this.layout.isFolded && BUILDING.includes(this.#tabs.open);
    if (this.palette === null) {
      if (!isBuilding()) return;
      const { Palette: Made } = await retried(() => import("./world/palette.js"));
      if (this.palette === null) {
        this.palette = new Made(this);
        this.element.before(this.palette.element);
      }
    }
    this.palette.show(isBuilding());
  }

  /** @param {boolean} isConnected */
  #onConnected(isConnected) {
    this.element.toggleAttribute("data-lost", !isConnected);
    if (isConnected) this.#socket.show(this.shown);
    this.dispatchEvent(new Event(isConnected ? "connected" : "disconnected"));
  }

  /** @param {PanelMessage} message */
  #receive(message) {
    if (message.type === "part") {
      Object.assign(this.#parts, { [message.name]: message });
      this.dispatchEvent(new CustomEvent(`part:${message.name}`, { detail: message }));
      if (partOf(this.#tabs.open) === message.name) this.#opened.get(this.#tabs.open)?.update(message);
      this.#showHistory();
    } else if (message.type === "note") {
      this.notice(message.text, message.level);
    } else if (message.type === "stand_in") {
      this.dispatchEvent(new CustomEvent("stand_in", { detail: message }));
    } else if (message.type === "selected") {
      this.show({ body: message.body, others: [], ...(message.agent ? { agent: message.agent } : {}) });
      this.dispatchEvent(new CustomEvent("selected", { detail: message }));
    }
  }

  /** @param {ScenePart} scene */
  #onScene(scene) {
    setText(this.#heading, scene.title || document.title);
    this.#tabs.setVisible("build", scene.can_edit);
    this.#tabs.setVisible("world", scene.can_edit);
    this.#tabs.setVisible("code", scene.agents.length > 0);
    this.#tabs.setVisible("past", scene.has_past);
    const isThere = scene.agents.some(({ id }) => id === this.shown.agent);
    if (!isThere && scene.agents.length) this.show({ agent: scene.agents[0].id });
  }

  /**
   * Add the tabs of options.
   * @param {TabsPart} part
   */
  #addTabs({ tabs }) {
    for (const { name, title } of tabs) {
      if (name in this.#loaders) continue; // the part comes again after a reconnect
      this.#loaders[name] = async () => (await import(`../options/${name}.js`)).Tab;
      this.#tabs.add(name, title);
    }
  }

  /**
   * @param {string} name
   * @param {HTMLElement} root of the tab
   */
  async #openTab(name, root) {
    this.show({ tabs: name in PART_OF_TAB ? [PART_OF_TAB[name], ...(MORE_PARTS[name] ?? [])] : [] });
    this.#showHistory();
    this.layout.widen(name === "code");
    this.#showTop();
    this.#showPalette();
    this.dispatchEvent(new Event("tab"));
    if (!this.#opened.has(name)) {
      this.#opened.set(name, null);
      try {
        const Tab = await retried(this.#loaders[name]);
        this.#opened.set(name, new Tab(root, this));
      } catch (error) {
        this.#opened.delete(name);
        this.notice(t("This tab could not be loaded: {reason}. Reload the page.", { reason: error.message }), "error");
        return;
      }
    }
    const part = this.part(partOf(name));
    if (part !== null && this.#tabs.open === name) this.#opened.get(name)?.update(part);
  }

  /** True if what stands above the tabs is one row while the tab "Code" is open: a program needs the room. */
  get #isTopFolded() {
    return recall("code-top-folded", true);
  }

  /** @param {boolean} isFolded */
  #foldTop(isFolded) {
    remember("code-top-folded", isFolded);
    this.#showTop();
  }

  #showTop() {
    const isCode = this.#tabs.open === "code";
    const isFolded = isCode && this.#isTopFolded;
    this.#more.hidden = !isCode;
    setAttributes(this.#top, { "data-small": isFolded });
    setAttributes(this.#more, { "aria-expanded": isFolded ? "false" : "true" });
  }

  /** Show the buttons to undo and redo while a tab is open that changes the scene. */
  #showHistory() {
    const { open } = this.#tabs;
    const part = open === "build" ? this.part("blocks") : open === "world" ? this.part("world") : null;
    const [undo, redo] = [part?.undo?.label, part?.redo?.label];
    for (const { control, words, label } of [
      { control: this.#undo, label: undo, words: undo ? t("Undo {change}", { change: undo }) : t("Undo") },
      { control: this.#redo, label: redo, words: redo ? t("Redo {change}", { change: redo }) : t("Redo") },
    ]) {
      control.hidden = part === null;
      control.disabled = !label;
      setAttributes(control, { "aria-label": words, title: words });
    }
  }
}

/**
 * Return the name of the part that a tab shows; that of an option's tab has the tab's own name.
 * @param {string} tab
 */
function partOf(tab) {
  return /** @type {keyof Parts} */ (PART_OF_TAB[tab] ?? tab);
}
