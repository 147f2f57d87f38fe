/** Lights on the controls of the page that a mission means, found by the names that a person reads on them. */

import { setAttributes } from "../shared/dom.js";
import { t } from "../shared/text.js";

const CONTROLS = "button, [role=tab], [role=switch], summary, select, a[href]";
/**
 * Parts of the page that are no control, or whose names are a person's.
 * @type {Record<string, string>}
 */
const PLACES = {
  "First actuator": "[data-blocks=actuators] .ai4u-card-head",
  "First brain": "[data-blocks=brains] .ai4u-card-head",
  "First reward": "[data-blocks=rewards] .ai4u-card-head",
  "First sensor": "[data-blocks=sensors] .ai4u-card-head",
  Keys: ".ai4u-dpad:not(:empty), .ai4u-dock",
  Networks: ".ai4u-networks [aria-expanded=true], .ai4u-networks [aria-expanded]",
  Program: ".ai4u-code-editor, .ai4u-blocks-editor",
  Space: ".ai4u-dock [data-code=Space]",
};
/**
 * Names of the other controls in the page's language, by those that missions have.
 * @type {Record<string, string>}
 */
const NAMES = {
  "Add a reward": t("Add a reward"),
  "Add a sensor": t("Add a sensor"),
  "Add an actuator": t("Add an actuator"),
  Arena: t("Arena"),
  Ball: t("Ball"),
  Blocks: t("Blocks"),
  Box: t("Box"),
  Build: t("Build"),
  Code: t("Code"),
  Compare: t("Compare"),
  Details: t("Details"),
  Drive: t("Drive"),
  Follow: t("Follow"),
  Learn: t("Learn"),
  "Let it drive": t("Let it drive"),
  More: t("More"),
  "New start": t("New start"),
  Past: t("Past"),
  Pause: t("Pause"),
  Practise: t("Practise"),
  Python: t("Python"),
  Rewards: t("Rewards"),
  Run: t("Run"),
  Sensors: t("Sensors"),
  Simple: t("Simple"),
  Step: t("Step"),
  Stop: t("Stop"),
  Target: t("Target"),
  Teach: t("Teach"),
  Test: t("Test"),
  "Through its eyes": t("Through its eyes"),
  Trail: t("Trail"),
  "Try again": t("Try again"),
  Wall: t("Wall"),
  World: t("World"),
};
/** Attributes of controls that stay as they were chosen. */
const CHOICES = ["aria-selected", "aria-pressed", "aria-checked", "aria-expanded"];
/** Interval at which controls are looked for: tabs and lists come and go (ms). */
const LOOK_MS = 300;

export class Lights {
  /** @type {string[]} */
  #names = [];
  /** @type {Element[]} */
  #lit = [];
  /** Names whose controls were scrolled into view: once, so that a person can scroll on. */
  #scrolled = new Set();
  #timer = 0;
  #outside;

  /** @param {Element} outside controls in it are never lit */
  constructor(outside) {
    this.#outside = outside;
  }

  /**
   * Light controls. The first of them that has yet to be opened or chosen is lit; if all are, all others are lit.
   * @param {string[]} names none to put all lights out
   */
  show(names) {
    if (names.join() !== this.#names.join()) this.#scrolled.clear();
    this.#names = names;
    clearInterval(this.#timer);
    this.look();
    if (names.length) this.#timer = setInterval(() => this.look(), LOOK_MS);
  }

  /** Find the controls again, and light them. */
  look() {
    const found = this.#names.map((name) => this.#find(name)).filter((control) => control !== null);
    const next = found.find((control) => isChoice(control) && !isChosen(control));
    const others = found.filter((control) => !isChoice(control));
    const lit = next ? [next] : others.length ? others : found.slice(-1);
    for (const control of this.#lit) if (!lit.includes(control)) setAttributes(control, { "data-ai4u-lit": false });
    for (const control of lit) setAttributes(control, { "data-ai4u-lit": true });
    this.#lit = lit;
    if (lit.length) this.#scrollTo(lit[0]);
  }

  /** Scroll to what is lit again: what grows above it moves it out of sight. */
  keepInView() {
    this.#lit[0]?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  /** @param {Element} control */
  #scrollTo(control) {
    const name = nameOf(control);
    if (this.#scrolled.has(name)) return;
    this.#scrolled.add(name);
    // of a section, what is in it has to be seen, too
    control.scrollIntoView({ block: control.localName === "summary" ? "start" : "nearest", inline: "nearest" });
  }

  /**
   * Return the control of a name that can be seen; null if there is none.
   * @param {string} name
   */
  #find(name) {
    const isThere = (/** @type {Element} */ control) => control.getClientRects().length > 0 && !this.#outside.contains(control);
    const place = PLACES[name];
    if (place) {
      for (const selector of place.split(", ")) {
        const found = [...document.querySelectorAll(selector)].find(isThere);
        if (found) return found;
      }
      return null;
    }
    // what has no translation yet has its English name
    for (const shown of new Set([NAMES[name] ?? name, name])) {
      const all = [...document.querySelectorAll(CONTROLS)].filter((control) => nameOf(control).startsWith(shown));
      const found =
        all.find((control) => nameOf(control) === shown && isThere(control)) ?? all.find((control) => nameOf(control).startsWith(`${shown} `) && isThere(control));
      if (found) return found;
    }
    return null;
  }
}

/** @param {Element} control */
function nameOf(control) {
  return (control.getAttribute("aria-label") || control.textContent).trim();
}

/**
 * Return true for a control that stays as it was chosen: a tab, a switch, one of several buttons, a section.
 * @param {Element} control
 */
function isChoice(control) {
  return control.localName === "summary" || CHOICES.some((name) => control.hasAttribute(name));
}

/** @param {Element} control */
function isChosen(control) {
  if (control.localName === "summary") return /** @type {HTMLDetailsElement} */ (control.parentElement).open;
  return CHOICES.some((name) => control.getAttribute(name) === "true");
}
