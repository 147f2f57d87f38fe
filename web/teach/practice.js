/** Practice for rewards: what each of them is worth, for how long, and how it goes. */

/**
 * @import { PracticeState, TeachPart } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { button, element, keyed, setText } from "../shared/dom.js";
import { percent } from "../shared/numbers.js";
import { Curve } from "../panel/widgets/curve.js";
import { choice } from "../panel/widgets/parts.js";

/** Lengths of a practice, with their decisions. */
const LENGTHS = [
  { value: "8192", text: "Short" },
  { value: "32768", text: "Medium" },
  { value: "131072", text: "Long" },
];
const NEW = "";
/** Who plays the other side, besides networks, by the name in the command. */
const OPPONENTS = { player: "The scene's player", self: "Itself" };
const NOBODY = "";

export class PracticeView {
  #panel;
  #steps = LENGTHS[0].value;
  #beginWith = NEW;
  #weights = element("div", { role: "group", ariaLabel: "Worth of each reward" });
  #length = choice("Length", (value) => (this.#steps = value));
  #opponent = NOBODY;
  #against = choice("Against", (value) => (this.#opponent = value));
  #begin = choice("Begin with", (value) => (this.#beginWith = value));
  #start = button("Practise", () => void this.#practise(), { icon: "target", kind: "main" });
  #stop = button("Stop", () => this.#panel.send("teach_stop_practising"), { icon: "stop" });
  #bar = element("progress", { max: 1, ariaLabel: "Practice" });
  #curve = new Curve("Mean reward of an episode at each check");
  #text = element("p", { role: "status" });
  element = element("div", { className: "ai4u-teach-practice" });

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    const tools = element("div", { className: "ai4u-tools" }, this.#start, this.#stop);
    const settings = [this.#weights, this.#against.element, this.#length.element, this.#begin.element];
    this.element.append(...settings, tools, this.#bar, this.#curve.element, this.#text);
    this.#length.set(LENGTHS, this.#steps);
  }

  /**
   * @param {TeachPart} part
   * @param {boolean} isLearning true while a network learns from drives
   */
  update({ networks, opponents, practice, rewards }, isLearning) {
    keyed(this.#weights, rewards, (name) => name, weightRow);
    const kept = networks.map(({ number, title }) => ({ value: String(number), text: title }));
    if (!kept.some(({ value }) => value === this.#beginWith)) this.#beginWith = NEW;
    this.#begin.set([{ value: NEW, text: "A new network" }, ...kept], this.#beginWith);
    const others = opponents.flatMap((kind) => (kind === "file" ? kept : [{ value: kind, text: OPPONENTS[kind] }]));
    // a keyboard's player rests, and practice against nobody is better than none
    if (!opponents.includes("player")) others.unshift({ value: NOBODY, text: "Nobody" });
    if (!others.some(({ value }) => value === this.#opponent)) this.#opponent = others[0].value;
    this.#against.element.hidden = opponents.length === 0;
    this.#against.set(others, this.#opponent);
    const isUnderWay = practice !== null && !practice.is_over;
    this.#start.disabled = isUnderWay || isLearning;
    this.#stop.hidden = !isUnderWay;
    this.#bar.hidden = !isUnderWay;
    this.#bar.value = practice === null ? 0 : practice.decisions / practice.total;
    this.#curve.update(practice?.rewards ?? []);
    setText(this.#text, practice === null ? "" : sentenceOf(practice));
  }

  async #practise() {
    const inputs = [...this.#weights.querySelectorAll("input")];
    const weights = Object.fromEntries(inputs.map((input) => [input.name, input.valueAsNumber]));
    if (inputs.some((input) => Number.isNaN(input.valueAsNumber))) {
      this.#panel.notice("Each reward needs a number: 1 as in the scene, 0 to switch it off.", "error");
      return;
    }
    const beginWith = this.#beginWith === NEW ? null : Number(this.#beginWith);
    const opponent = /^\d+$/.test(this.#opponent) ? Number(this.#opponent) : null;
    const against = opponent === null ? this.#opponent || null : "file";
    const more = { begin_with: beginWith, against, opponent };
    await this.#panel.send("teach_practise", { steps: Number(this.#steps), weights, ...more }, { quiet: true });
  }
}

/** @param {string} name */
function weightRow(name) {
  const input = element("input", { type: "number", step: "any", value: "1", name, min: "-1000", max: "1000" });
  return element("label", { className: "ai4u-teach-weight" }, element("span", { textContent: name.replaceAll("_", " ") }), "×", input);
}

/** @param {PracticeState} practice */
function sentenceOf({ is_over: isOver, problem, decisions, success }) {
  const reached = success === null ? "" : ` It reaches the goal from ${percent(success)} of its starts.`;
  if (problem === "stopped") return `The practice was stopped.${reached}`;
  if (problem) return `It could not go on: ${problem}.`;
  const count = decisions.toLocaleString("en");
  return isOver ? `It has practised for ${count} decisions, and drives now.${reached}` : `It has practised for ${count} decisions.${reached}`;
}
