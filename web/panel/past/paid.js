/** Rewards of the chosen episode: each term over time, and the decisions that paid most. */

/**
 * @import { PaidCurve, PaidMoment } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element } from "../../shared/dom.js";
import { t } from "../../shared/text.js";
import { Curve } from "../widgets/curve.js";
import { section } from "../widgets/parts.js";

export class PaidTerms {
  #panel;
  /**
   * Number of the chosen episode; null if there is none.
   * @type {number | null}
   */
  #number = null;
  #asked = 0;
  #terms = element("div");
  #hint = element("p", { className: "ai4u-soft", textContent: t("Each line is the sum so far, from the first decision to the last one.") });
  #moments = element("ol", { className: "ai4u-paid-moments", ariaLabel: t("Decisions that paid most") });
  #none = element("p", { className: "ai4u-hint-text", textContent: t("Nothing was paid in this episode.") });
  element;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    const body = element("div", { className: "ai4u-maps" }, this.#none, this.#terms, this.#hint, this.#moments);
    this.element = section("paid", t("Where the points came from"), { isOpen: false }, body);
    this.element.hidden = true;
    this.element.addEventListener("toggle", () => this.#ask());
  }

  /** @param {number | null} chosen number of the chosen episode; null if there is none */
  update(chosen) {
    const isOther = chosen !== this.#number;
    this.#number = chosen;
    this.element.hidden = chosen === null;
    if (isOther) this.#ask();
  }

  async #ask() {
    const asked = (this.#asked += 1);
    if (!this.element.open || this.#number === null) return;
    const answer = await this.#panel.send("paid", {}, { quiet: true });
    if (answer.ok && asked === this.#asked) this.#show(answer.terms, answer.moments);
  }

  /**
   * @param {PaidCurve[]} terms
   * @param {PaidMoment[]} moments
   */
  #show(terms, moments) {
    this.#none.hidden = terms.length > 0;
    this.#hint.hidden = !terms.length;
    this.#terms.replaceChildren(...terms.map(termElement));
    this.#moments.replaceChildren(...moments.map((moment) => element("li", {}, this.#momentButton(moment))));
  }

  /** @param {PaidMoment} moment */
  #momentButton({ step, terms }) {
    const amounts = terms.map(({ term, amount }) => `${term} ${paid(amount)}`).join(", ");
    return button(t("Step {step}: {amounts}", { step: step + 1, amounts }), () => this.#panel.send("step", { step }, { quiet: true }), { icon: "forward" });
  }
}

/**
 * Return an amount, also a small one, with three digits that matter.
 * @param {number} amount
 */
function paid(amount) {
  return String(Number(amount.toPrecision(3))).replace("-", "−");
}

/** @param {PaidCurve} term */
function termElement({ term, total, curve }) {
  const line = new Curve(t("The sum of {term} during the episode", { term }));
  line.update(curve);
  const head = element("p", {}, element("b", { textContent: term }), ` ${paid(total)}`);
  return element("div", {}, head, line.element);
}
