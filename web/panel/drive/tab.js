/** The Drive tab: who drives, what the agent senses, what it does and what it gets for it. */

/**
 * @import { ActionNumber, AgentPart, DecisionPhases, NeedLevel, PythonPart, ScenePart, TrainingPart } from "../../generated/messages.js"
 * @import { DriverView } from "../../page/driver_status.js"
 * @import { Panel } from "../panel.js"
 * @import { Bar } from "../widgets/bars.js"
 */
import { TOUCH_SCREEN } from "../../page/keycaps.js";
import { DriverStatus } from "../../page/driver_status.js";
import { hasWon } from "../../page/results.js";
import { button, element, keyed, setText } from "../../shared/dom.js";
import { Bars, hasEffect } from "../widgets/bars.js";
import { Elsewhere } from "../why/elsewhere.js";
import { Maps } from "../why/maps.js";
import { number } from "../../shared/numbers.js";
import { t, tn } from "../../shared/text.js";
import { choice, section } from "../widgets/parts.js";
import { PythonLines } from "./python.js";
import { RewardTable } from "./rewards.js";
import { clippedWords, RobotTable, scriptWarning, scriptWords } from "./robots.js";
import { SensorView } from "./sensor.js";
import { Training } from "./training.js";
import { Why } from "../why/why.js";

