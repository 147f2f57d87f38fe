/** The progress of a learning, and its result. */

/** @import { LearningState } from "../generated/messages.js" */
import { element, keyed, setText } from "../shared/dom.js";
import { percent } from "../shared/numbers.js";
import { t, tn } from "../shared/text.js";
import { Curve } from "../panel/widgets/curve.js";

/** Share by which a network should act more like its driver than one that always does the same. */
const LITTLE_BETTER = 0.1;

export class LearningView {
  #curve = new Curve(t("The error, which falls while it learns"));
  #result = element("p", { role: "status" });
  #remarks = element("ul", { className: "ai4u-teach-remarks" });
  element = element("div", { className: "ai4u-teach-learning" }, this.#curve.element, this.#result, this.#remarks);

  /** @param {LearningState | null} learning */
  update(learning) {
    this.element.hidden = learning === null;
    if (learning === null) return;
    this.#curve.update(learning.errors);
    setText(this.#result, sentenceOf(learning));
    this.#result.toggleAttribute("data-problem", Boolean(learning.problem));
    keyed(
      this.#remarks,
      learning.remarks,
      (remark) => remark,
      (textContent) => element("li", { textContent }),
    );
    this.#remarks.hidden = learning.remarks.length === 0;
  }
}

/** @param {LearningState} learning */
function sentenceOf({ is_over: isOver, problem, waiting, drives, alike, commonest }) {
  if (problem === "stopped") return t("The learning was stopped.");
  if (problem) return t("It could not learn: {problem}.", { problem });
  if (waiting) return waiting;
  if (!isOver) return tn("It learns from {n} drive…", "It learns from {n} drives…", drives);
  const result = t("It acts like you in {alike} of moments that it had not seen, and drives now. Always doing the same would be alike in {commonest}.", {
    alike: percent(alike),
    commonest: percent(commonest),
  });
  if (alike - commonest >= LITTLE_BETTER) return result;
  return [result, t("Show it more: drive again from other starts, and learn from all of these drives.")].join(" ");
}
