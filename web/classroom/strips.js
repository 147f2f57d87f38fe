/** Strips below the toolbar that say what holds for the whole class now: attention, and a race. */

/** @import { ClassState, Race, RaceRow } from "../types/class.js" */
/** @import { Command } from "./teacher/command.js" */

import { clock } from "../shared/numbers.js";
import { HELD, isHeld } from "./teacher/attention_dialog.js";
import { commandOrTell } from "./teacher/command.js";
import { element, setText } from "../shared/dom.js";
import { t } from "../shared/text.js";

const TICK_MS = 250;
const MAX_PLACES = 3;
/** Outcomes of a drive that reached the goal. */
const WINS = ["goal", "won"];

/** A number of seconds that counts down here between two messages. */
export class Countdown {
  #end = 0;

  /** @param {number} seconds */
  set(seconds) {
    this.#end = seconds > 0 ? performance.now() + 1000 * seconds : 0;
  }

  /** Seconds left; 0 if there is no end, or it has come. */
  get left() {
    return this.#end ? Math.max(0, (this.#end - performance.now()) / 1000) : 0;
  }
}

export class ClassStrips {
  #held;
  #race;
  /** @type {ClassState | null} */
  #state = null;
  #ends = new Countdown();
  #starts = new Countdown();

  /**
   * @param {HTMLElement} held
   * @param {HTMLElement} race
   */
  constructor(held, race) {
    this.#held = held;
    this.#race = race;
    setInterval(() => this.#update(), TICK_MS);
  }

  /** @param {ClassState} state */
  show(state) {
    this.#state = state;
    this.#ends.set(state.attention.ends_in);
    this.#starts.set(state.race?.starts_in ?? 0);
    this.#held.hidden = !isHeld(state.attention);
    this.#race.hidden = !state.race;
    if (isHeld(state.attention)) build(this.#held); // the toolbar has the button that ends it
    if (state.race) {
      const { is_board_hidden: isHidden, phase } = state.race;
      build(this.#race, [isHidden ? t("Show the board") : t("Hide the board"), { do: "board", hide: !isHidden }], [phase === "over" ? t("Close the race") : t("End race"), { do: "end race" }]);
    }
    this.#update();
  }

  #update() {
    if (!this.#state) return;
    const { attention, race } = this.#state;
    if (isHeld(attention)) {
      const end = this.#ends.left ? t("Ends in {time}.", { time: clock(this.#ends.left) }) : "";
      say(this.#held, HELD[attention.kind], [attention.message && `“${attention.message}”`, end].filter(Boolean).join(" "));
    }
    if (race) say(this.#race, raceWords(race, this.#starts.left), boardWords(race.board));
  }
}

/**
 * @param {Race} race
 * @param {number} left seconds to its start
 */
function raceWords({ phase, scene }, left) {
  if (phase === "countdown" && left) return t("Race “{scene}”: starts in {time}.", { scene, time: clock(left) });
  return phase === "over" ? t("Race “{scene}” is over.", { scene }) : t("Race “{scene}” is on.", { scene });
}

/**
 * Return the best places, and whose results were refused, with the reason.
 * @param {RaceRow[]} board
 */
function boardWords(board) {
  const best = board.filter(({ outcome }) => WINS.includes(outcome)).slice(0, MAX_PLACES);
  const refused = board.filter(({ outcome }) => outcome === "refused");
  return [
    ...best.map(({ name, seconds }, index) => `${index + 1}. ${name} ${seconds.toFixed(1)} s`),
    ...refused.map(({ name, why }) => t("Refused: {name} ({why})", { name, why })),
  ].join("   ");
}

/**
 * Build a strip of words and buttons, unless it has these already: a button keeps its focus.
 * @param {HTMLElement} strip
 * @param {[string, Command][]} buttons
 */
function build(strip, ...buttons) {
  const told = buttons.map(([text]) => text).join();
  if (strip.dataset.told === told) return;
  strip.dataset.told = told;
  strip.replaceChildren(
    element("p", {}, element("strong"), element("span")),
    ...buttons.map(([text, command]) => {
      const button = element("button", { type: "button", className: "ai4u-button", textContent: text });
      button.addEventListener("click", () => commandOrTell(command));
      return button;
    }),
  );
}

/**
 * @param {HTMLElement} strip
 * @param {string} first
 * @param {string} rest
 */
function say(strip, first, rest) {
  setText(strip.querySelector("strong"), first);
  setText(strip.querySelector("span"), rest);
}
