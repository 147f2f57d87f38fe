/** The tab "Teach": a network learns from a person's drives, and then it drives. */

/**
 * @import { TeachPart } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { button, element, setText } from "../shared/dom.js";
import { t, tn } from "../shared/text.js";
import { section } from "../panel/widgets/parts.js";
import { Drives } from "../teach/drives.js";
import { LearningView } from "../teach/learning.js";
import { Networks } from "../teach/networks.js";
import { PracticeView } from "../teach/practice.js";
import { TriesView } from "../teach/tries.js";

const FIRST = t("Drive to the goal a few times, from other starts each time. Every drive that ends is kept here, and the robot can learn from it.");

export class Tab {
  #panel;
  #problem = element("p", { className: "ai4u-problem", role: "status" });
  #first = element("p", { className: "ai4u-hint-text", textContent: FIRST });
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
    const content = [this.#first, this.#warning, this.#drives.element, tools, this.#learning.element];
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
    this.#stop.hidden = !isLearning;
    this.#learning.update(learning);
    this.#sections.practice.hidden = practice === null && (Boolean(problem) || rewards.length === 0);
    this.#practice.update(part, isLearning);
    this.#sections.networks.hidden = Boolean(problem) && networks.length === 0;
    this.#networks.update(part);
  }

  async #begin() {
    await this.#panel.send("teach_learn", { drives: this.#drives.chosen }, { quiet: true });
  }
}
