/** Banners at the top of the page (goal, outcome, pause, errors), each with a button; and the window's title. */

/** @import { Commands, NetworkRace, StateEvent } from "../generated/messages.js" */
import { element } from "../shared/dom.js";
/** @import { Result } from "./results.js" */
import { capitalized } from "./driver_status.js";
import { openMission } from "../missions/progress.js";
import { openNextScene } from "../scenes/next_scene.js";
import { raceText, slowedText, timeText } from "./results.js";

/** Kinds of banners whose text is a whole sentence and is not printed bold. */
const NOT_BOLD_KINDS = ["error", "task", "thought"];
/**
 * Texts by the outcome that the server sends: said to the driver, and said of another agent by its name.
 * @type {Record<string, string[]>}
 */
const OUTCOME_TEXTS = {
  goal: ["You did it!", "did it!"],
  won: ["You won!", "won!"],
  lost: ["You lost.", "lost."],
  fell: ["You fell.", "fell."],
  time: ["Time is up."],
  over: ["The try is over."],
};
const WINS = ["goal", "won"];
/**
 * Commands by the text of their button.
 * @type {Record<string, keyof Commands>}
 */
const COMMANDS = {
  "Play again": "try_again",
  "Try again": "try_again",
  "Watch again": "try_again",
  "New start": "new_start",
  Reset: "reset",
  Resume: "resume",
  "Back to live": "resume",
};
const LOST = "No connection to this world. The page reconnects by itself.";
/** Time that the error of a failed request stays (ms). */
const REQUEST_ERROR_MS = 8000;
/** Terms smaller than this round to 0.00 and are left out of the details. */
const MIN_TERM = 0.005;

/**
 * @typedef {object} PageState what a banner needs to know of the page
 * @property {string} restart the label of the restart key
 * @property {string} name the agent's name, if this page can't drive it
 * @property {boolean} isNew true until the person has pressed a key: then the goal is shown
 * @property {Result | null} result of the episode that a person has just won; else null
 * @property {boolean} isWatching true while a network drives to be watched
 * @property {string} thought why it acts as it does, in a sentence; empty for none
 * @property {NetworkRace | null} race the race that the episode is; null for none
 * @property {boolean} isLost true once the connection has been gone for some seconds
 * @property {string} held the text for a world that a teacher holds; empty for none
 * @property {string} howToStart what the person does to start, such as "press a key"; empty if this page can't
 */
/** @typedef {{kind: string, text: string, hint?: string, details?: string, score?: string, buttons?: string[]}} Banner */

export class Banners {
  #sendCommand;
  #actions;
  #statusRegion = element("div", { className: "ai4u-banners", role: "status" });
  #alertRegion = element("div", { className: "ai4u-banners", role: "alert" });
  /** Region of thoughts: no live one, as a screen reader would read out each of them. */
  #quietRegion = element("section", { className: "ai4u-banners", ariaLabel: "What it thinks" });
  /** The banner that is shown, as JSON: an unchanged one is not read out again. */
  #shown = "";
  #connectionError = "";
  #requestError = "";
  #timer = 0;
  /**
   * Arguments of the last drawing; null before the first time.
   * @type {Parameters<Banners["draw"]> | null}
   */
  #lastDraw = null;

  /**
   * @param {(command: keyof Commands) => void} sendCommand
   * @param {Record<string, () => void>} actions called by the texts of their buttons
   */
  constructor(sendCommand, actions = {}) {
    this.#sendCommand = sendCommand;
    this.#actions = actions;
    document.body.append(this.#statusRegion, this.#alertRegion, this.#quietRegion);
  }

  /**
   * Set the reason why the server refuses this page, which only reloading can mend; empty clears it.
   * @param {string} reason
   */
  setConnectionError(reason) {
    this.#connectionError = reason;
  }

  /**
   * Show for some seconds that a request failed.
   * @param {string} text
   */
  showRequestError(text) {
    this.#requestError = text;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.#requestError = "";
      if (this.#lastDraw) this.draw(...this.#lastDraw);
    }, REQUEST_ERROR_MS);
  }

