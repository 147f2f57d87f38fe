/** The panel's tabs: a tablist with arrow keys, and a panel for each. */

import { element, setAttributes } from "../shared/dom.js";
import { recall, remember } from "../shared/storage.js";
import { t } from "../shared/text.js";

/** A phone, upright or on its side: what stands above the tabs fills the panel. */
const SMALL = matchMedia("(max-width: 576px), (max-height: 500px)");

export class Tabs {
  /**
   * Tabs by name.
   * @type {Map<string, {tab: HTMLButtonElement, panel: HTMLElement}>}
   */
  #tabs = new Map();
  #list = element("div", { className: "ai4u-tabs", role: "tablist", ariaLabel: t("Panel") });
  #panels = element("div", { className: "ai4u-tabpanels" });
  #onOpen;
  /** @type {string | null} */
  #open = null;
  /**
   * The tab that the person chose, which may be hidden just now.
   * @type {string}
   */
  #wanted;

  /**
   * @param {string[][]} tabs name and title of each
   * @param {(name: string, panel: HTMLElement) => void} onOpen called when a tab is opened
   */
  constructor(tabs, onOpen) {
    this.#onOpen = onOpen;
    for (const [name, title] of tabs) this.add(name, title);
    this.#list.addEventListener("keydown", (event) => this.#onKey(event));
    this.#wanted = recall("panel-tab", tabs[0][0]);
  }

  get elements() {
    return [this.#list, this.#panels];
  }

  /** Name of the open tab; null before `start`. */
  get open() {
    return this.#open;
  }

  start() {
    const isThere = this.#tabs.has(this.#wanted); // an option's tab is added later
    this.choose(isThere ? this.#wanted : this.#visible[0], { isWanted: isThere });
  }

  /**
   * Add a tab at the end; it opens if it is the one that the person chose.
   * @param {string} name
   * @param {string} title
   */
  add(name, title) {
    const ids = { tab: `ai4u-tab-${name}`, panel: `ai4u-tabpanel-${name}` };
    const tab = element("button", { type: "button", role: "tab", id: ids.tab, textContent: title });
    const panel = element("div", { className: "ai4u-tabpanel", role: "tabpanel", id: ids.panel, hidden: true });
    setAttributes(tab, { "aria-controls": ids.panel });
    setAttributes(panel, { "aria-labelledby": ids.tab });
    tab.addEventListener("click", () => {
      this.choose(name);
      if (SMALL.matches) this.#list.scrollIntoView(); // else only a line or two of it would be seen
    });
    this.#tabs.set(name, { tab, panel });
    this.#list.append(tab);
    this.#panels.append(panel);
    this.setVisible(name, true);
  }

  /**
   * Hide or show a tab; if the open one is hidden, the first one opens.
   * @param {string} name
   * @param {boolean} isVisible
   */
  setVisible(name, isVisible) {
    this.#tabs.get(name).tab.hidden = !isVisible;
    if (this.#open === null) return;
    const next = this.#visible.includes(this.#wanted) ? this.#wanted : this.#visible[0];
    if (next !== this.#open) this.choose(next, { isWanted: false });
  }

  /**
   * @param {string} name
   * @param {{isWanted?: boolean}} [options] false if it is not the person's choice
   */
  choose(name, { isWanted = true } = {}) {
    if (isWanted) remember("panel-tab", (this.#wanted = name));
    if (name === this.#open) return;
    this.#open = name;
    for (const [key, { tab, panel }] of this.#tabs) {
      setAttributes(tab, { "aria-selected": key === name ? "true" : "false", tabindex: key === name ? 0 : -1 });
      panel.hidden = key !== name;
    }
    this.#onOpen(name, this.#tabs.get(name).panel);
  }

  get #visible() {
    return [...this.#tabs].filter(([, { tab }]) => !tab.hidden).map(([name]) => name);
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    const names = this.#visible;
    const here = names.indexOf(this.#open);
    /** @type {Record<string, number>} */
    const moves = { ArrowRight: here + 1, ArrowLeft: here - 1, Home: 0, End: names.length - 1 };
    if (!(event.key in moves)) return;
    event.preventDefault();
    const name = names[(moves[event.key] + names.length) % names.length];
    this.choose(name);
    this.#tabs.get(name).tab.focus();
  }
}
