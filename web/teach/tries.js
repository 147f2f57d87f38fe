/** "Try many": the driver of the robot drives from the same starts with each value of a number. */

/**
 * @import { TriedValue, TriesPart, TriesState, VariableNumber } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { button, element, keyed, setText, tableHead } from "../shared/dom.js";
import { number, percent, seconds } from "../shared/numbers.js";
import { t } from "../shared/text.js";
import { choice } from "../panel/widgets/parts.js";
import { IntervalPlot } from "./interval_plot.js";

const FIRST = t("Choose a number and some values. The robot's driver drives from the same starts with each of them, in a copy of the world.");
const STOPPED = "stopped";
/** Names of the drivers: that of the robot now, and this page's program. */
const [DRIVER, PROGRAM] = ["driver", "program"];
/** First choice where it is there. */
const PREFERRED = "brain";

export class TriesView {
  #panel;
  #owner = "";
  #name = "";
  /** @type {VariableNumber[]} */
  #numbers = [];
  #driver = DRIVER;
  #drivers = choice(t("Driver"), (driver) => this.#choose(this.#owner, this.#name, driver));
  /** Reason against the robot's driver. */
  #reason = "";
  #isUnderWay = false;
  #owners = choice(t("Part"), (owner) => this.#choose(owner, ""));
  #names = choice(t("Number"), (name) => this.#choose(this.#owner, name));
  #values = element("input", { type: "text", placeholder: "1, 2, 4, 8", inputMode: "text", required: true });
  #limits = element("p", { className: "ai4u-hint-text" });
  #starts = element("input", { type: "number", min: "1", step: "1", value: "20", required: true });
  #problem = element("p", { className: "ai4u-problem", role: "status" });
  #start = button(t("Try"), () => void this.#try(), { icon: "play", kind: "main" });
  #stop = button(t("Stop"), () => this.#panel.send("teach_stop_trying"), { icon: "stop" });
  #bar = element("progress", { max: 1, ariaLabel: t("Tries") });
  #text = element("p", { role: "status" });
  #plot = new IntervalPlot();
  #caption = element("caption");
  #body = element("tbody");
  #head = tableHead(t("Value"), t("Goal"), t("95% between"), t("Reward"), t("Time"));
  #table = element("table", { className: "ai4u-table ai4u-tries" }, this.#caption, this.#head, this.#body);
  #save = button("CSV", () => void this.#download(), { icon: "download", label: t("Save the table as CSV") });
  element = element("div", { className: "ai4u-teach-tries" });

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    const form = element(
      "div",
      { className: "ai4u-tries-form" },
      this.#drivers.element,
      this.#owners.element,
      this.#names.element,
      labelled(t("Values"), this.#values),
      this.#limits,
      labelled(t("Starts"), this.#starts),
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
    this.#reason = problem;
    const isUnderWay = tries !== null && !tries.is_over;
    this.#isUnderWay = isUnderWay;
    this.#choose(this.#owner, this.#name);
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
    this.#plot.update(shares, t("Share of starts that reached the goal, by {label}", { label }));
    setText(this.#caption, label);
    keyed(this.#body, rows, ({ value }) => value, makeRow, updateRow);
  }

  /**
   * Show the numbers of an owner; one that is not there is replaced by the first one that is.
   * @param {string} owner
   * @param {string} name
   * @param {string} [driver]
   */
  #choose(owner, name, driver = this.#driver) {
    this.#driver = driver;
    this.#drivers.set([{ value: DRIVER, text: t("The robot's driver") }, { value: PROGRAM, text: t("My program in the tab Code") }], driver);
    const problem = driver === PROGRAM ? "" : this.#reason;
    setText(this.#problem, problem);
    this.#problem.hidden = !problem;
    this.#start.disabled = this.#isUnderWay || Boolean(problem);
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
    const wanted = { parameter: this.#name, values, starts };
    if (this.#driver === PROGRAM) await this.#tryProgram(wanted);
    else await this.#panel.send("teach_try", wanted, { quiet: true });
  }

  /**
   * Let the program of the tab Code drive in this world, with one value after another. The world has the scene's own
   * numbers again when that ends in any way, also when this page is closed.
   * @param {{parameter: string, values: string, starts: number}} wanted
   */
  async #tryProgram(wanted) {
    const code = this.#panel.code;
    if (code === null) {
      this.#panel.notice(t("Open the tab Code first: your program is there."), "error");
      return;
    }
    const { ok, values } = await this.#panel.send("teach_try_program", wanted, { quiet: true });
    if (!ok) return;
    const held = this.#panel.send("teach_hold_tries", {}, { quiet: true });
    const seeds = Array.from({ length: wanted.starts }, (_, index) => index);
    for (const value of values) {
      if (!(await this.#panel.send("teach_set_value", { value }, { quiet: true })).ok) break;
      try {
        const row = meansOf(await code.driveFrom(seeds));
        if (!(await this.#panel.send("teach_note_value", { value, ...row }, { quiet: true })).ok) break;
      } catch (error) {
        if (error.message !== STOPPED) this.#panel.notice(error.message, "error");
        break;
      }
    }
    // else it is over already
    if (this.#isUnderWay) await this.#panel.send("teach_stop_trying", {}, { quiet: true });
    await held;
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
 * Return the numbers of episodes from several starts.
 * @param {import("../code/test.js").Start[]} rows
 */
function meansOf(rows) {
  const mean = (/** @type {"reward" | "seconds" | "decisions"} */ name) => rows.reduce((sum, row) => sum + row[name], 0) / rows.length;
  const successes = rows.filter(({ outcome }) => outcome === "goal").length;
  return { successes, reward: mean("reward"), seconds: mean("seconds"), decisions: mean("decisions") };
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
  const now = value === null ? t("It has no value now.") : t("It is {value} now.", { value: Number(value.toPrecision(6)) });
  return limits ? [now, t("It can be {limits}.", { limits })].join(" ") : now;
}

/** @param {TriesState} tries */
function sentenceOf({ is_over: isOver, problem, waiting, done, total }) {
  if (waiting) return waiting;
  if (!isOver) return t("{done} of {total} episodes.", { done, total });
  if (problem === "stopped") return t("It was stopped after {done} of {total} episodes.", { done, total });
  return problem ? t("It could not go on: {problem}.", { problem }) : t("{total} episodes, the same starts with each value.", { total });
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
  setText(goal, successes === null ? "–" : t("{successes} of {episodes}", { successes, episodes }));
  setText(between, low === null || high === null ? "–" : t("{low} and {high}", { low: percent(low), high: percent(high) }));
  setText(paid, number(reward));
  setText(duration, seconds(time));
}
