/** Two drivers on the chosen episode: where they first disagree, by how much, and because of what. */

/**
 * @import { DriverComparison, Rival } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, setAttributes, setText } from "../../shared/dom.js";
import { freeId } from "../../shared/ids.js";
import { t, tn } from "../../shared/text.js";
import { Bars, changedRow, hasEffect } from "../widgets/bars.js";
import { Curve } from "../widgets/curve.js";
import { choice, section } from "../widgets/parts.js";

export class Comparison {
  #panel;
  /**
   * Number of the chosen episode; null if there is none.
   * @type {number | null}
   */
  #number = null;
  #asked = 0;
  /** @type {Rival[]} */
  #rivals = [];
  /**
   * Step at which they first disagree.
   * @type {number | null}
   */
  #step = null;
  /**
   * Values of the chosen ones; null before any is known.
   * @type {Record<"first" | "second", string | null>}
   */
  #names = { first: null, second: null };
  #choices = {
    first: choice(t("First"), (name) => this.#choose("first", name)),
    second: choice(t("Second"), (name) => this.#choose("second", name)),
  };
  #checkpoint = element("input", { type: "range", id: freeId(), min: 0, step: 1 });
  #learned = element("output");
  #checkpoints = element(
    "div",
    { className: "ai4u-field", hidden: true },
    element("label", { htmlFor: this.#checkpoint.id, textContent: t("The second one, after learning from") }),
    element("div", { className: "ai4u-what-if-row" }, this.#checkpoint, this.#learned),
  );
  #start = button(t("Compare"), () => this.#compare(), { kind: "main" });
  #none = element("p", {
    className: "ai4u-hint-text",
    hidden: true,
    textContent: t("There is no network to compare with yet. Train one, or open a scene from the library."),
  });
  #says = element("p", { role: "status" });
  #distance = new Curve(t("Difference of the two actions over the steps"));
  #jump = button(t("Show step"), () => this.#goTo(), { icon: "forward" });
  #reasons = element("dl", { className: "ai4u-compare-reasons" });
  #action = new Bars();
  #result = element("div", { className: "ai4u-maps", hidden: true }, this.#says, this.#distance.element, this.#jump, this.#reasons, this.#action.element);
  #body = element("div", { className: "ai4u-maps" }, this.#choices.first.element, this.#choices.second.element, this.#checkpoints, this.#none, this.#start, this.#result);
  element;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.element = section("compare", t("Compare two drivers"), { isOpen: false }, this.#body);
    this.element.hidden = true;
    this.element.addEventListener("toggle", () => this.#list());
    this.#checkpoint.addEventListener("input", () => this.#slide());
    this.#checkpoint.addEventListener("change", () => this.#compare());
    panel.addEventListener("agent", () => this.#list());
  }

  /** @param {number | null} number of the chosen episode; null if there is none */
  update(number) {
    const isOther = number !== this.#number;
    this.#number = number;
    // who may not choose a driver may not ask one either
    this.element.hidden = number === null || this.#panel.part("scene")?.can_edit === false;
    if (!isOther) return;
    this.#forget();
    this.#list();
  }

  async #list() {
    if (!this.element.open || this.element.hidden) return;
    const answer = await this.#panel.send("rivals", {}, { quiet: true });
    if (!answer.ok) return;
    this.#rivals = answer.rivals;
    const isKnown = (/** @type {string | null} */ name) => this.#rivals.some(({ value }) => value === name);
    // what was done comes first, and the best guess at who knows better last
    if (!isKnown(this.#names.first)) this.#names.first = this.#rivals[0]?.value ?? null;
    if (!isKnown(this.#names.second)) this.#names.second = this.#rivals.slice(1).at(-1)?.value ?? null;
    this.#draw();
  }

  #draw() {
    const options = this.#rivals.map(({ value, text }) => ({ value, text }));
    this.#choices.first.set(options, this.#names.first);
    this.#choices.second.set(options, this.#names.second ?? "");
    this.#start.disabled = this.#names.second === null;
    this.#none.hidden = this.#names.second !== null;
    const checkpoints = this.#checkpointsInOrder();
    this.#checkpoints.hidden = checkpoints.length < 2;
    setAttributes(this.#checkpoint, { max: Math.max(checkpoints.length - 1, 1) });
    const place = checkpoints.findIndex(({ value }) => value === this.#names.second);
    if (place >= 0) this.#checkpoint.value = String(place);
    const words = place >= 0 ? tn("{n} decision", "{n} decisions", checkpoints[place].steps) : "–";
    setText(this.#learned, words);
    setAttributes(this.#checkpoint, { "aria-valuetext": words });
  }

  #checkpointsInOrder() {
    return this.#rivals.filter(({ steps }) => steps !== null).sort((a, b) => a.steps - b.steps);
  }

  #slide() {
    this.#names.second = this.#checkpointsInOrder()[Number(this.#checkpoint.value)].value;
    this.#forget();
    this.#draw();
  }

  /**
   * @param {"first" | "second"} which
   * @param {string} name
   */
  #choose(which, name) {
    this.#names[which] = name;
    this.#forget();
    this.#draw();
  }

  #forget() {
    this.#asked += 1;
    this.#result.hidden = true;
    setAttributes(this.#start, { "aria-busy": null });
  }

  async #compare() {
    this.#forget();
    const asked = this.#asked;
    setAttributes(this.#start, { "aria-busy": "true" });
    const answer = await this.#panel.send("compare", this.#names, { quiet: true });
    if (asked !== this.#asked) return;
    setAttributes(this.#start, { "aria-busy": null });
    if (answer.ok) this.#show(/** @type {DriverComparison} */ (answer));
  }

  /** @param {DriverComparison} comparison */
  #show({ step, count, distance, largest, action, first, second }) {
    this.#step = step;
    this.#result.hidden = false;
    const differs = step !== null;
    const agreeing = { count, largest: largest.toFixed(2) };
    setText(
      this.#says,
      differs
        ? t("They first disagree at step {step} of {count}.", { step: step + 1, count })
        : t("They agree in all {count} steps; the largest difference is {largest}.", agreeing),
    );
    this.#distance.update(distance);
    this.#jump.hidden = this.#reasons.hidden = this.#action.element.hidden = !differs;
    if (!differs) return;
    setText(this.#jump.querySelector("span"), t("Show step {step}", { step: step + 1 }));
    this.#reasons.replaceChildren(
      ...[[t("First"), first], [t("Second"), second]].filter(([, text]) => text).flatMap(([name, text]) => [
        element("dt", { textContent: name }),
        element("dd", { textContent: text }),
      ]),
    );
    this.#action.update(action.filter(hasEffect).map(changedRow));
  }

  #goTo() {
    this.#panel.send("step", { step: this.#step }, { quiet: true });
  }
}