  /**
   * @param {StateEvent | null} state the server's last one; null while disconnected
   * @param {PageState} page
   */
  draw(state, page) {
    this.#lastDraw = [state, page];
    if (state?.title) document.title = state.title;
    const banner = this.#banner(state, page);
    const key = JSON.stringify(banner);
    if (key === this.#shown) return;
    this.#shown = key;
    const { kind } = banner ?? {};
    const used = kind === "error" ? this.#alertRegion : kind === "thought" ? this.#quietRegion : this.#statusRegion;
    for (const region of [this.#statusRegion, this.#alertRegion, this.#quietRegion]) if (region !== used) region.replaceChildren();
    used.replaceChildren(...(banner ? [this.#element(banner)] : []));
  }

  /**
   * @param {StateEvent | null} state
   * @param {PageState} page
   * @returns {Banner | null}
   */
  #banner(state, page) {
    if (this.#connectionError) return { kind: "error", text: this.#connectionError, buttons: ["Reload"] };
    if (page.isLost) return { kind: "error", text: LOST };
    if (state?.error) return { kind: "error", text: state.error, buttons: ["Reset"] };
    if (this.#requestError) return { kind: "error", text: this.#requestError };
    if (page.held) return { kind: "paused", text: page.held };
    if (state?.past) return { kind: "paused", text: `Past: ${state.past}`, buttons: ["Back to live"] };
    if (state?.outcome) return outcomeBanner(state, page);
    if (state?.paused) return { kind: "paused", text: "Paused", details: page.thought, buttons: ["Resume"] };
    if (page.thought) return { kind: "thought", text: page.thought };
    if (state?.waiting === "key") return startBanner(state, page);
    if (state?.goal && page.isNew && !page.name) return { kind: "task", text: state.goal };
    return null;
  }

  /** @param {Banner} banner */
  #element({ kind, text, hint, details, score, buttons = [] }) {
    const tag = NOT_BOLD_KINDS.includes(kind) ? "span" : "strong";
    const words = element("p", {}, element(tag, { textContent: text }));
    if (hint) words.append(element("span", { className: "ai4u-hint", textContent: hint }));
    if (details) words.append(element("small", { textContent: details }));
    if (score) words.append(element("small", { className: "ai4u-details-only", textContent: score }));
    const made = element("div", { className: "ai4u-banner" }, words);
    made.dataset.kind = kind;
    for (const name of buttons) {
      const button = element("button", { type: "button", className: "ai4u-button", textContent: name });
      button.addEventListener("click", () => this.#carryOut(name));
      made.append(button);
    }
    return made;
  }

  /** @param {string} name of a button */
  #carryOut(name) {
    if (name === "Reload") location.reload();
    else if (name === "Next scene") openNextScene();
    else if (name in this.#actions) this.#actions[name]();
    else this.#sendCommand(COMMANDS[name]);
  }
}

/**
 * @param {StateEvent} state
 * @param {PageState} page
 */
function outcomeText(state, { name, result, race }) {
  const [mine, theirs] = OUTCOME_TEXTS[state.outcome];
  const text = name && theirs ? `${name} ${theirs}` : mine;
  const timed = WINS.includes(state.outcome) && result ? text + timeText(result) : text;
  return race ? `${timed}${/[.!]$/.test(timed) ? "" : "."} ${raceText(race, state)}` : timed;
}

/**
 * @param {StateEvent} state
 * @param {PageState} page
 * @returns {Banner}
 */
function startBanner({ goal }, { isNew, name, howToStart, race }) {
  const start = howToStart ? `${capitalized(howToStart)} to start` : "Waits until a player presses a key";
  if (race) return { kind: "start", text: start, details: slowedText(race) };
  const isGoalShown = isNew && goal && !name;
  return isGoalShown ? { kind: "task", text: goal, details: start } : { kind: "start", text: start };
}

/**
 * @param {StateEvent} state
 * @param {PageState} page
 * @returns {Banner}
 */
function outcomeBanner(state, page) {
  const { outcome, reward, terms } = state;
  const isWin = WINS.includes(outcome);
  const parts = Object.entries(terms).filter(([, value]) => Math.abs(value) >= MIN_TERM);
  const sum = parts.map(([name, value]) => `${name} ${signed(value)}`).join(" · ");
  return {
    kind: isWin ? "goal" : "over",
    text: outcomeText(state, page),
    hint: page.restart && !page.isWatching && ` Press ${page.restart} to ${isWin ? "play" : "try"} again.`,
    score: [`Score ${signed(reward)}`, parts.length > 1 && sum].filter(Boolean).join(": "),
    buttons: page.isWatching ? ["Beat it!", "Watch again", "Stop watching"] : isWin ? ["Play again", "New start", ...(openMission() ? [] : ["Next scene"])] : ["Try again", "New start"],
  };
}

/** @param {number | null} value */
function signed(value) {
  if (value === null) return "";
  const size = Math.abs(value);
  const digits = size.toLocaleString(undefined, { maximumFractionDigits: size < 10 ? 2 : size < 100 ? 1 : 0 });
  return (value < 0 ? "−" : "+") + digits;
}
