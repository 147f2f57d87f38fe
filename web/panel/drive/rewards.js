/** The rewards of an agent: each term's last and summed reward, and the curve of the episode. */

/** @import { CurvePart, PaidDecision, RewardRow } from "../../generated/messages.js" */
import { element, keyed, setText, tableHead } from "../../shared/dom.js";
import { Curve } from "../widgets/curve.js";
import { number } from "../../shared/numbers.js";
import { t } from "../../shared/text.js";

export class RewardTable {
  #help = element("p", { className: "ai4u-soft" });
  #rows = element("tbody");
  #total = element("tr", {}, element("th", { scope: "row", textContent: t("Sum") }), element("td"), element("td"));
  #latest = element("ol", { className: "ai4u-soft ai4u-details-only", ariaLabel: t("Latest rewards") });
  #curve = new Curve(t("The score during the episode"));
  element;

  constructor() {
    const head = tableHead(t("Reward"), t("Last decision"), t("Episode"));
    const table = element("table", { className: "ai4u-table" }, head, this.#rows, element("tfoot", {}, this.#total));
    this.#curve.element.classList.add("ai4u-details-only");
    this.element = element("div", {}, this.#help, table, this.#latest, this.#curve.element);
  }

  /** @param {string} text empty for none */
  setHelp(text) {
    setText(this.#help, text);
    this.#help.hidden = !text;
  }

  /**
   * @param {RewardRow[]} terms
   * @param {PaidDecision[]} latest decisions that had a reward, newest first
   */
  update(terms, latest) {
    keyed(this.#rows, terms, ({ term }) => term, makeRow, (row, { term, decision, episode }) => {
      fill(row, term, decision, episode);
    });
    const sum = (/** @type {"decision" | "episode"} */ name) => terms.reduce((total, row) => total + (row[name] ?? 0), 0);
    fill(this.#total, t("Sum"), sum("decision"), sum("episode"));
    this.#total.hidden = terms.length < 2;
    keyed(this.#latest, latest, ({ decision }) => decision, () => element("li"), (item, { decision, terms: its }) => {
      const amounts = its.map(({ term, amount }) => `${term} ${number(amount)}`);
      setText(item, t("Decision {n}: {rewards}", { n: decision, rewards: amounts.join(", ") }));
    });
  }

  /** @param {CurvePart["points"]} points */
  drawCurve(points) {
    this.#curve.update(points.map(([, , sum]) => sum));
  }
}

function makeRow() {
  return element("tr", {}, element("th", { scope: "row" }), element("td"), element("td"));
}

/**
 * @param {HTMLElement} row
 * @param {string} name
 * @param {number} decision amount in the last decision
 * @param {number} episode amount in the episode so far
 */
function fill(row, name, decision, episode) {
  const [head, last, all] = row.children;
  setText(head, name);
  setText(last, number(decision));
  setText(all, number(episode));
}
