/** "What if": other values for the numbers that an agent senses, and the action that would follow. */

/**
 * @import { Change } from "../../generated/messages.js"
 * @import { Dial } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, setAttributes, setText } from "../../shared/dom.js";
import { freeId } from "../../shared/ids.js";
import { Bars, changedRow, hasEffect } from "../widgets/bars.js";
import { number } from "../../shared/numbers.js";
import { t } from "../../shared/text.js";
import { choice } from "../widgets/parts.js";

/** Time without a change after which the action is asked for. */
const PAUSE_MS = 40;

export class WhatIf {
  #panel;
  /** @type {Dial[]} */
  #dials = [];
  #chosen = "";
  /**
   * Changes by the id of their dial.
   * @type {Map<string, Change>}
   */
  #changes = new Map();
  #timer = 0;
  #asked = 0;
  #isPaused = false;
  #isExplained = false;
  #hint = element("p", { className: "ai4u-soft", textContent: t("Press Pause, then try other numbers.") });
  #slot = choice(t("Try another number"), (id) => this.#choose(id));
  #slider = element("input", { type: "range", id: freeId(), ariaLabel: t("Value") });
  #value = element("output");
  #none = button(t("As it is"), () => this.#reset(), { icon: "undo", kind: "quiet" });
  #action = new Bars();
  #body = element(
    "div",
    { hidden: true },
    this.#slot.element,
    element("div", { className: "ai4u-what-if-row" }, this.#slider, this.#value, this.#none),
    this.#action.element,
  );
  element = element("div", { className: "ai4u-what-if", hidden: true }, this.#hint, this.#body);

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#slider.addEventListener("input", () => this.#slide());
    panel.addEventListener("part:run", () => this.#onRun());
  }

  /**
   * Take another decision: numbers that were changed for the last one are as they are again.
   * @param {boolean} isExplained
   */
  update(isExplained) {
    this.#isExplained = isExplained;
    this.#changes.clear();
    this.#draw();
    if (isExplained && this.#isPaused) this.#ask();
  }

  #onRun() {
    const isPaused = Boolean(this.#panel.part("run")?.is_paused);
    if (isPaused !== this.#isPaused) {
      this.#isPaused = isPaused;
      this.update(this.#isExplained);
    }
  }

  #draw() {
    this.element.hidden = !this.#isExplained;
    this.#hint.hidden = this.#isPaused;
    if (!this.#isPaused || !this.#isExplained) this.#body.hidden = true;
  }

  /** @param {string} id of a dial */
  #choose(id) {
    this.#chosen = id;
    this.#drawDial();
  }

  #slide() {
    const dial = this.#dial();
    if (!dial) return;
    this.#changes.set(idOf(dial), { key: dial.key, index: dial.index, value: Number(this.#slider.value) });
    setText(this.#value, number(Number(this.#slider.value)));
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#ask(), PAUSE_MS);
  }

  #reset() {
    this.#changes.clear();
    this.#ask();
  }

  async #ask() {
    const asked = ++this.#asked;
    const answer = await this.#panel.send("what_if", { changes: [...this.#changes.values()] }, { quiet: true });
    if (asked !== this.#asked || !answer.ok) return;
    this.#dials = answer.dials;
    this.#body.hidden = this.#dials.length === 0 || !this.#isPaused;
    if (!this.#dial()) this.#chosen = this.#dials.length ? idOf(this.#dials[0]) : "";
    this.#slot.set(this.#dials.map((dial) => ({ value: idOf(dial), text: dial.name })), this.#chosen);
    this.#drawDial();
    this.#action.update(answer.action.filter(hasEffect).map(changedRow));
  }

  #dial() {
    return this.#dials.find((dial) => idOf(dial) === this.#chosen);
  }

  #drawDial() {
    const dial = this.#dial();
    if (!dial) return;
    const value = this.#changes.get(idOf(dial))?.value ?? dial.value;
    setAttributes(this.#slider, { min: dial.low, max: dial.high, step: (dial.high - dial.low) / 200 || 1, "aria-label": dial.name });
    if (document.activeElement !== this.#slider) this.#slider.value = String(value);
    setText(this.#value, number(value));
    this.#none.hidden = this.#changes.size === 0;
  }
}

/** @param {Dial} dial */
function idOf({ key, index }) {
  return `${key} ${index}`;
}
