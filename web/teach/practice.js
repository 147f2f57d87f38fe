/** Practice for rewards: what each of them is worth, for how long, and how it goes. */

/**
 * @import { PracticeState, PractiseForRewards, TeachPart } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { button, element, keyed, setText } from "../shared/dom.js";
import { percent } from "../shared/numbers.js";
import { t, whole } from "../shared/text.js";
import { Curve } from "../panel/widgets/curve.js";
import { choice } from "../panel/widgets/parts.js";

/** Lengths of a practice, with their decisions. */
const LENGTHS = [
  { value: "8192", text: t("Short") },
  { value: "32768", text: t("Medium") },
  { value: "131072", text: t("Long") },
];
const NEW = "";
const FIRST = t("The robot tries things out, and does more of what is paid. Each line is a reward of this scene: 0 switches it off, 2 makes it worth twice as much. Begin with a network that learned from your drives: it knows the way already.");
/** Players of the other side, besides networks, by the name in the command. */
const OPPONENTS = { player: t("The scene's player"), self: t("Itself") };
const NOBODY = "";

export class PracticeView {
  #panel;
  #steps = LENGTHS[0].value;
  /** Number of the network to begin with; null until the person chooses, then the one that drives. */
  #beginWith = /** @type {string | null} */ (null);
  #suggested = NEW;
  #weights = element("div", { role: "group", ariaLabel: t("Worth of each reward") });
  #length = choice(t("Length"), (value) => (this.#steps = value));
  #opponent = NOBODY;
  #against = choice(t("Against"), (value) => (this.#opponent = value));
  #begin = choice(t("Begin with"), (value) => (this.#beginWith = value));
  #start = button(t("Practise"), () => void this.#practise(), { icon: "target", kind: "main" });
  #put = button(t("Put into the scene"), () => void this.#putIntoScene(), { icon: "scenes" });
  #pause = button(t("Pause"), () => this.#panel.send("teach_pause"), { icon: "pause", label: t("Pause the practice") });
  #goOn = button(t("Go on"), () => this.#panel.send("teach_go_on"), { icon: "play", label: t("Go on with the practice"), kind: "main" });
  #stop = button(t("Stop"), () => this.#panel.send("teach_stop_practising"), { icon: "stop" });
  #tools;
  #bar = element("progress", { max: 1, ariaLabel: t("Practice") });
  #curve = new Curve(t("Mean reward of an episode at each check"), t("Its mean reward at each check: the higher, the better."));
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
      LENGTHS.map(({ value, text }) => ({ value, text: speed ? t("{length}, about {time}", { length: text, time: roughly(Number(value) / speed) }) : text })),
      this.#steps,
    );
    keyed(this.#weights, rewards, (name) => name, weightRow);
    const kept = networks.map(({ number, title }) => ({ value: String(number), text: title }));
    const begins = [{ value: NEW, text: t("A new network") }, ...kept];
    if (!begins.some(({ value }) => value === this.#beginWith)) this.#beginWith = null;
    this.#suggested = String(networks.find((network) => network.is_driving)?.number ?? NEW);
    this.#begin.set(begins, this.#beginWith ?? this.#suggested);
    const others = opponents.flatMap((kind) => (kind === "file" ? kept : [{ value: kind, text: OPPONENTS[kind] }]));
    // a keyboard's player rests, and practice against nobody is better than none
    if (!opponents.includes("player")) others.unshift({ value: NOBODY, text: t("Nobody") });
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
    setText(this.#left, this.#left.hidden ? "" : t("At most {time} left", { time: roughly(practice.seconds_left) }));
    this.#curve.update(practice?.rewards ?? []);
    setText(this.#text, practice === null ? "" : sentenceOf(practice));
    setText(this.#hint, practice?.hint ?? "");
    this.#hint.hidden = !practice?.hint;
  }

  async #practise() {
    const weights = this.#chosenWeights();
    if (weights === null) return;
    const chosen = this.#beginWith ?? this.#suggested;
    const beginWith = chosen === NEW ? null : Number(chosen);
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
      this.#panel.notice(t("Each reward needs a number: 1 as in the scene, 0 to switch it off."), "error");
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
function sentenceOf(practice) {
  const { phase, problem, waiting, decisions, success, is_game: isGame, is_scene_changed: isSceneChanged, easy_starts: easy } = practice;
  const sentences = [];
  if (problem === "stopped") sentences.push(t("The practice was stopped."));
  else if (problem) return t("It could not go on: {problem}.", { problem });
  else if (phase !== "over" && waiting && decisions === 0) return waiting;
  else sentences.push(progressOf(practice));
  const share = success === null ? "" : percent(success);
  if (share) sentences.push(isGame ? t("It wins {share} of its games.", { share }) : t("It reaches the goal from {share} of its starts.", { share }));
  if (problem === "stopped" || phase === "over") return sentences.join(" ");
  if (easy !== null) {
    sentences.push(easy < 1 ? t("From easy to hard: its starts are {share} of the way.", { share: percent(easy) }) : t("It practises from all starts now."));
  }
  if (isSceneChanged) sentences.push(t("It practises in the scene as it was before your changes."));
  return [...sentences, waiting].filter(Boolean).join(" ");
}

/**
 * Return how long a robot has practised.
 * @param {PracticeState} practice
 */
function progressOf({ phase, decisions, elsewhere }) {
  const values = { name: elsewhere, count: whole(decisions) };
  switch (phase) {
    case "over":
      return elsewhere
        ? t("The {name} has practised for {count} decisions, and drives now.", values)
        : t("It has practised for {count} decisions, and drives now.", values);
    case "paused":
      return elsewhere
        ? t("The {name} has practised for {count} decisions, and waits for you.", values)
        : t("It has practised for {count} decisions, and waits for you.", values);
    default:
      return elsewhere ? t("The {name} has practised for {count} decisions.", values) : t("It has practised for {count} decisions.", values);
  }
}
