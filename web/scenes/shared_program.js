/** A program that came with a link to a scene: kept until the person takes it or does not want it. */

import { splitProgram } from "../blocks/text.js";
import { button, element, setText } from "../shared/dom.js";
import { roomOfPage } from "../shared/room.js";
import { forget, recall, remember } from "../shared/storage.js";
import { t, tn } from "../shared/text.js";

/** Students of a class may use one device in turn. */
const KEY = `shared-program-${roomOfPage()}`;

/** Tells with the event "change" that a program has come or is gone. */
export const sharedPrograms = new EventTarget();

/**
 * Keep a program for the tab "Code".
 * @param {{scene: string, agent: string, source: string}} program
 */
export function keepShared(program) {
  remember(KEY, program);
  sharedPrograms.dispatchEvent(new Event("change"));
}

/**
 * Return the program for an agent in a scene; null if there is none.
 * @param {string} scene
 * @param {string} agent
 * @returns {string | null}
 */
export function sharedFor(scene, agent) {
  const found = recall(KEY, null);
  const isFor = found !== null && found.scene === scene && found.agent === agent && typeof found.source === "string";
  return isFor ? found.source : null;
}

export function forgetShared() {
  forget(KEY);
  sharedPrograms.dispatchEvent(new Event("change"));
}

/** The offer of such a program: its text to read, a button that takes it, and one that does not. */
export class SharedOffer {
  #words = element("p");
  #text = element("pre", { tabIndex: 0, ariaLabel: t("The shared program") });
  /** @type {string | null} */
  #source = null;
  element = element("div", { className: "ai4u-code-shared", role: "group", ariaLabel: t("A shared program"), hidden: true });

  /** @param {(source: string) => void} onTake called with the program that the person takes */
  constructor(onTake) {
    const take = button(t("Take it"), () => this.#end(onTake), { kind: "main" });
    const refuse = button(t("No, thanks"), () => this.#end(() => {}), {});
    const details = element("details", {}, element("summary", { textContent: t("Read it") }), this.#text);
    this.element.append(this.#words, details, element("div", { className: "ai4u-inline" }, take, refuse));
  }

  /**
   * Show the offer of a program; null hides it.
   * @param {string | null} source
   */
  update(source) {
    this.#source = source;
    this.element.hidden = source === null;
    if (source === null) return;
    const { python } = splitProgram(source);
    const lines = python.trim().split("\n").length;
    const words = tn(
      "The link brought a program of {n} line. Yours stays among the earlier runs if you take it.",
      "The link brought a program of {n} lines. Yours stays among the earlier runs if you take it.",
      lines,
    );
    setText(this.#words, words);
    setText(this.#text, python);
  }

  /** @param {(source: string) => void} then */
  #end(then) {
    const source = this.#source;
    forgetShared();
    then(source);
  }
}
