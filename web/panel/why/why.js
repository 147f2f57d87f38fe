/** "Why?": how far each slot of the percept moves the action, and the method's limits. */

/**
 * @import { ExplainedSlot, WhyPart } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 */
import { element, keyed, setAttributes, setText } from "../../shared/dom.js";
import { t } from "../../shared/text.js";
import { howComputed, toggle } from "../widgets/parts.js";
import { WhatIf } from "./what_if.js";

/** A sentence that changes five times a second can't be read. */
const SENTENCE_MS = 1000;
/** A largest share below this fills no bar: else noise would look like a reason. */
const MIN_SCALE = 0.2;

/** @typedef {{slots: ExplainedSlot[], scale: number}} SensorWeights a sensor's slots; `scale` is the share that fills a bar */

export class Why {
  #panel;
  #onChange;
  /** @type {WhyPart | null} */
  #part = null;
  #saidAt = -SENTENCE_MS;
  #later = 0;
  #switch = toggle(t("Show why"), (isOn) => this.#toggle(isOn));
  #sentence = element("p", { className: "ai4u-why-sentence" });
  #list = element("ul", { className: "ai4u-why-list", ariaLabel: t("Numbers that matter most") });
  #also = element("p", { className: "ai4u-soft", hidden: true });
  #limits = element("p", { className: "ai4u-soft" });
  #method = element("p", {
    className: "ai4u-soft",
    textContent: t("We replace one sensor number at a time by its average and look how much the action changes."),
  });
  #how = howComputed(this.#also, this.#limits);
  #result = element("div", { hidden: true }, this.#sentence, this.#list, this.#method, this.#how);
  #whatIf;
  element = element("div", {}, this.#switch.element, this.#result);

  /**
   * @param {Panel} panel
   * @param {() => void} onChange called when there is another explanation, or none any more
   */
  constructor(panel, onChange) {
    this.#panel = panel;
    this.#onChange = onChange;
    this.#whatIf = new WhatIf(panel);
    this.#result.append(this.#whatIf.element);
    panel.addEventListener("part:why", ({ detail }) => this.#draw(detail));
    // a new connection has a new page on the server, which shows nothing yet
    panel.addEventListener("connected", () => this.isOn && this.#send());
  }

  get isOn() {
    return this.#switch.element.getAttribute("aria-checked") === "true";
  }

  /**
   * Return the slots of a sensor; null if none are shown.
   * @param {string} agent its id
   * @param {string} key of the sensor
   * @returns {SensorWeights | null}
   */
  of(agent, key) {
    const part = this.#part;
    if (!this.isOn || !part || part.agent !== agent || part.problem) return null;
    const slots = part.slots.filter((slot) => slot.key === key);
    const scale = Math.max(MIN_SCALE, ...part.slots.map(({ share }) => share));
    return slots.length === 0 ? null : { slots, scale };
  }

  /** @param {boolean} isOn */
  #toggle(isOn) {
    this.#result.hidden = true;
    this.#part = null;
    this.#saidAt = -SENTENCE_MS;
    clearTimeout(this.#later);
    this.#whatIf.update(false);
    this.#send(isOn);
    this.#onChange();
  }

  async #send(isOn = this.isOn) {
    const answer = await this.#panel.send("why", { on: isOn }, { quiet: true });
    if (!answer.ok) this.#switch.set(false);
  }

  #say() {
    if (!this.#part) return;
    this.#saidAt = performance.now();
    setText(this.#sentence, this.#part.problem || this.#part.sentence);
  }

  /** @param {WhyPart} part */
  #draw(part) {
    if (!this.isOn || part.agent !== this.#panel.shown.agent) return;
    if (this.#part?.agent !== part.agent || this.#part?.problem !== part.problem) this.#saidAt = -SENTENCE_MS;
    this.#part = part;
    this.#result.hidden = false;
    clearTimeout(this.#later);
    // the last one has to be said too: in a paused world no other one follows
    this.#later = setTimeout(() => this.#say(), Math.max(0, this.#saidAt + SENTENCE_MS - performance.now()));
    const scale = Math.max(MIN_SCALE, ...part.top.map(({ share }) => share));
    this.#list.hidden = part.top.length === 0;
    keyed(this.#list, part.top, ({ name }) => name, makeSlot, (item, slot) => drawSlot(item, slot, part.components, scale));
    this.#whatIf.update(!part.problem);
    this.#method.hidden = this.#how.hidden = Boolean(part.problem);
    setText(this.#also, part.also ?? "");
    this.#also.hidden = !part.also;
    setText(this.#limits, [t("Compared with {baseline}.", { baseline: part.baseline }), part.explained, part.limits].filter(Boolean).join(" "));
    this.#onChange();
  }
}

function makeSlot() {
  return element(
    "li",
    {},
    element("span"),
    element("div", { className: "ai4u-why-bar", ariaHidden: "true" }, element("i")),
    element("b"),
  );
}

/**
 * @param {HTMLElement} item
 * @param {ExplainedSlot} slot
 * @param {string[]} components names of the numbers of the action
 * @param {number} scale share that fills a bar
 */
function drawSlot(item, { name, sees, share, shares }, components, scale) {
  const [label, bar, words] = item.children;
  const fill = /** @type {HTMLElement} */ (bar.firstChild);
  setText(label, sees ? `${name} – ${seenWords(sees)}` : name);
  fill.style.width = `${(100 * Math.min(1, share / scale)).toFixed(1)}%`;
  const largest = shares.findIndex((number) => Math.abs(number) === share);
  setText(words, `${components[largest] ?? t("action")} ${percent(shares[largest] ?? 0)}`);
  setAttributes(item, { title: components.map((component, index) => `${component} ${percent(shares[index] ?? 0)}`).join(", ") });
}

/** @param {string} sees what a sensor's number shows: a thing, "something" or "nothing" */
function seenWords(sees) {
  if (sees === "nothing") return t("nothing");
  return sees === "something" ? t("something") : t("the {thing}", { thing: sees });
}

/** @param {number} share */
function percent(share) {
  return `${share < 0 ? "−" : "+"}${Math.round(100 * Math.abs(share))} %`;
}

/**
 * Draw cells side by side, or in rows, that are the darker the more a ray matters.
 * @param {HTMLElement} parent
 * @param {SensorWeights | null} why null for none
 * @param {number} [columns] default: all in one row
 */
export function drawWeights(parent, why, columns) {
  const slots = why?.slots ?? [];
  parent.hidden = slots.length === 0;
  if (parent.hidden) return;
  parent.style.gridTemplateColumns = `repeat(${columns || slots.length}, 1fr)`;
  keyed(
    parent,
    slots.map((slot, index) => ({ ...slot, index })),
    ({ index }) => index,
    () => element("i"),
    (cell, { name, share }) => {
      setAttributes(cell, { title: t("{name}: moves the action by {percent} %", { name, percent: Math.round(100 * share) }) });
      cell.style.setProperty("--why", (100 * Math.min(1, share / why.scale)).toFixed(0) + "%");
    },
  );
}
