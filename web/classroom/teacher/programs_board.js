/** The board of programs: the mistakes that stopped them, and the beginning of each student's program. */

/** @import { ClassState, ProgramRun, Seat, SeatProgram } from "../../types/class.js" */
/** @import { RealNames } from "./real_names.js" */

import { splitProgram } from "../../blocks/text.js";
import { element, keyed, setAttributes, setText, unlessPressed } from "../../shared/dom.js";
import { t } from "../../shared/text.js";
import { mistakeCard } from "./misconceptions.js";
import { programFacts, programsOf } from "./room_programs.js";

const EMPTY = t("No programs yet. When students write programs in the tab Code, each of them appears here.");
/** Time until the programs are read again while they are shown (ms). */
const REFRESH_MS = 4000;
/**
 * Signs and words of how a program runs; a sign differs in shape.
 * @type {Record<string, {sign: string, text: string}>}
 */
const RUNS = {
  running: { sign: "▶", text: t("runs") },
  mistake: { sign: "!", text: t("stopped by a mistake") },
};

export class ProgramsBoard {
  #place;
  #realNames;
  #onOpen;
  /** @type {ClassState | null} */
  #state = null;
  /** @type {SeatProgram[]} */
  #programs = [];
  #toldMistakes = "";
  #timer = 0;
  #problem = element("p", { className: "ai4u-problem", role: "alert" });
  #mistakes = element("section", { className: "ai4u-mistakes" });
  #empty = element("p", { className: "ai4u-empty", textContent: EMPTY });
  #list = element("ul", { className: "ai4u-glances", ariaLabel: t("Programs") });

  /**
   * @param {HTMLElement} place the panel of the tab
   * @param {RealNames} realNames
   * @param {(seat: number) => void} onOpen called with the number of the seat whose program is chosen
   */
  constructor(place, realNames, onOpen) {
    this.#place = place;
    this.#realNames = realNames;
    this.#onOpen = onOpen;
    place.append(this.#problem, this.#mistakes, this.#empty, this.#list);
  }

  /**
   * Show the class's state; while the tab is shown, programs are read again and again.
   * @param {ClassState} state
   */
  show(state) {
    this.#state = state;
    unlessPressed(this.#place, () => this.#draw());
    if (this.#place.hidden) {
      clearTimeout(this.#timer);
      this.#timer = 0;
    } else if (!this.#timer) this.#read();
  }

  async #read() {
    this.#timer = setTimeout(() => this.#read(), REFRESH_MS);
    try {
      this.#programs = (await programsOf("")).programs;
      setText(this.#problem, "");
    } catch (error) {
      setText(this.#problem, error.message);
    }
    unlessPressed(this.#place, () => this.#draw());
  }

  #draw() {
    this.#drawMistakes();
    if (!this.#place.hidden) this.#drawPrograms();
  }

  #drawMistakes() {
    const { seats, program_mistakes: mistakes = [] } = this.#state;
    const names = (/** @type {number[]} */ numbers) => numbers.map((number) => this.#nameOf(seats.find((seat) => seat.number === number))).filter(Boolean);
    const named = mistakes.map((each) => ({ ...each, names: names(each.seats) }));
    const told = JSON.stringify(named);
    if (told === this.#toldMistakes) return;
    this.#toldMistakes = told;
    const title = element("h2", { textContent: t("Mistakes that stopped programs") });
    const cards = named.map((mistake) => mistakeCard({ ...mistake, sentence: mistake.title }));
    this.#mistakes.replaceChildren(...(cards.length ? [title, ...cards] : []));
  }

  /** Draw the programs that a mistake has stopped first. */
  #drawPrograms() {
    const { seats, runs = {} } = this.#state;
    const here = new Map(seats.filter((seat) => seat.state === "in").map((seat) => [seat.number, seat]));
    const isStopped = (/** @type {SeatProgram} */ { seat }) => runs[seat]?.state === "mistake";
    const shown = this.#programs.filter(({ seat }) => here.has(seat)).sort((a, b) => Number(isStopped(b)) - Number(isStopped(a)));
    this.#empty.hidden = shown.length > 0;
    keyed(
      this.#list,
      shown,
      ({ seat }) => seat,
      ({ seat }) => this.#makeGlance(seat),
      (item, program) => this.#update(item.firstElementChild, program, here.get(program.seat), runs[program.seat]),
    );
  }

  /** @param {number} seat */
  #makeGlance(seat) {
    const head = element("span", { className: "ai4u-glance-head" }, element("strong"), element("span", { className: "ai4u-facts" }));
    const parts = [head, element("span", { className: "ai4u-glance-run" }), element("span", { className: "ai4u-glance-code" })];
    return element("li", {}, element("button", { type: "button", className: "ai4u-glance", on: { click: () => this.#onOpen(seat) } }, ...parts));
  }

  /**
   * @param {Element} glance
   * @param {SeatProgram} program
   * @param {Seat} seat
   * @param {ProgramRun | undefined} run
   */
  #update(glance, program, seat, run) {
    const { python, isOfBlocks } = splitProgram(program.source);
    const { sign, text } = RUNS[run?.state] ?? { sign: "", text: "" };
    const isMistake = run?.state === "mistake";
    const mistake = run?.line ? t("line {line}: {text}", { line: run.line, text: run.text }) : run?.text;
    const [head, state] = glance.children;
    const code = /** @type {HTMLElement} */ (glance.lastElementChild);
    setText(head.firstChild, this.#nameOf(seat));
    setText(head.lastChild, [programFacts(program, this.#state), isOfBlocks && t("made of blocks")].filter(Boolean).join(" · "));
    setText(state, sign && `${sign} ${isMistake ? mistake : text}`);
    setAttributes(glance, { "data-run": run?.state ?? "" });
    drawCode(code, python, isMistake ? run.line : 0);
  }

  /** @param {Seat | undefined} seat */
  #nameOf(seat) {
    if (!seat) return "";
    const real = this.#realNames.of(seat);
    return real ? `${seat.name} (${real})` : seat.name;
  }
}

/**
 * Show a program with its line numbers; the line with the mistake is marked.
 * @param {HTMLElement} place
 * @param {string} python
 * @param {number} mistake its line; 0 for none
 */
function drawCode(place, python, mistake) {
  const told = `${mistake} ${python}`;
  if (place.dataset.told === told) return;
  place.dataset.told = told;
  const lines = python.replace(/\n+$/, "").split("\n");
  place.replaceChildren(
    ...lines.map((text, index) => {
      const made = element("span", { textContent: text || " " });
      if (index + 1 === mistake) made.dataset.mistake = "";
      return made;
    }),
  );
  /** @type {HTMLElement | null} */
  const marked = place.querySelector("[data-mistake]");
  place.scrollTop = marked ? marked.offsetTop - place.offsetTop - place.clientHeight / 2 : 0;
}