export class DriveTab {
  #panel;
  #agents;
  #driver;
  #driverRow = element("div", { className: "ai4u-driver-row" });
  #brain = element("p", { className: "ai4u-soft ai4u-details-only" });
  #script = element("p", { className: "ai4u-soft ai4u-details-only" });
  #scriptWarning = element("p", { className: "ai4u-problem", role: "alert" });
  #robots = new RobotTable();
  #state = element("p", { className: "ai4u-agent-state" });
  #driveThis = button(t("Drive this one"), () => this.#driveShown());
  #needs = new Bars();
  #sensors = element("div", { className: "ai4u-sensors" });
  #legend = element("ul", { className: "ai4u-legend", ariaLabel: t("Colours") });
  #action = new Bars();
  #phases = element("p", { className: "ai4u-soft" });
  #rewards = new RewardTable();
  #training = new Training();
  #python;
  #why;
  #maps;
  #elsewhere;
  /** @type {AgentPart | null} */
  #latest = null;
  #howTo = element("p", { className: "ai4u-hint-text" });
  #later = element("p", {
    className: "ai4u-hint-text ai4u-simple-only",
    textContent: t("After your first win, you see here what the robot senses."),
  });
  #sections;
  #root;

  /**
   * @param {HTMLElement} root
   * @param {Panel} panel
   */
  constructor(root, panel) {
    this.#root = root;
    this.#panel = panel;
    this.#python = new PythonLines(panel);
    this.#maps = new Maps(panel);
    this.#elsewhere = new Elsewhere(panel);
    this.#why = new Why(panel, () => this.#latest && this.#drawSensors(this.#latest));
    this.#agents = choice(t("Robot"), (agent) => panel.show({ agent }));
    this.#agents.element.hidden = true;
    this.#driver = new DriverStatus(this.#driverRow, () => panel.driving.take(), () => panel.driving.letGo());
    // the dock says the same to screen readers
    this.#driverRow.querySelector("[role=status]").removeAttribute("role");
    this.#sections = {
      python: section("python", t("Drive it from Python"), { isOpen: false, detailsOnly: true }, this.#python.element),
      training: section("training", t("Training"), {}, this.#training.element),
      driver: section("driver", t("Who drives"), {}, this.#driverRow, this.#driveThis, this.#state, this.#scriptWarning, this.#brain, this.#script),
      robots: section("robots", t("All robots"), { isOpen: false, detailsOnly: true }, this.#robots.element),
      needs: section("needs", t("Needs"), {}, this.#needs.element),
      sensors: section("sensors", t("Sensors"), {}, this.#sensors, this.#legend),
      why: section("why", t("Why?"), {}, this.#why.element),
      maps: section("maps", t("What if it stood somewhere else?"), {}, this.#maps.element, this.#elsewhere.element),
      rewards: section("rewards", t("Rewards"), { detailsOnly: true }, this.#rewards.element),
      action: section("action", t("Action"), { detailsOnly: true }, this.#phases, this.#action.element),
    };
    const { training, driver, robots, needs, why, maps, sensors, rewards, action, python } = this.#sections;
    root.append(this.#agents.element, this.#howTo, this.#later, training, driver, needs, why, maps, sensors, rewards, action, robots, python);
    panel.addEventListener("part:scene", ({ detail }) => this.#drawScene(detail));
    panel.addEventListener("driver", ({ detail }) => this.#drawDriver(detail));
    panel.addEventListener("agent", () => this.#drawShown());
    panel.addEventListener("win", () => this.#drawShown());
    panel.addEventListener("part:curve", ({ detail }) => this.#rewards.drawCurve(detail.points));
    panel.addEventListener("part:python", ({ detail }) => this.#drawPython(detail));
    panel.addEventListener("part:training", ({ detail }) => this.#drawTraining(detail));
    this.#sections.python.hidden = true;
    this.#sections.training.hidden = true;
    if (panel.part("training")) this.#drawTraining(panel.part("training"));
    if (panel.part("python")) this.#drawPython(panel.part("python"));
    if (panel.part("curve")) this.#rewards.drawCurve(panel.part("curve").points);
    if (panel.part("scene")) this.#drawScene(panel.part("scene"));
    if (panel.driver) this.#drawDriver(panel.driver);
  }

  /** @param {AgentPart} agent */
  update(agent) {
    setText(this.#brain, agent.brain ? t("Brain: {brain}", { brain: agent.brain }) : "");
    const state = [agent.problem, agent.state, agent.clipped ? clippedWords(agent.clipped) : ""];
    setText(this.#state, state.filter(Boolean).join(" · "));
    this.#drawSimple();
    this.#needs.update((agent.needs ?? []).map(needRow));
    this.#sections.needs.hidden = !agent.needs?.length;
    this.#latest = agent;
    this.#drawSensors(agent);
    this.#sections.sensors.hidden = agent.sensors.length === 0;
    this.#action.update((agent.action ?? []).filter(hasEffect).map(actionRow));
    setText(this.#phases, phaseWords(agent.phases));
    this.#rewards.update(agent.rewards ?? [], agent.paid ?? []);
    setText(this.#script, scriptWords(agent.script));
    setText(this.#scriptWarning, scriptWarning(agent.script));
    this.#drawSimple();
    this.#robots.update(agent.others ?? []);
    this.#sections.robots.hidden = !agent.others?.length;
  }

  /** @param {AgentPart} agent */
  #drawSensors(agent) {
    keyed(
      this.#sensors,
      agent.sensors,
      ({ key, class: type }) => `${key} ${type}`,
      (sensor) => new SensorView(this.#panel, sensor).element,
      (made, sensor) => made.view.update(sensor, this.#why.of(agent.id, sensor.key)),
    );
  }

  /** @param {TrainingPart} training */
  #drawTraining(training) {
    this.#sections.training.hidden = false;
    this.#training.update(training);
  }

  /** @param {PythonPart} part */
  #drawPython({ lines }) {
    const { python: part } = this.#sections;
    part.hidden = !lines;
    if (!lines) return;
    this.#python.update(lines);
    // who asked for it has a script in mind: then it is the first thing, in Simple too
    const isFirst = new URLSearchParams(location.search).has("python");
    part.classList.toggle("ai4u-details-only", !isFirst);
    const isAtTop = this.#root.firstElementChild === part;
    if (isFirst && !isAtTop) {
      this.#root.prepend(part);
      part.open = true;
    } else if (!isFirst && isAtTop) this.#root.append(part);
  }

  /** @param {ScenePart} scene */
  #drawScene(scene) {
    const agents = scene.agents.map(({ id, title, driver }) => ({ value: id, text: driver ? `${title} · ${driver}` : title }));
    this.#agents.element.hidden = agents.length < 2;
    this.#agents.set(agents, this.#panel.shown.agent);
    setText(this.#howTo, scene.controls ?? "");
    this.#howTo.hidden = !scene.controls || TOUCH_SCREEN.matches; // it names keys, and there they are buttons with names
    this.#rewards.setHelp(scene.rewards ?? "");
    const isPerson = Boolean(scene.agents.find(({ id }) => id === this.#panel.shown.agent)?.is_person);
    this.#sections.why.hidden = this.#sections.maps.hidden = isPerson; // only who decides by the percept can be asked
    // a beginner drives first; a notebook's text may speak of sensors from the start
    const isNew = isPerson && !hasWon() && window.parent === window;
    this.#sections.sensors.classList.toggle("ai4u-details-only", isNew);
    this.#later.hidden = !isNew;
    keyed(
      this.#legend,
      scene.legend ?? [],
      ({ name }) => name,
      () => element("li", {}, element("i", { ariaHidden: "true" }), element("span")),
      (item, { name, colour }) => {
        item.querySelector("i").style.background = colour;
        setText(item.lastChild, name);
      },
    );
  }

  /** @param {DriverView} status */
  #drawDriver(status) {
    const isDriven = status.hello.agent === this.#panel.shown.agent || !status.hello.agent;
    this.#driverRow.hidden = !isDriven;
    this.#driveThis.hidden = isDriven;
    this.#driver.draw(status);
    this.#drawSimple();
  }

  /** Show a beginner who drives only if there is something to do about it: the dock says it, too. */
  #drawSimple() {
    const hasNews = !this.#driveThis.hidden || [this.#scriptWarning, this.#state].some(({ textContent }) => textContent !== "");
    this.#sections.driver.classList.toggle("ai4u-details-only", !hasNews);
  }

  /** Follow the page to another agent: one that was chosen here or clicked in the picture. */
  #drawShown() {
    if (this.#panel.part("scene")) this.#drawScene(this.#panel.part("scene"));
    if (this.#panel.driver) this.#drawDriver(this.#panel.driver);
  }

  /** Load the page for the shown agent: the keys of one page belong to one agent. */
  #driveShown() {
    const query = new URLSearchParams(location.search);
    query.set("agent", this.#panel.shown.agent);
    query.delete("websocket");
    location.search = String(query);
  }
}

/**
 * @param {NeedLevel} need
 * @returns {Bar}
 */
function needRow({ name, level, low, high, comfort, state }) {
  const percent = Math.round((100 * (level - low)) / (high - low || 1));
  const words = { low: t("{percent} % – too low", { percent }), high: t("{percent} % – too high", { percent }) };
  const text = state ? words[state] : `${percent} %`;
  return { name, value: level, low, high, good: comfort, text };
}

/**
 * @param {ActionNumber} number of the action
 * @returns {Bar}
 */
function actionRow({ actuator, title, name, value, low, high }) {
  return { name: (name || title || actuator).replaceAll("_", " "), value, low, high };
}

/** @param {DecisionPhases} phases */
function phaseWords(phases) {
  if (!phases) return "";
  const { all_ticks: ticks, tick, now, seconds } = phases;
  const length = tn(
    "A decision lasts {n} tick ({seconds} s): sense, decide, act, reward.",
    "A decision lasts {n} ticks ({seconds} s): sense, decide, act, reward.",
    ticks,
    { seconds: number(seconds) },
  );
  const words = {
    sense: t("Now it senses."),
    act: t("Now it acts, tick {tick} of {ticks}.", { tick: tick ?? 0, ticks }),
    reward: t("Now it gets its reward."),
  };
  return now ? `${length} ${words[now]}` : length;
}
