/** Banners at the top of the page (goal, outcome, pause, errors), each with a button; and the window's title. */

/** @import { Commands, NetworkRace, StateEvent } from "../generated/messages.js" */
import { element, keyed } from "../shared/dom.js";
/** @import { Result } from "./results.js" */
import { t } from "../shared/text.js";
import { capitalized } from "./driver_status.js";
import { openMission } from "../missions/progress.js";
import { openNextScene } from "../scenes/next_scene.js";
import { raceText, slowedText, timeText } from "./results.js";

/** Kinds of banners whose text is a whole sentence and is not printed bold. */
const NOT_BOLD_KINDS = ["error", "task", "thought"];
/**
 * Texts by the outcome that the server sends, said to the driver.
 * @type {Record<string, string>}
 */
const OUTCOME_TEXTS = {
  goal: t("You did it!"),
  won: t("You won!"),
  lost: t("You lost."),
  fell: t("You fell."),
  time: t("Time is up."),
  over: t("The try is over."),
};
const WINS = ["goal", "won"];
/**
 * Texts of the buttons.
 * @type {Record<string, string>}
 */
const BUTTON_TEXTS = {
  back_to_live: t("Back to live"),
  beat: t("Beat it!"),
  new_start: t("New start"),
  next_scene: t("Next scene"),
  play_again: t("Play again"),
  reload: t("Reload"),
  reset: t("Reset"),
  resume: t("Resume"),
  stop_watching: t("Stop watching"),
  try_again: t("Try again"),
  watch_again: t("Watch again"),
};
/**
 * Commands by their button.
 * @type {Record<string, keyof Commands>}
 */
