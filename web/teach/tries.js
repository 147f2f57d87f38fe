/** "Try many": the driver of the robot drives from the same starts with each value of a number. */

/**
 * @import { TriedValue, TriesPart, TriesState, VariableNumber } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { button, element, keyed, setText, tableHead } from "../shared/dom.js";
import { number, percent, seconds } from "../shared/numbers.js";
import { choice } from "../panel/widgets/parts.js";
import { IntervalPlot } from "./interval_plot.js";

const FIRST = "Choose a number and some values. The robot's driver drives from the same starts with each of them, in a copy of the world.";
/** First choice where it is there. */
const PREFERRED = "brain";

export class TriesView {
  #panel;
  #owner = "";
  #name = "";
  /** @type {VariableNumber[]} */
  #numbers = [];
  #owners = choice("Part", (owner) => this.#choose(owner, ""));
  #names = choice("Number", (name) => this.#choose(this.#owner, name));
  #values = element("input", { type: "text", placeholder: "1, 2, 4, 8", inputMode: "text", required: true });
  #limits = element("p", { className: "ai4u-hint-text" });
  #starts = element("input", { type: "number", min: "1", step: "1", value: "20", required: true });
  #problem = element("p", { className: "ai4u-problem", role: "status" });
  #start = button("Try", () => void this.#try(), { icon: "play", kind: "main" });
  #stop = button("Stop", () => this.#panel.send("teach_stop_trying"), { icon: "stop" });
  #bar = element("progress", { max: 1, ariaLabel: "Tries" });
  #text = element("p", { role: "status" });
  #plot = new IntervalPlot();
  #caption = element("caption");
  #body = element("tbody");
  #head = tableHead("Value", "Goal", "95% between", "Reward", "Time");
  #table = element("table", { className: "ai4u-table ai4u-tries" }, this.#caption, this.#head, this.#body);
  #save = button("CSV", () => void this.#download(), { icon: "download", label: "Save the table as CSV" });
  element = element("div", { className: "ai4u-teach-tries" });

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    const form = element(
      "div",
      { className: "ai4u-tries-form" },
      this.#owners.element,
      this.#names.element,
      labelled("Values", this.#values),
      this.#limits,
      labelled("Starts", this.#starts),
      element("div", { className: "ai4u-tools" }, this.#start, this.#stop),
    );
    const hint = element("p", { className: "ai4u-hint-text", textContent: FIRST });
    const result = [this.#bar, this.#text, this.#plot.element, this.#table, this.#save];
    this.element.append(hint, this.#problem, form, ...result);
    panel.addEventListener("part:tries", ({ detail }) => this.update(detail));
    const part = panel.part("tries");
    if (part !== null) this.update(part);
  }

  /** @param {TriesPart} part */
  update({ max_starts: maxStarts, numbers, problem, tries }) {
    this.#numbers = numbers;
    this.#starts.max = String(maxStarts);
    this.#choose(this.#owner, this.#name);
    setText(this.#problem, problem);
    this.#problem.hidden = !problem;
    const isUnderWay = tries !== null && !tries.is_over;
    this.#start.disabled = isUnderWay || Boolean(problem);
    this.#stop.hidden = !isUnderWay;
    this.#bar.hidden = !isUnderWay;
    this.#bar.value = tries === null ? 0 : tries.done / tries.total;
    setText(this.#text, tries === null ? "" : sentenceOf(tries));
    this.#text.toggleAttribute("data-problem", tries !== null && tries.is_over && tries.problem !== "");
    this.#drawResult(tries);
  }

  /** @param {TriesState | null} tries */
  #drawResult(tries) {
    const rows = tries?.rows ?? [];
    const label = tries?.label ?? "";
    const shares = rows.flatMap(({ value, episodes, successes, low, high }) =>
      successes === null || low === null || high === null ? [] : [{ value, middle: successes / episodes, low, high }],
    );
    for (const each of [this.#table, this.#save]) each.hidden = rows.length === 0;
    this.#plot.update(shares, `Share of starts that reached the goal, by ${label}`);
    setText(this.#caption, label);
    keyed(this.#body, rows, ({ value }) => value, makeRow, updateRow);
  }

  /**
   * Show the numbers of an owner; one that is not there is replaced by the first one that is.
   * @param {string} owner
   * @param {string} name
   */
  #choose(owner, name) {
    const owners = [...new Set(this.#numbers.map((each) => each.owner))];
    this.#owner = owners.includes(owner) ? owner : owners.includes(PREFERRED) ? PREFERRED : (owners[0] ?? "");
    const mine = this.#numbers.filter((each) => each.owner === this.#owner);
    const chosen = mine.find((each) => each.name === name) ?? mine[0];
    this.#name = chosen?.name ?? "";
    this.#owners.set(owners.map((value) => ({ value, text: value })), this.#owner);
    this.#names.set(mine.map(({ name: value, label }) => ({ value, text: label })), this.#name);
    setText(this.#limits, chosen ? limitsOf(chosen) : "");
  }

  async #try() {
    for (const input of [this.#values, this.#starts]) if (!input.reportValidity()) return;
    const [values, starts] = [this.#values.value, this.#starts.valueAsNumber];
    await this.#panel.send("teach_try", { parameter: this.#name, values, starts }, { quiet: true });
  }

  async #download() {
    const { ok, name, data } = await this.#panel.send("teach_download_tried", {}, { quiet: true });
    if (!ok) return;
    const url = URL.createObjectURL(new Blob([data], { type: "text/csv" }));
    element("a", { href: url, download: name }).click();
    URL.revokeObjectURL(url);
  }
}

/**
 * @param {string} text
 * @param {HTMLInputElement} input
 */
function labelled(text, input) {
  return element("label", { className: "ai4u-teach-weight" }, element("span", { textContent: text }), input);
}

/** @param {VariableNumber} number */
function limitsOf({ value, limits }) {
  const now = value === null ? "It has no value now." : `It is ${Number(value.toPrecision(6))} now.`;
  return limits ? `${now} It can be ${limits}.` : now;
}

/** @param {TriesState} tries */
function sentenceOf({ is_over: isOver, problem, waiting, done, total }) {
  if (waiting) return waiting;
  if (!isOver) return `${done} of ${total} episodes.`;
  if (problem === "stopped") return `It was stopped after ${done} of ${total} episodes.`;
  return problem ? `It could not go on: ${problem}.` : `${total} episodes, the same starts with each value.`;
}

/** @param {TriedValue} row */
function makeRow({ value }) {
  const cells = [1, 2, 3, 4].map(() => element("td"));
  return element("tr", {}, element("th", { scope: "row", textContent: String(value) }), ...cells);
}

/**
 * @param {HTMLElement} row
 * @param {TriedValue} tried
 */
function updateRow(row, { episodes, successes, low, high, reward, seconds: time }) {
  const [, goal, between, paid, duration] = row.children;
  setText(goal, successes === null ? "–" : `${successes} of ${episodes}`);
  setText(between, low === null || high === null ? "–" : `${percent(low)} and ${percent(high)}`);
  setText(paid, number(reward));
  setText(duration, seconds(time));
}
