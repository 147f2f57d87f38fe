/** The podium of the projector page: the best three, who come one after another, with a sound for each. */

import { element } from "../../shared/dom.js";
import { recall, remember } from "../../shared/storage.js";
import { playNotes } from "../../shared/sound.js";
import { t } from "../../shared/text.js";

/** Time from the third to the second, and from there to the first (ms). */
const STEP_MS = 1200;
/** Notes of each place (Hz), the third first. */
const NOTES_HZ = [[392], [523.25], [523.25, 659.25, 783.99, 1046.5]];
const SOUND_KEY = "projector-sound";

/** @typedef {{name: string, colour: string, text: string}} Place */

export class Podium {
  element = element("ol", { className: "ai4u-podium", hidden: true });
  #told = "";
  /** @type {number[]} */
  #timers = [];

  /**
   * Show the best, or nobody.
   * @param {string} id of what they have won; the same places are not shown again from the beginning
   * @param {Place[]} rows of the best, the first at the beginning
   */
  show(id, rows) {
    const best = rows.slice(0, 3);
    const told = best.length ? JSON.stringify([id, best]) : "";
    if (told === this.#told) return;
    this.#told = told;
    this.#timers.forEach(clearTimeout);
    this.element.hidden = best.length === 0;
    this.element.replaceChildren(...best.map(step));
    // the last of them comes first
    this.#timers = best.map((_, index) => setTimeout(() => isSoundOn() && playNotes(NOTES_HZ[2 - index]), (best.length - 1 - index) * STEP_MS));
  }
}

/**
 * @param {Place} place
 * @param {number} index
 * @param {Place[]} all
 */
function step({ name, colour, text }, index, all) {
  const dot = element("span", { className: "ai4u-dot" });
  dot.style.background = colour;
  const made = element(
    "li",
    { dataset: { place: index + 1 } },
    element("span", { className: "ai4u-podium-name" }, dot, element("strong", { textContent: name })),
    element("span", { className: "ai4u-podium-step" }, element("b", { textContent: index + 1 }), element("span", { textContent: text })),
  );
  made.style.setProperty("--delay", `${(all.length - 1 - index) * STEP_MS}ms`);
  return made;
}

function isSoundOn() {
  return recall(SOUND_KEY, false) === true;
}

/** Return the button that turns the sound on, as browsers allow none before a click. */
export function soundButton() {
  const made = element("button", { type: "button", className: "ai4u-plain ai4u-sound", textContent: t("Sound") });
  const draw = () => made.setAttribute("aria-pressed", String(isSoundOn()));
  made.addEventListener("click", () => {
    remember(SOUND_KEY, !isSoundOn());
    draw();
    if (isSoundOn()) playNotes(NOTES_HZ[1]);
  });
  draw();
  return made;
}
