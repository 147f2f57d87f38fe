/** Five steps from one block to a program that follows walls: each is done when the robot does it. */

/** @import { PythonPart } from "../generated/messages.js" */
/** @import { Panel } from "../panel/panel.js" */
/** @import { Check, Starts } from "./checks.js" */

import { roomOfPage } from "../shared/room.js";
import { CHECKS, seen } from "./checks.js";
import { button, element, setAttributes, setText } from "../shared/dom.js";
import { section } from "../panel/widgets/parts.js";
import { recall, remember } from "../shared/storage.js";

const SCENE = "maze";
/** The steps: {title, texts, goal}; what stands in stars is a block or a button. */
const STEPS = [
  {
    title: "Drive",
    texts: ["Open *Actions*, take *forward* and snap it under *at each decision*.", "Then press *Run*."],
    goal: "Done when the robot has reached a wall. Is it at a wall already? *New start* puts it elsewhere.",
  },
  {
    title: "Stop in time",
    texts: [
      "The robot sees how far a wall is. It should drive only while there is room.",
      "From *Control*, take *if*, and put *forward* 0.5 into it. From *Numbers*, take *<* for its condition, and choose *>* in it.",
      "Left of it goes *distance ahead* from *Senses*, right of it 0.8: if the distance ahead > 0.8, forward.",
    ],
    goal: "Done when the robot drives, and then stands still in front of a wall.",
  },
  {
    title: "Turn away",
    texts: [
      "Now it should keep going. *if … else* does one thing or the other.",
      "If the *distance ahead* < 0.8, *turn* 0.5. Else, *forward* 0.5.",
    ],
    goal: "Done when the robot has turned away from three walls in one run.",
  },
  {
    title: "Follow a wall",
    texts: [
      "Keep one hand on the wall, and you find the way out of many mazes. Your robot uses its right hand.",
      "At a wall ahead (< 0.9) it turns to the left: *turn* -0.8.",
      "Else it goes *forward* 0.5, and below that stands another *turn*: by the *distance to the right* − 0.8. " +
        "Too far from the wall, that is above 0, and the robot turns to the right; too near, it is below 0.",
    ],
    goal: "Done when the robot has driven beside a wall for 300 decisions.",
  },
  {
    title: "Find the exit",
    texts: [
      "To your robot, the exit is a wall like any other. So put one more *if … else* around all that you have:",
      "If it *sees target*, go *forward* 0.6, and *turn* by the *direction of target* ÷ 40. Else, do as before.",
      "Press *Test*: it tries ten starts that nobody has seen.",
    ],
    goal: "Done when at least 8 of 10 starts reach the exit.",
  },
];

export class BlockSteps {
  #panel;
  /** @type {PythonPart | null} */
  #part = null;
  /** Number of steps that are done; the next one is checked. */
  #done = 0;
  /** Number of the step that is shown, from 0. */
  #shown = 0;
  /** @type {Check | null} */
  #check = null;
  #list = element("ol", { className: "ai4u-steps" });
  #text = element("div", { className: "ai4u-steps-text" });
  #progress = element("p", { className: "ai4u-steps-progress" });
  #status = element("p", { role: "status", className: "ai4u-steps-status" });
  #elsewhere = element("p", { textContent: "These steps are for the scene “Maze”." });
  #open = button("Open the maze", () => this.#panel.send("open_scene", { name: SCENE, is_saved: false }), {});
  element;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#done = Math.min(recall(this.#key, 0), STEPS.length);
    this.#shown = Math.min(this.#done, STEPS.length - 1);
    const elsewhere = element("div", { className: "ai4u-steps-elsewhere" }, this.#elsewhere, this.#open);
    this.element = section("blocks-steps", "Five steps", {}, elsewhere, this.#list, this.#text, this.#progress, this.#status);
    this.#list.append(...STEPS.map((step, index) => this.#item(step, index)));
    panel.addEventListener("part:scene", () => this.#draw());
    this.begin();
  }

  /** @param {PythonPart} part of the agent whose program is shown */
  setAgent(part) {
    this.#part = part;
  }

  /** Begin to check, with a run or a test. */
  begin() {
    this.#check = CHECKS[this.#done]?.() ?? null;
    setText(this.#status, "");
    this.#draw();
  }

  /**
   * Look at a decision of a run.
   * @param {Parameters<typeof seen>[1]} detail
   */
  note(detail) {
    if (this.#check === null || this.#part === null || !this.#isHere) return;
    const decision = seen(this.#part, detail);
    if (decision === null) return;
    this.#check.see(decision);
    this.#judge();
  }

  /**
   * Look at the starts of a test.
   * @param {Starts} rows
   */
  tested(rows) {
    if (this.#check === null || !this.#isHere) return;
    this.#check.test(rows);
    this.#judge();
  }

  get #isHere() {
    return this.#panel.part("scene")?.scene === SCENE;
  }

  /** Storage key of the number of finished steps: students of a class may use one device in turn. */
  get #key() {
    const room = roomOfPage();
    return `${room && `${room}/`}blocks-steps`;
  }

  #judge() {
    if (!this.#check.isDone) return this.#drawProgress();
    const { title } = STEPS[this.#done];
    const isLast = this.#done === STEPS.length - 1;
    this.#done += 1;
    remember(this.#key, this.#done);
    this.#check = null; // the next step begins with the next run
    this.#shown = Math.min(this.#done, STEPS.length - 1);
    this.#draw();
    setText(this.#status, isLast ? "All five steps are done. Well done!" : `“${title}” is done. On to the next step.`);
  }

  /**
   * @param {{title: string}} step
   * @param {number} index
   */
  #item({ title }, index) {
    const choose = element("button", { type: "button", title });
    choose.addEventListener("click", () => {
      this.#shown = index;
      this.#draw();
    });
    return element("li", {}, choose);
  }

  #draw() {
    const canEdit = this.#panel.part("scene")?.can_edit ?? false;
    this.#elsewhere.parentElement.hidden = this.#isHere;
    this.#open.hidden = !canEdit;
    this.#list.hidden = this.#text.hidden = !this.#isHere;
    [...this.#list.children].forEach((item, index) => {
      const isDone = index < this.#done;
      const [choose] = item.children;
      setText(choose, isDone ? "✓" : String(index + 1));
      const label = `Step ${index + 1}: ${STEPS[index].title}${isDone ? " (done)" : ""}`;
      setAttributes(choose, { "data-done": isDone ? "true" : "false", "aria-label": label });
      setAttributes(choose, { "aria-current": index === this.#shown ? "step" : null });
    });
    const { title, texts, goal } = STEPS[this.#shown];
    const lines = [...texts, goal].map((text) => element("p", {}, ...withBlocks(text)));
    this.#text.replaceChildren(element("h4", { textContent: `${this.#shown + 1}. ${title}` }), ...lines);
    this.#drawProgress();
  }

  #drawProgress() {
    setText(this.#progress, this.#shown === this.#done ? (this.#check?.words ?? "") : "");
  }
}

/**
 * Return a text as nodes: what stands in stars is bold.
 * @param {string} text
 */
function withBlocks(text) {
  return text.split("*").map((part, index) => (index % 2 ? element("b", { textContent: part }) : part));
}