const COMMANDS = {
  back_to_live: "resume",
  new_start: "new_start",
  play_again: "try_again",
  reset: "reset",
  resume: "resume",
  try_again: "try_again",
  watch_again: "try_again",
};
const LOST = t("No connection to this world. The page reconnects by itself.");
/** Time that the error of a failed request stays (ms). */
const REQUEST_ERROR_MS = 8000;
/** Time that news stay (ms). */
const NEWS_MS = 8000;
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
  #quietRegion = element("section", { className: "ai4u-banners", ariaLabel: t("What it thinks") });
  /** The banner that is shown, as JSON: an unchanged one is not read out again. */
  #shown = "";
  #connectionError = "";
  #requestError = "";
  #timer = 0;
  #news = "";
  #newsTimer = 0;
  /**
   * Arguments of the last drawing; null before the first time.
   * @type {Parameters<Banners["draw"]> | null}
   */
  #lastDraw = null;

  /**
   * @param {(command: keyof Commands) => void} sendCommand
   * @param {Record<string, () => void>} actions called by their buttons: `beat`, `stop_watching`
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
   * Show for some seconds what a robot has just reached.
   * @param {string} text
   */
  showNews(text) {
    const show = (/** @type {string} */ news) => {
      this.#news = news;
      if (this.#lastDraw) this.draw(...this.#lastDraw);
    };
    clearTimeout(this.#newsTimer);
    this.#newsTimer = setTimeout(() => show(""), NEWS_MS);
    show(text);
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
    for (const region of [this.#statusRegion, this.#alertRegion, this.#quietRegion]) {
      // buttons stay while the words change, as they do many times a second in the past: else a click is lost
      keyed(
        region,
        banner && region === used ? [banner] : [],
        ({ buttons }) => JSON.stringify([kind, buttons]),
        (each) => this.#element(each),
        (made, each) => made.firstElementChild.replaceWith(wordsOf(each)),
      );
    }
  }

  /**
   * @param {StateEvent | null} state
   * @param {PageState} page
   * @returns {Banner | null}
   */
  #banner(state, page) {
    if (this.#connectionError) return { kind: "error", text: this.#connectionError, buttons: ["reload"] };
    if (page.isLost) return { kind: "error", text: LOST };
    if (state?.error) return { kind: "error", text: state.error, buttons: ["reset"] };
    if (this.#requestError) return { kind: "error", text: this.#requestError };
    if (page.held) return { kind: "paused", text: page.held };
    if (state?.past) return { kind: "paused", text: t("Past: {moment}", { moment: state.past }), buttons: ["back_to_live"] };
    if (this.#news) return { kind: "goal", text: this.#news };
    if (state?.outcome) return outcomeBanner(state, page);
    if (state?.paused) return { kind: "paused", text: t("Paused"), details: page.thought, buttons: ["resume"] };
    if (page.thought) return { kind: "thought", text: page.thought };
    if (state?.waiting === "key") return startBanner(state, page);
    if (state?.goal && page.isNew && !page.name) return { kind: "task", text: state.goal };
    return null;
  }

  /** @param {Banner} banner */
  #element({ kind, buttons = [] }) {
    const made = element("div", { className: "ai4u-banner" }, element("p"));
    made.dataset.kind = kind;
    for (const name of buttons) {
      const button = element("button", { type: "button", className: "ai4u-button", textContent: BUTTON_TEXTS[name] });
      button.addEventListener("click", () => this.#carryOut(name));
      made.append(button);
    }
    return made;
  }

  /** @param {string} name of a button */
  #carryOut(name) {
    if (name === "reload") location.reload();
    else if (name === "next_scene") openNextScene();
    else if (name in this.#actions) this.#actions[name]();
    else this.#sendCommand(COMMANDS[name]);
  }
}

/** @param {Banner} banner */
function wordsOf({ kind, text, hint, details, score }) {
  const tag = NOT_BOLD_KINDS.includes(kind) ? "span" : "strong";
  const words = element("p", {}, element(tag, { textContent: text }));
  if (hint) words.append(element("span", { className: "ai4u-hint", textContent: hint }));
  if (details) words.append(element("small", { textContent: details }));
  if (score) words.append(element("small", { className: "ai4u-details-only", textContent: score }));
  return words;
}

/**
 * @param {StateEvent} state
 * @param {PageState} page
 */
function outcomeText(state, { name, result, race }) {
  const mine = OUTCOME_TEXTS[state.outcome];
  const text = name ? (textOfOther(state.outcome, name) ?? mine) : mine;
  const timed = WINS.includes(state.outcome) && result ? text + timeText(result) : text;
  return race ? `${timed}${/[.!]$/.test(timed) ? "" : "."} ${raceText(race, state)}` : timed;
}

/**
 * Return the text of an outcome, said of another agent; undefined if it is the same for everybody.
 * @param {string} outcome
 * @param {string} name of the agent
 */
function textOfOther(outcome, name) {
  switch (outcome) {
    case "goal":
      return t("{name} did it!", { name });
    case "won":
      return t("{name} won!", { name });
    case "lost":
      return t("{name} lost.", { name });
    case "fell":
      return t("{name} fell.", { name });
  }
  return undefined;
}

/**
 * @param {StateEvent} state
 * @param {PageState} page
 * @returns {Banner}
 */
function startBanner({ goal }, { isNew, name, howToStart, race }) {
  const start = howToStart ? t("{what} to start", { what: capitalized(howToStart) }) : t("Waits until a player presses a key");
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
  const score = signed(reward);
  const sum = parts.map(([name, value]) => `${name} ${signed(value)}`).join(" · ");
  return {
    kind: isWin ? "goal" : "over",
    text: outcomeText(state, page),
    hint: page.restart && !page.isWatching && ` ${restartText(page.restart, isWin)}`,
    score: parts.length > 1 ? t("Score {score}: {parts}", { score, parts: sum }) : t("Score {score}", { score }),
    buttons: page.isWatching ? ["beat", "watch_again", "stop_watching"] : isWin ? ["play_again", "new_start", ...(openMission() ? [] : ["next_scene"])] : ["try_again", "new_start"],
  };
}

/**
 * @param {string} key label of the restart key
 * @param {boolean} isWin
 */
function restartText(key, isWin) {
  return isWin ? t("Press {key} to play again.", { key }) : t("Press {key} to try again.", { key });
}

/** @param {number | null} value */
function signed(value) {
  if (value === null) return "";
  const size = Math.abs(value);
  const digits = size.toLocaleString(undefined, { maximumFractionDigits: size < 10 ? 2 : size < 100 ? 1 : 0 });
  return (value < 0 ? "−" : "+") + digits;
}
