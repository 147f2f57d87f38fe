/**
 * The bar of a class above the world: whose world it is, who else is here, the teacher's message, and a race.
 *
 * The page of a world without a class never makes one.
 */

/** @import { ClassEvent, Person, StudentRace } from "../../types/class.js" */

import { clock } from "../../shared/numbers.js";
import { BlankScreen, RaceCountdown } from "./overlay.js";
import { element, keyed, setAttributes, setText } from "../../shared/dom.js";
import { showHandIn } from "./hand_in_dialog.js";
import { icon } from "../../shared/icons.js";
import { ask, tell } from "../../shared/dialog.js";
import { t, tn } from "../../shared/text.js";

/** Interval at which countdowns are drawn (ms). */
const TICK_MS = 200;
/** Interval at which the class is asked whether a code was used (ms). */
const CODE_POLL_MS = 3000;
/** Most names of others in the bar. */
const MAX_NAMES = 3;
/** @type {Record<string, string>} */
const OUTCOMES = { fell: t("fell"), time: t("time is up"), lost: t("lost") };

export class ClassBar {
  #onChange;
  #root = document.documentElement;
  #dot = element("span", { className: "ai4u-class-dot", ariaHidden: "true" });
  #name = element("strong");
  #lesson = element("span", { className: "ai4u-class-lesson" });
  #others = element("ul", { className: "ai4u-class-others", ariaLabel: t("Also in this world") });
  #teacher = element("span", { className: "ai4u-class-teacher", ariaLive: "polite" });
  #message = element("p", { className: "ai4u-class-message", role: "status" });
  #time = element("span", { className: "ai4u-class-time", role: "timer" });
  #race = element("span", { className: "ai4u-class-race" });
  #best = element("span");
  #board = element("ol", { className: "ai4u-class-board", id: "ai4u-class-board", hidden: true });
  #boardButton = element(
    "button",
    { type: "button", className: "ai4u-plain", ariaExpanded: "false", on: { click: () => this.#toggleBoard() } },
    t("Board"),
  );
  #actions = element("div", { className: "ai4u-class-actions" });
  #bar = element("section", { className: "ai4u-class-bar", ariaLabel: t("Class") });
  #blank = new BlankScreen();
  #countdown = new RaceCountdown();
  /** @type {ClassEvent | null} */
  #event = null;
  /** End of countdowns (ms, performance.now); Infinity for none. */
  #attentionEndsAt = Infinity;
  #raceStartsAt = -Infinity;
  #timer = 0;

  /** @param {() => void} onChange called when the texts for the page's banner have changed */
  constructor(onChange) {
    this.#onChange = onChange;
    setAttributes(this.#boardButton, { "aria-controls": this.#board.id });
    this.#race.append(icon("race", 16), this.#best, this.#boardButton, this.#board);
    const news = element("div", { className: "ai4u-class-news" }, this.#message, this.#time);
    const self = element("span", { className: "ai4u-class-self" }, this.#dot, this.#name, this.#lesson);
    this.#bar.append(self, this.#others, this.#teacher, news, this.#race, this.#actions);
    // the page of a class's own machine; elsewhere there is no such address
    if (location.pathname.includes("/r/")) this.#actions.append(...studentActions());
    new ResizeObserver(() => this.#reserveHeight()).observe(this.#bar);
  }

  /** The teacher's words for a world that stands still; empty while a race counts down. */
  get heldText() {
    if (this.#msToRace() > 0) return "";
    const attention = this.#event?.attention;
    if (this.#event?.role === "teacher") return attention.kind ? t("You have stopped all worlds") : "";
    return attention?.message || t("Your teacher has stopped all worlds");
  }

  /**
   * Return the name of a seat; empty if it is not known.
   * @param {number} number
   */
  nameOf(number) {
    return this.#event?.people.find((each) => each.number === number)?.name ?? "";
  }

  /**
   * Show an event of the input socket.
   * @param {ClassEvent} event
   */
  show(event) {
    const now = performance.now();
    const { attention, race } = event;
    this.#attentionEndsAt = attention.ends_in > 0 ? now + 1000 * attention.ends_in : Infinity;
    this.#raceStartsAt = race?.phase === "countdown" ? now + 1000 * race.starts_in : -Infinity;
    this.#event = event;
    if (!this.#bar.isConnected) document.body.prepend(this.#bar);
    this.#drawPeople(event);
    this.#drawRace(race);
    setText(this.#teacher, event.has_teacher ? t("Your teacher looks in") : "");
    setText(this.#lesson, event.lesson ? t("Lesson {lesson}", { lesson: event.lesson }) : "");
    setText(this.#message, attention.kind ? "" : attention.message);
    this.#actions.hidden = event.role === "teacher";
    this.#tick();
    this.#onChange();
  }

  #tick() {
    clearTimeout(this.#timer);
    const { attention, role, race } = this.#event;
    const now = performance.now();
    const isOver = now >= this.#attentionEndsAt;
    const left = Number.isFinite(this.#attentionEndsAt) && !isOver ? clock((this.#attentionEndsAt - now) / 1000) : "";
    const isAny = Boolean(attention.kind || attention.message) && !isOver;
    if (isOver) setText(this.#message, "");
    setText(this.#time, isAny && left && attention.kind ? t("Goes on in {time}", { time: left }) : isAny ? left : "");
    const isBlank = attention.kind === "blank" && role !== "teacher" && !isOver;
    this.#blank.draw(isBlank ? { message: attention.message, left } : null);
    const toRace = this.#msToRace();
    const wasCounting = this.#countdown.isShown;
    this.#countdown.draw(toRace);
    if (wasCounting !== this.#countdown.isShown) this.#onChange();
    setText(this.#best, raceText(race, toRace));
    const isTicking = (isAny && left) || toRace > 0 || this.#countdown.isShown;
    if (isTicking) this.#timer = setTimeout(() => this.#tick(), TICK_MS);
  }

  #msToRace() {
    return this.#raceStartsAt - performance.now();
  }

  /** @param {ClassEvent} event */
  #drawPeople({ name, colour, role, people }) {
    const isTeacher = role === "teacher";
    setText(this.#name, isTeacher ? t("Teacher") : name || t("Our world"));
    this.#dot.hidden = !colour;
    this.#dot.style.background = colour;
    const others = people.filter((each) => isTeacher || each.name !== name);
    const shown = others.slice(0, MAX_NAMES);
    keyed(this.#others, shown, ({ number }) => number, makePerson, updatePerson);
    const rest = others.slice(MAX_NAMES).map((each) => each.name);
    if (rest.length) this.#others.append(element("li", { textContent: `+${rest.length}`, title: rest.join(", ") }));
    this.#others.hidden = others.length === 0;
  }

  /** @param {StudentRace | null} race */
  #drawRace(race) {
    this.#race.hidden = race === null;
    const rows = race?.board ?? [];
    this.#boardButton.hidden = rows.length === 0;
    if (!rows.length) this.#showBoard(false);
    this.#board.replaceChildren(...rows.map(boardRow));
  }

  #toggleBoard() {
    this.#showBoard(this.#board.hidden === true);
  }

  /** @param {boolean} isShown */
  #showBoard(isShown) {
    this.#board.hidden = !isShown;
    this.#boardButton.ariaExpanded = String(isShown);
  }

  /** Keep the bar's height in a CSS variable: the world and the panel stand below it. */
  #reserveHeight() {
    this.#root.style.setProperty("--ai4u-class-height", `${this.#bar.offsetHeight}px`);
    dispatchEvent(new Event("resize")); // the canvas has moved
  }
}

/** @param {Person} person */
function makePerson({ name, colour }) {
  const dot = element("span", { className: "ai4u-class-dot", ariaHidden: "true" });
  dot.style.background = colour;
  return element("li", {}, dot, element("span", { textContent: name }), element("small"));
}

/**
 * @param {HTMLElement} item
 * @param {Person} person
 */
function updatePerson(item, { name, is_here: isHere }) {
  item.toggleAttribute("data-away", !isHere);
  item.title = isHere ? name : t("{name} (not here)", { name });
  setText(item.querySelector("small"), isHere ? "" : t("(not here)"));
}

/** @param {StudentRace["board"][number]} row */
function boardRow({ name, colour, outcome, seconds }) {
  const dot = element("span", { className: "ai4u-class-dot", ariaHidden: "true" });
  dot.style.background = colour;
  const result = OUTCOMES[outcome] ?? `${seconds.toFixed(2)} s`;
  return element("li", {}, dot, element("span", { textContent: name }), element("span", { textContent: result }));
}

/**
 * @param {StudentRace | null} race
 * @param {number} toRace time to its start (ms)
 */
function raceText(race, toRace) {
  if (!race) return "";
  if (toRace > 0) return t("Race");
  const isOver = race.phase === "over";
  if (race.own_best === null) return isOver ? t("Race over") : t("Race");
  const time = race.own_best.toFixed(2);
  return isOver ? t("Race over, your best: {time} s", { time }) : t("Race, your best: {time} s", { time });
}

/** Return the buttons with which a student hands in a network, takes the work home, or goes on at another device. */
function studentActions() {
  const handIn = element("button", { type: "button", className: "ai4u-plain", title: t("Hand in a network for a tournament") });
  handIn.append(icon("upload", 16), element("span", { textContent: t("Hand in") }));
  handIn.addEventListener("click", () => void showHandIn());
  const work = element("a", { className: "ai4u-plain", href: "../../api/my-work", download: "", title: t("Download my work") });
  work.append(icon("download", 16), element("span", { textContent: t("My work") }));
  const move = element("button", { type: "button", className: "ai4u-plain", title: t("Go on at another device") });
  move.append(icon("phone", 16), element("span", { textContent: t("Other device") }));
  move.addEventListener("click", showMoveCode);
  return [handIn, work, move];
}

async function showMoveCode() {
  /** @type {{code: string, minutes: number, problem?: string}} */
  let answer;
  try {
    const response = await fetch("../../api/move-code", { method: "POST", cache: "no-store" });
    answer = await response.json();
    if (!response.ok) throw new Error(answer.problem);
  } catch (error) {
    const isOurs = answer?.problem;
    await tell(t("No code"), isOurs ? error.message : t("The class can't be reached. Try again in a moment."));
    return;
  }
  const { code, minutes } = answer;
  const home = new URL("../../", document.baseURI);
  const text = tn(
    "Open {address} there and type this code. It is yours alone, and works for {n} minute.",
    "Open {address} there and type this code. It is yours alone, and works for {n} minutes.",
    minutes,
    { address: `${home.host}${home.pathname.replace(/\/$/, "")}` },
  );
  const content = [element("p", { className: "ai4u-move-code", textContent: code })];
  const shown = ask({ title: t("Go on at another device"), text, yes: t("Close"), no: "", content });
  const timer = setInterval(() => closeIfUsed(content[0]), CODE_POLL_MS);
  await shown;
  clearInterval(timer);
}

/**
 * Close the dialog with a code that the other device has used, or whose time is over.
 * @param {HTMLElement} content
 */
async function closeIfUsed(content) {
  const answer = await fetch("../../api/move-code", { cache: "no-store" }).catch(/** @returns {null} */ () => null);
  if (answer?.ok && !(await answer.json()).is_open) content.closest("dialog")?.close();
}
