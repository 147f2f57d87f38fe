/** "If it stood here": another pose, dragged in the world or entered, and the action that would follow. */

/**
 * @import { AskElsewhere } from "../../generated/messages.js"
 * @import { StandingPose } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, setText } from "../../shared/dom.js";
import { freeId } from "../../shared/ids.js";
import { t } from "../../shared/text.js";
import { Bars, changedRow, hasEffect } from "../widgets/bars.js";
import { toggle } from "../widgets/parts.js";

/** Time without a change after which the action is asked for. */
const PAUSE_MS = 40;
/** @type {{name: keyof StandingPose, label: string, step: number}[]} */
const FIELDS = [
  { name: "x", label: "x (m)", step: 0.1 },
  { name: "y", label: "y (m)", step: 0.1 },
  { name: "heading_deg", label: t("Heading (°)"), step: 5 },
];

export class Elsewhere {
  #panel;
  #isOn = false;
  #isPaused = false;
  #isShown = false;
  #timer = 0;
  #asked = 0;
  #switch = toggle(t("Try another place"), (isOn) => this.#turn(isOn));
  #hint = element("p", { className: "ai4u-soft", textContent: t("Press Pause, then drag the purple robot.") });
  #inputs = new Map(FIELDS.map(({ name, step }) => /** @type {const} */ ([name, this.#input(step)])));
  #says = element("p", { className: "ai4u-soft", role: "status" });
  #action = new Bars();
  #body = element(
    "div",
    { className: "ai4u-elsewhere", hidden: true },
    element("p", { className: "ai4u-soft", textContent: t("Drag the purple outline in the world, turn it by its knob, or enter numbers.") }),
    element("div", { className: "ai4u-elsewhere-pose" }, ...FIELDS.map(({ name, label }) => field(label, this.#inputs.get(name)))),
    this.#says,
    this.#action.element,
    button(t("Where it stands"), () => this.#ask({}), { icon: "undo", kind: "quiet" }),
  );
  element = element("div", {}, this.#switch.element, this.#hint, this.#body);

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#hint.hidden = true;
    panel.addEventListener("part:run", () => this.#onRun());
    panel.addEventListener("stand_in", ({ detail }) => this.#onDrag(detail));
    panel.addEventListener("agent", () => this.#isOn && this.#isPaused && this.#ask({}));
    // a new connection has a new page on the server, which shows nothing yet
    panel.addEventListener("connected", () => this.#isShown && this.#askSoon());
  }

  /** @param {number} step that an arrow key adds */
  #input(step) {
    const made = element("input", { type: "number", id: freeId(), step: "any" }); // no inputMode: phones would leave out the minus
    made.addEventListener("input", () => made.value !== "" && this.#askSoon());
    made.addEventListener("keydown", (event) => stepBy(event, step));
    return made;
  }

  /** @param {boolean} isOn */
  #turn(isOn) {
    this.#isOn = isOn;
    this.#update();
  }

  #onRun() {
    const isPaused = Boolean(this.#panel.part("run")?.is_paused);
    const isMoved = isPaused && this.#isShown; // another moment of the past, or another tick
    if (isPaused !== this.#isPaused) {
      this.#isPaused = isPaused;
      this.#update();
    } else if (isMoved) this.#askSoon();
  }

  #update() {
    this.#hint.hidden = !this.#isOn || this.#isPaused;
    const isShown = this.#isOn && this.#isPaused;
    if (isShown === this.#isShown) return;
    this.#isShown = isShown;
    clearTimeout(this.#timer);
    if (isShown) this.#ask({});
    else {
      this.#asked += 1;
      this.#body.hidden = true;
      this.#panel.send("hide_elsewhere", {}, { quiet: true });
    }
  }

  /**
   * Take the pose to which the outline was dragged.
   * @param {StandingPose} pose
   */
  #onDrag(pose) {
    if (!this.#isShown) return;
    for (const [name, input] of this.#inputs) input.value = String(pose[name]);
    this.#askSoon();
  }

  #askSoon() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#isShown && this.#ask(this.#pose()), PAUSE_MS);
  }

  #pose() {
    return Object.fromEntries([...this.#inputs].map(([name, input]) => [name, Number(input.value)]));
  }

  /** @param {AskElsewhere} pose without numbers, where the agent stands */
  async #ask(pose) {
    const asked = ++this.#asked;
    const answer = await this.#panel.send("elsewhere", pose, { quiet: true });
    if (asked !== this.#asked || !this.#isShown) return;
    if (!answer.ok) {
      this.#switch.set(false);
      this.#turn(false);
      return;
    }
    for (const [name, input] of this.#inputs) {
      const isBeingTyped = document.activeElement === input && pose[name] !== undefined;
      if (!isBeingTyped) input.value = String(answer[name]);
    }
    this.#body.hidden = false;
    setText(this.#says, answer.can_stand ? t("There it would do:") : t("It can't stand there: no floor, or something is in the way."));
    this.#action.element.hidden = !answer.can_stand;
    this.#action.update(answer.action.filter(hasEffect).map(changedRow));
  }
}

/**
 * @param {string} label
 * @param {HTMLInputElement} input
 */
function field(label, input) {
  return element("div", { className: "ai4u-field" }, element("label", { htmlFor: input.id, textContent: label }), input);
}

/**
 * Arrow keys change a number by a step, from where it stands: the browser would jump to multiples of it.
 * @param {KeyboardEvent} event
 * @param {number} step
 */
function stepBy(event, step) {
  const sign = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
  if (!sign || event.altKey || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  const input = /** @type {HTMLInputElement} */ (event.currentTarget);
  input.value = String(Math.round(1000 * (Number(input.value) + sign * step)) / 1000);
  input.dispatchEvent(new Event("input", { bubbles: true }));
}
