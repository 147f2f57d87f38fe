/** The goals of a scene of the library, and the stars that the person's program earns with a run or a test. */

/** @import { StarGoals } from "../generated/messages.js" */
/** @import { Panel } from "../panel/panel.js" */
/** @import { CodeRun, RunEnd } from "./run.js" */
/** @import { CodeTest, Start } from "./test.js" */

import { syncStars } from "../classroom/student/stars.js";
import { averageDecisions, STARTS } from "./test.js";
import { element, setAttributes, setText } from "../shared/dom.js";
import { t } from "../shared/text.js";
import { section } from "../panel/widgets/parts.js";
import { earn, starRow, stars, starsOf } from "../scenes/stars.js";

const NOTICES = [
  t("A star: your program has reached the goal."),
  t("Two stars: your program reaches the goal from {starts} of {starts} new starts.", { starts: STARTS }),
  t("Three stars: from {starts} of {starts} new starts, and in few decisions.", { starts: STARTS }),
];
const CHANGED = t("Stars count only in the original scene, for its first robot.");

export class CodeStars {
  /** The stars in a row, for the head of the tab. */
  row = starRow();
  #list = element("ol", { className: "ai4u-code-stars" });
  #hint = element("p", { className: "ai4u-hint-text", textContent: CHANGED });
  element = section("code-stars", t("Stars"), {}, this.#list, this.#hint);
  #panel;
  /** True if the person has driven in the program's place since the run began. */
  #isHelped = false;

  /**
   * @param {Panel} panel
   * @param {CodeRun} run
   * @param {CodeTest} test
   */
  constructor(panel, run, test) {
    this.#panel = panel;
    panel.addEventListener("driver", () => (this.#isHelped ||= Boolean(panel.driver?.hello?.instead)));
    run.addEventListener("end", ({ detail }) => {
      if (!this.#isHelped) this.#earn(starsOfRun(detail, run.success), run.agent);
      this.#isHelped = false;
    });
    test.addEventListener("end", ({ detail: { reason } }) => {
      this.#earn(starsOfTest(test.rows, reason, this.#goals), test.agent);
      this.#isHelped = false;
    });
    panel.addEventListener("part:scene", () => this.update());
    stars.addEventListener("change", () => this.update());
    this.update();
    syncStars();
  }

  /** The goals of the scene; null where there are none. */
  get #goals() {
    return this.#panel.part("scene")?.stars ?? null;
  }

  update() {
    const goals = this.#goals;
    this.element.hidden = goals === null;
    if (goals === null) {
      this.row.set(0, 0);
      return;
    }
    const earned = starsOf(this.#panel.part("scene").scene);
    this.row.set(earned, goals.count);
    const words = goalWords(goals);
    while (this.#list.children.length < words.length) this.#list.append(element("li", {}, element("i", { role: "img" }), element("span")));
    while (this.#list.children.length > words.length) this.#list.lastChild.remove();
    words.forEach((text, index) => {
      const { firstElementChild: mark, lastElementChild: span } = this.#list.children[index];
      const isEarned = index < earned;
      setText(mark, isEarned ? "★" : "☆");
      setAttributes(mark, { "aria-label": isEarned ? t("earned") : t("not yet"), "data-earned": isEarned });
      setText(span, text);
    });
  }

  /**
   * @param {number} count
   * @param {string} agent
   */
  #earn(count, agent) {
    const scene = this.#panel.part("scene");
    if (this.#goals === null || agent !== scene.agents[0]?.id) return;
    if (earn(scene.scene, Math.min(count, this.#goals.count))) this.#panel.notice(NOTICES[count - 1]);
  }
}

/**
 * Return the goals of a scene as sentences.
 * @param {StarGoals} goals
 */
export function goalWords({ count, few_decisions: few }) {
  const all = [
    t("Reach the goal once, with Run."),
    t("Press Test: reach the goal from {starts} new starts.", { starts: STARTS }),
    t("... and do it fast: {few} decisions or fewer on average.", { few }),
  ];
  return all.slice(0, count);
}

/**
 * Return the stars that a run earns: 1 if it ended at the goal.
 * @param {Pick<RunEnd, "reason" | "percept">} end
 * @param {string} success
 */
export function starsOfRun({ reason, percept }, success) {
  return reason === "over" && success && percept.terms?.[success] > 0 ? 1 : 0;
}

/**
 * Return the stars that a test earns.
 * @param {Start[]} rows
 * @param {RunEnd["reason"]} reason
 * @param {StarGoals | null} goals
 */
export function starsOfTest(rows, reason, goals) {
  const reached = rows.filter(({ outcome }) => outcome === "goal").length;
  if (reason !== "tested" || reached < STARTS) return reached > 0 ? 1 : 0;
  return goals?.few_decisions && averageDecisions(rows) <= goals.few_decisions ? 3 : 2;
}
