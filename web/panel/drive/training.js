/** The progress of a training whose policy drives: decisions so far, and the learning curve. */

/** @import { TrainingPart } from "../../generated/messages.js" */
import { element, setText } from "../../shared/dom.js";
import { Curve } from "../widgets/curve.js";
import { number } from "../../shared/numbers.js";
import { t } from "../../shared/text.js";

export class Training {
  #text = element("p", { role: "status" });
  #bar = element("progress", { max: 1, ariaLabel: t("Training") });
  #curve = new Curve(t("Mean reward of an episode during the training"));
  #last = element("p", { className: "ai4u-soft" });
  element = element("div", {}, this.#text, this.#bar, this.#curve.element, this.#last);

  /** @param {TrainingPart} training */
  update({ text, is_over: isOver, share, points }) {
    setText(this.#text, text);
    this.#bar.value = share;
    this.#bar.hidden = isOver;
    this.#curve.update(points.map(([, reward]) => reward));
    const [, reward, success] = points.at(-1) ?? [0, null, null];
    const parts = [
      reward === null ? "" : t("Mean reward {reward}", { reward: number(reward) }),
      success === null ? "" : t("reaches the goal in {percent}% of episodes", { percent: Math.round(100 * success) }),
    ];
    setText(this.#last, parts.filter(Boolean).join(", "));
  }
}
