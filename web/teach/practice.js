/** Practice for rewards: what each of them is worth, for how long, and how it goes. */

/**
 * @import { PracticeState, PractiseForRewards, TeachPart } from "../generated/messages.js"
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
const FIRST =
  "The robot tries things out, and does more of what is paid. Each line is a reward of this scene: 0 switches it off, 2 makes it worth twice as much. " +
  "Begin with a network that learned from your drives: it knows the way already.";
/** Players of the other side, besides networks, by the name in the command. */
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
  #put = button("Put into the scene", () => void this.#putIntoScene(), { icon: "scenes" });
  #pause = button("Pause", () => this.#panel.send("teach_pause"), { icon: "pause", label: "Pause the practice" });
  #goOn = button("Go on", () => this.#panel.send("teach_go_on"), { icon: "play", label: "Go on with the practice", kind: "main" });
  #stop = button("Stop", () => this.#panel.send("teach_stop_practising"), { icon: "stop" });
  #tools;
  #bar = element("progress", { max: 1, ariaLabel: "Practice" });
  #curve = new Curve("Mean reward of an episode at each check");
  #text = element("p", { role: "status" });
  #left = element("p", { className: "ai4u-soft" });
  #hint = element("p", { className: "ai4u-hint-text", role: "status" });
  element = element("div", { className: "ai4u-teach-practice" });

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#tools = element("div", { className: "ai4u-tools" }, this.#start, this.#goOn, this.#pause, this.#stop, this.#put);
    const settings = [this.#weights, this.#against.element, this.#length.element, this.#begin.element];
    const first = element("p", { className: "ai4u-hint-text", textContent: FIRST });
    this.element.append(first, ...settings, this.#tools, this.#bar, this.#left, this.#curve.element, this.#text, this.#hint);
  }

  /**
   * @param {TeachPart} part
   * @param {boolean} isLearning true while a network learns from drives
   */
  update({ decisions_per_s: speed, networks, opponents, practice, rewards }, isLearning) {
    this.#length.set(
      LENGTHS.map(({ value, text }) => ({ value, text: speed ? `${text}, about ${roughly(Number(value) / speed)}` : text })),
      this.#steps,
    );
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
    const phase = practice === null ? "over" : practice.phase;
    const focused = document.activeElement;
    this.#start.hidden = phase !== "over";
    this.#start.disabled = isLearning;
    this.#goOn.hidden = phase !== "paused";
    this.#goOn.disabled = isLearning;
    this.#pause.hidden = phase !== "running";
    this.#stop.hidden = phase === "over";
    if (focused instanceof HTMLElement && focused.hidden && this.#tools.contains(focused)) {
      /** @type {HTMLElement | null} */ (this.#tools.querySelector("button:not([hidden], :disabled)"))?.focus();
    }
    this.#bar.hidden = phase === "over";
    this.#bar.value = practice === null ? 0 : practice.decisions / practice.total;
    this.#left.hidden = phase !== "running" || practice.seconds_left === null || practice.waiting !== "";
    setText(this.#left, this.#left.hidden ? "" : `At most ${roughly(practice.seconds_left)} left`);
    this.#curve.update(practice?.rewards ?? []);
    setText(this.#text, practice === null ? "" : sentenceOf(practice));
    setText(this.#hint, practice?.hint ?? "");
    this.#hint.hidden = !practice?.hint;
  }

  async #practise() {
    const weights = this.#chosenWeights();
    if (weights === null) return;
    const beginWith = this.#beginWith === NEW ? null : Number(this.#beginWith);
    const opponent = /^\d+$/.test(this.#opponent) ? Number(this.#opponent) : null;
    const player = /** @type {PractiseForRewards["against"]} */ (this.#opponent || null);
    const against = opponent === null ? player : /** @type {const} */ ("file");
    const more = { begin_with: beginWith, against, opponent };
    await this.#panel.send("teach_practise", { steps: Number(this.#steps), weights, ...more }, { quiet: true });
  }

  /** The factors become the scene's own amounts, so that they are 1 then. */
  async #putIntoScene() {
    const weights = this.#chosenWeights();
    if (weights === null) return;
    const { ok } = await this.#panel.send("teach_put_rewards", { weights });
    if (ok) for (const input of this.#weights.querySelectorAll("input")) input.value = "1";
  }

  /** Return the factors, or null if one is no number, which the page says then. */
  #chosenWeights() {
    const inputs = [...this.#weights.querySelectorAll("input")];
    if (inputs.some((input) => Number.isNaN(input.valueAsNumber))) {
      this.#panel.notice("Each reward needs a number: 1 as in the scene, 0 to switch it off.", "error");
      return null;
    }
    return Object.fromEntries(inputs.map((input) => [input.name, input.valueAsNumber]));
  }
}

/** Return a duration in words. @param {number} seconds */
function roughly(seconds) {
  return seconds < 90 ? `${Math.ceil(seconds)} s` : `${Math.round(seconds / 60)} min`;
}

/** @param {string} name */
function weightRow(name) {
  const input = element("input", { type: "number", step: "any", value: "1", name, min: "-1000", max: "1000" });
  return element("label", { className: "ai4u-teach-weight" }, element("span", { textContent: name.replaceAll("_", " ") }), "×", input);
}

/** @param {PracticeState} practice */
function sentenceOf({ phase, problem, waiting, decisions, success, is_game: isGame, elsewhere, is_scene_changed: isSceneChanged, easy_starts: easy }) {
  const share = success === null ? "" : percent(success);
  const reached = share && (isGame ? ` It wins ${share} of its games.` : ` It reaches the goal from ${share} of its starts.`);
  if (problem === "stopped") return `The practice was stopped.${reached}`;
  if (problem) return `It could not go on: ${problem}.`;
  const count = decisions.toLocaleString("en");
  const who = elsewhere ? `The ${elsewhere}` : "It";
  if (phase === "over") return `${who} has practised for ${count} decisions, and drives now.${reached}`;
  if (waiting && decisions === 0) return waiting;
  const waits = phase === "paused" ? ", and waits for you" : "";
  const scene = isSceneChanged ? " It practises in the scene as it was before your changes." : "";
  const starts = easy === null ? "" : easy < 1 ? ` From easy to hard: its starts are ${percent(easy)} of the way.` : " It practises from all starts now.";
  return `${who} has practised for ${count} decisions${waits}.${reached}${starts}${scene}${waiting && ` ${waiting}`}`;
}
