/** The progress of a learning, and its result. */

/** @import { LearningState } from "../generated/messages.js" */
import { element, keyed, setText } from "../shared/dom.js";
import { percent } from "../shared/numbers.js";
import { t, tn } from "../shared/text.js";
import { Curve } from "../panel/widgets/curve.js";

/** Share by which a network should act more like its driver than one that always does the same. */
const LITTLE_BETTER = 0.1;
const NEXT = t("Does it go wrong somewhere? Take over there, and show it how. That drive is listed, too: learn again.");

export class LearningView {
  #curve = new Curve(t("The error, which falls while it learns"), t("Its mistakes while it learns: the lower, the better."));
  #result = element("p", { role: "status" });
  #next = element("p", { className: "ai4u-hint-text", textContent: NEXT });
  #remarks = element("ul", { className: "ai4u-teach-remarks" });
  element = element("div", { className: "ai4u-teach-learning" }, this.#curve.element, this.#result, this.#remarks, this.#next);

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
    this.#next.hidden = !learning.is_over || Boolean(learning.problem);
  }
}

/** @param {LearningState} learning */
function sentenceOf({ is_over: isOver, problem, waiting, drives, alike, commonest }) {
  if (problem === "stopped") return t("The learning was stopped.");
  if (problem) return t("It could not learn: {problem}.", { problem });
  if (waiting) return waiting;
  if (!isOver) return tn("It learns from {n} drive… In a few seconds it drives by itself.", "It learns from {n} drives… In a few seconds it drives by itself.", drives);
  const result = t("It drives now. It acts like you in {alike} of moments that it had not seen. Always doing the same would be alike in {commonest}.", {
    alike: percent(alike),
    commonest: percent(commonest),
  });
  if (alike - commonest >= LITTLE_BETTER) return result;
  return [result, t("Show it more: drive again from other starts, and learn from all of these drives.")].join(" ");
}
