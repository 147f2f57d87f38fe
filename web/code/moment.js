/** The moment of the past that the world shows, beside the program: what it did there, and steps from there. */

/** @import { PlayedEpisode } from "../generated/messages.js" */
/** @import { Panel } from "../panel/panel.js" */
/** @import { Told } from "./timeline.js" */

import { button, element, setText } from "../shared/dom.js";
import { t } from "../shared/text.js";

export class CodeMoment {
  #panel;
  /** @type {PlayedEpisode | null} */
  #playing = null;
  #text = element("p", { role: "status" });
  #printed = element("pre");
  #back;
  #forward;
  #live;
  element;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#back = button("", () => this.#step(-1), { icon: "back", label: t("Decision before") });
    this.#forward = button("", () => this.#step(1), { icon: "forward", label: t("Next decision") });
    this.#live = button(t("Back to live"), () => panel.send("back_to_live"), { icon: "live" });
    const tools = element("div", { className: "ai4u-tools" }, this.#back, this.#forward, this.#live);
    this.element = element("div", { className: "ai4u-code-moment", hidden: true }, this.#text, this.#printed, tools);
  }

  /**
   * Show a moment.
   * @param {PlayedEpisode | null} playing null in the present
   * @param {Told | null} [told] null if nothing is known
   * @param {boolean} [isSame] true if the program in the editor is the one that ran
   */
  update(playing, told, isSame) {
    this.#playing = playing;
    this.element.hidden = playing === null;
    if (playing === null) return;
    setText(this.#text, momentWords(playing, told, isSame));
    setText(this.#printed, told?.printed ?? "");
    this.#printed.hidden = !told?.printed;
    this.#back.disabled = playing.step <= 0;
    this.#forward.disabled = playing.step >= playing.steps;
  }

  /** @param {number} by */
  #step(by) {
    const { step, steps } = this.#playing;
    this.#panel.send("step", { step: Math.min(Math.max(step + by, 0), steps) }, { quiet: true });
  }
}

/**
 * @param {PlayedEpisode} playing
 * @param {Told | null} told
 * @param {boolean} isSame
 */
function momentWords({ step, steps }, told, isSame) {
  if (step >= steps) return t("The end of the episode, after {steps} decisions.", { steps });
  const where = { number: step + 1, all: steps };
  if (told === null) return t("Decision {number} of {all}: your program did not make it, or it was too long ago.", where);
  if (!isSame) return t("Decision {number} of {all}. Your program has changed since, so its lines are not marked.", where);
  return t("Decision {number} of {all}: the lines that ran are marked.", where);
}
