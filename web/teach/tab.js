/** The tab "Teach": a network learns from a person's drives, and then it drives. */

/**
 * @import { TeachPart } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { button, element, setText } from "../shared/dom.js";
import { percent } from "../shared/numbers.js";
import { t, tn } from "../shared/text.js";
import { section } from "../panel/widgets/parts.js";
import { Drives } from "../teach/drives.js";
import { LearningView } from "../teach/learning.js";
import { Networks } from "../teach/networks.js";
import { PracticeView } from "../teach/practice.js";
import { TriesView } from "../teach/tries.js";

/** Drives from which a robot learns well in a simple scene. */
const ENOUGH_DRIVES = 5;
/** Share of starts from which a practice is one to celebrate. */
const GOOD_SHARE = 0.8;
const FIRST = t("Drive to the goal a few times, from other starts each time. Every drive that ends is kept here, and the robot can learn from it.");

export class Tab {
  #panel;
  #problem = element("p", { className: "ai4u-problem", role: "status" });
  #first = element("p", { className: "ai4u-hint-text", textContent: FIRST });
  #more = element("p", { className: "ai4u-hint-text" });
  #drives;
  #learning = new LearningView();
  #networks;
  #practice;
  #warning = element("p", { className: "ai4u-problem", role: "status" });
  #learn = button(t("Learn"), () => void this.#begin(), { icon: "network", kind: "main" });
  #stop = button(t("Stop"), () => this.#panel.send("teach_stop"), { icon: "stop" });
  #sections;
  /** @type {TeachPart | null} */
  #part = null;
  /** Work that was under way in the part before. */
  #was = { learning: false, practising: false };

  /**
   * @param {HTMLElement} root
   * @param {Panel} panel
   */
  constructor(root, panel) {
    this.#panel = panel;
    this.#drives = new Drives(panel, () => this.#draw());
    this.#networks = new Networks(panel);
    this.#practice = new PracticeView(panel);
    const tools = element("div", { className: "ai4u-tools" }, this.#learn, this.#stop);
    const content = [this.#first, this.#warning, this.#drives.element, this.#more, tools, this.#learning.element];
    this.#sections = {
      drives: section("teach-drives", t("From your drives"), {}, ...content),
      practice: section("teach-practice", t("By rewards"), {}, this.#practice.element),
      networks: section("teach-networks", t("Your networks"), {}, this.#networks.element),
    };
    const tries = section("teach-tries", t("Try many"), { isOpen: false }, new TriesView(panel).element);
    root.append(this.#problem, this.#sections.drives, this.#sections.practice, this.#sections.networks, tries);
  }

  /** @param {TeachPart} part */
  update(part) {
    this.#part = part;
    this.#draw();
    this.#celebrate(part);
  }

  /** Say over the picture that a network has learned, and drives now. @param {TeachPart} part */
  #celebrate({ learning, practice }) {
    const was = this.#was;
    this.#was = { learning: learning?.is_over === false, practising: practice?.phase === "running" };
    if (was.learning && learning?.is_over && !learning.problem) {
      this.#learning.element.scrollIntoView({ block: "nearest" });
      this.#panel.celebrate(t("It has learned from you, and drives by itself now. Watch!"));
    }
    const share = practice?.success ?? 0;
    if (was.practising && practice?.phase === "over" && !practice.problem && share >= GOOD_SHARE) {
      this.#panel.celebrate(t("It has practised: now it reaches the goal from {share} of its starts. Watch!", { share: percent(share) }));
    }
  }

  #draw() {
    const part = this.#part;
    if (part === null) return;
    const { drives, learning, networks, practice, problem, rewards, warning } = part;
    setText(this.#problem, problem);
    this.#problem.hidden = !problem;
    this.#sections.drives.hidden = Boolean(problem);
    this.#first.hidden = drives.length > 0;
    setText(this.#warning, warning);
    this.#warning.hidden = !warning;
    this.#drives.update(part);
    const isLearning = learning !== null && !learning.is_over;
    const isPractising = practice?.phase === "running";
    const count = this.#drives.chosen.length;
    setText(this.#learn.querySelector("span"), tn("Learn from {n} drive", "Learn from {n} drives", count));
    this.#learn.disabled = isLearning || isPractising || count === 0;
    this.#learn.hidden = drives.length === 0;
    const missing = ENOUGH_DRIVES - count;
    this.#more.hidden = drives.length === 0 || learning !== null || missing <= 0;
    setText(
      this.#more,
      this.#more.hidden ? "" : tn('Press "New start" and drive again: {n} more drive makes it learn well.', 'Press "New start" and drive again: {n} more drives make it learn well.', missing),
    );
    this.#stop.hidden = !isLearning;
    this.#learning.update(learning);
    this.#sections.practice.hidden = practice === null && (Boolean(problem) || rewards.length === 0);
    this.#practice.update(part, isLearning);
    this.#sections.networks.hidden = Boolean(problem) && networks.length === 0;
    this.#networks.update(part);
  }

  async #begin() {
    await this.#panel.send("teach_learn", { drives: this.#drives.chosen }, { quiet: true });
    this.#learning.element.scrollIntoView({ block: "nearest" });
  }
}
