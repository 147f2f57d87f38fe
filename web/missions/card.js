/** The card of a mission: one sentence at a time, how far it is, and always a way on. */

/**
 * @import { MissionPart } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { syncMissions, tellPlace } from "../classroom/student/missions.js";
import { unsavedSentence, request } from "../scenes/api.js";
import { ask, tell } from "../shared/dialog.js";
import { button, element, keyed, setAttributes, setText, withBold } from "../shared/dom.js";
import { freeId } from "../shared/ids.js";
import { t } from "../shared/text.js";
import { ExerciseForm } from "./exercise.js";
import { Lights } from "./lights.js";
import { missions, openMission, progressOf, reach, setOpenMission, storedKey, takeAssigned } from "./progress.js";

const MAP = "./start#missions";
const ROOT = document.documentElement;

export class MissionCard {
  #panel;
  /** @type {MissionPart | null} */
  #part = null;
  /** Key of the step whose sentence is shown. */
  #shown = "";
  #isConnected = false;
  /** Name of a mission whose scene is opened, too, as soon as the room knows the mission. */
  #wanted = "";
  /** The latest news of this page that the room was sent. */
  #told = "";
  /** The latest hint of the present step, which goes away in the card, but not for the teacher. */
  #hint = { step: "", text: "" };
  #lights;
  #exercise;
  #title = element("h2");
  #count = element("span", { className: "ai4u-soft" });
  #dots = element("ol", { className: "ai4u-mission-dots", ariaHidden: "true" });
  #say = element("p", { className: "ai4u-mission-say", ariaLive: "polite" });
  #words = element("p", { className: "ai4u-soft" });
  #done = element("p", { className: "ai4u-mission-done" });
  #problem = element("p", { className: "ai4u-mission-problem" });
  #news = element("div", { role: "status" }, this.#done, this.#problem);
  #stars = element("ul", { className: "ai4u-mission-stars" });
  #question = element("div", { className: "ai4u-mission-question" });
  #elsewhere = button(t("Open"), () => this.#openScene(), { kind: "main" });
  #before = button("", () => this.#go(this.#part.step - 1), { icon: "back", label: t("Step before"), kind: "quiet" });
  #next = button(t("Next"), () => this.#goOn(), {});
  #again = button(t("From the start"), () => this.#go(0), {});
  #map = element("a", { className: "ai4u-plain", href: MAP, textContent: t("Map") });
  #everything = button(t("Show everything"), () => this.#hide(true), { kind: "quiet", title: t("Put this card and its lights away") });
  #buttons = element("div", { className: "ai4u-mission-buttons" }, this.#before, this.#elsewhere, this.#next, this.#again, this.#map, this.#everything);
  #card;
  #pillText = element("span");
  #pill = button("", () => this.#hide(false), { kind: "quiet", title: t("Show the mission again") });
  #row = element("div", { className: "ai4u-mission-row" }, this.#pill, button("", () => this.#leave(), { icon: "remove", label: t("Leave the mission"), kind: "quiet" }));
  #invitation = element("a", { className: "ai4u-mission-invitation", href: MAP, textContent: t("Missions: learn step by step") });
  element = element("section", { className: "ai4u-mission", ariaLabel: t("Mission"), hidden: true });

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#exercise = new ExerciseForm(panel);
    const head = element("header", {}, this.#title, this.#count);
    this.#card = element("div", { className: "ai4u-mission-card" }, head, this.#dots, this.#say, this.#question, this.#exercise.element, this.#words, this.#news, this.#stars, this.#buttons);
    this.#pill.append(this.#pillText);
    this.element.append(this.#card, this.#row, this.#invitation);
    this.#lights = new Lights(this.element);
    new ResizeObserver(() => this.#reserveHeight()).observe(this.element);
    panel.addEventListener("part:mission", ({ detail }) => this.#receive(detail));
    panel.addEventListener("connected", () => this.#begin());
    panel.addEventListener("disconnected", () => (this.#isConnected = false));
    addEventListener("storage", ({ key }) => key === storedKey() && this.#follow());
    syncMissions();
    missions.addEventListener("assigned", () => this.#isConnected && this.#openAssigned());
    for (const type of ["tab", "way", "driver", "agent"]) panel.addEventListener(type, () => this.#tell());
  }

  #reserveHeight() {
    ROOT.style.setProperty("--ai4u-mission-height", `${this.element.offsetHeight}px`);
    this.#lights.keepInView();
  }

  /** Tell the room which mission this page has; it forgets that when it is started again. */
  async #begin() {
    this.#isConnected = true;
    if (this.#openAssigned()) return;
    const open = openMission();
    if (open === null) return;
    this.#told = "";
    const answer = await this.#panel.send("mission_open", { mission: open.mission, step: open.step }, { quiet: true });
    if (answer.ok) this.#tell();
    else setOpenMission(null); // a teacher has removed its file
  }

  /** Tell the room what the person sees and does in this page. */
  #tell() {
    if (!this.#isConnected || openMission() === null) return;
    const { layout, tab, programWay } = this.#panel;
    const news = { tab: layout.isFolded ? "" : (tab ?? ""), way: programWay, is_watching: this.#isWatching };
    const text = JSON.stringify([news, this.#panel.shown.agent]);
    if (text === this.#told) return;
    this.#told = text;
    this.#panel.send("mission_see", news, { quiet: true });
  }

  /** True while another page, or its program, drives the robot: then it does not count here. */
  get #isWatching() {
    const { driver, hasProgram } = this.#panel;
    if (!driver || driver.control.pages < 2 || hasProgram) return false;
    const { hello, control } = driver;
    const isOthers = control.driver !== null && control.driver !== hello.you;
    return isOthers || (hello.others !== "" && !hello.is_network);
  }

  /** @param {MissionPart} part */
  #receive(part) {
    this.#part = part.mission && openMission() ? part : null;
    if (this.#part && part.is_done) {
      const stars = part.stars.filter(({ is_earned: isEarned }) => isEarned).length;
      reach(part.mission, { steps: part.step + 1, stars });
    }
    if (this.#part) {
      const step = `${part.mission} ${part.step}`;
      if (part.hint || step !== this.#hint.step) this.#hint = { step, text: part.hint };
      tellPlace({ mission: part.mission, step: part.step, is_done: part.is_done, hint: this.#hint.text, hints: part.hints });
    }
    this.#draw();
    this.#tell();
    if (this.#wanted !== part.mission) return;
    this.#wanted = "";
    if (this.#part && !part.is_here) this.#openScene();
  }

  #draw() {
    const part = this.#part;
    const isHidden = openMission()?.isHidden ?? false;
    this.element.hidden = part === null && window.parent !== window; // a notebook's world has no start page
    this.#card.hidden = part === null || isHidden;
    this.#row.hidden = part === null || !isHidden;
    this.#invitation.hidden = part !== null;
    setAttributes(ROOT, { "data-ai4u-mission": part === null ? "none" : isHidden ? "hidden" : "open" });
    if (part === null) {
      this.#lights.show([]);
      this.#exercise.show(null);
      return;
    }
    const place = { step: part.step + 1, steps: part.steps };
    setText(this.#pillText, t("Mission: {title} ({step} of {steps})", { title: part.title, ...place }));
    setText(this.#title, part.title);
    setText(this.#count, t("Step {step} of {steps}", place));
    const steps = Array.from({ length: part.steps }, (_, index) => index);
    keyed(this.#dots, steps, (step) => step, () => element("li"), (dot, step) => {
      setAttributes(dot, { "data-done": step < part.step || (step === part.step && part.is_done), "data-now": step === part.step });
    });
    this.#drawStep(part);
    const isLast = part.step === part.steps - 1;
    const isOver = isLast && part.is_done;
    this.#drawStars(part, isOver);
    setText(this.#next.querySelector("span"), isLast && part.next ? t("Next: {title}", { title: part.next_title }) : t("Next"));
    setAttributes(this.#next, { "data-kind": part.is_done && part.is_here ? "main" : null, title: part.is_done ? "" : t("Leave this step out") });
    this.#before.hidden = part.step === 0 || isOver;
    this.#again.hidden = !isOver;
    this.#everything.hidden = isOver;
  }

  /** @param {MissionPart} part */
  #drawStep(part) {
    const { mission, step, say, light, is_done: isDone, is_here: isHere } = part;
    const key = `${mission} ${step} ${say}`;
    const isNew = key !== this.#shown;
    if (isNew) {
      this.#shown = key;
      this.#say.replaceChildren(...withBold(say));
      this.#askQuestion(part);
    }
    this.#elsewhere.hidden = isHere;
    setText(this.#elsewhere.querySelector("span"), t("Open {title}", { title: part.scene_title }));
    this.#exercise.show(isHere && !openMission()?.isHidden ? part.exercise : null);
    this.#question.hidden = part.question === null || isDone || !isHere;
    const elsewhere = isHere ? "" : t("This mission is in the scene “{title}”. What you have here is kept.", { title: part.scene_title });
    const driver = this.#isWatching ? t("Somebody else drives now, or another window of yours. This step goes on when you drive here.") : part.driver;
    setBold(this.#done, isDone ? `✓ ${part.done}` : "");
    setBold(this.#problem, isDone ? "" : elsewhere || driver || part.hint);
    setText(this.#words, isDone || !isHere || part.exercise !== null ? "" : part.words);
    for (const line of [this.#done, this.#problem, this.#words]) line.hidden = !line.textContent;
    const isLit = !isDone && isHere && !openMission()?.isHidden;
    this.#lights.show(isLit ? light : []);
    if (isNew && isLit && light.some((name) => name !== "Keys")) this.#panel.layout.fold(false);
  }

  /**
   * @param {MissionPart} part
   * @param {boolean} isOver
   */
  #drawStars({ stars }, isOver) {
    this.#stars.hidden = !isOver;
    keyed(this.#stars, stars.map((star, index) => ({ ...star, index })), ({ index }) => index, () => element("li", {}, element("i", { role: "img" }), element("span")), (item, star) => {
      const isEarned = star.is_earned;
      setText(item.firstChild, isEarned ? "★" : "☆");
      setAttributes(item.firstElementChild, { "aria-label": isEarned ? t("earned") : t("not yet"), "data-earned": isEarned });
      setBold(/** @type {HTMLElement} */ (item.lastChild), star.text);
    });
  }

  /** @param {MissionPart} part */
  #askQuestion({ question }) {
    this.#question.replaceChildren();
    if (question === null) return;
    const send = (/** @type {string} */ answer) => this.#panel.send("mission_answer", { answer }, { quiet: true });
    if (question.options.length) {
      const options = question.options.map((option) => button(option, () => send(option)));
      this.#question.append(element("p", { textContent: question.text }), ...options);
      return;
    }
    const input = element("input", { type: "text", inputMode: "decimal", autocomplete: "off", id: freeId() });
    const label = element("label", { htmlFor: input.id, textContent: question.text });
    this.#question.append(label, input, button(t("Check"), () => send(input.value), {}));
    input.addEventListener("keydown", ({ key, isComposing }) => key === "Enter" && !isComposing && send(input.value));
  }

  /** Go on: to the next step, or to the next mission, or to the map. */
  #goOn() {
    const { step, steps, next } = this.#part;
    if (step < steps - 1) this.#go(step + 1);
    else if (next) this.#open(next);
    else location.assign(MAP);
  }

  /** @param {number} step of the same mission */
  async #go(step) {
    const { mission } = this.#part;
    setOpenMission({ mission, step });
    await this.#panel.send("mission_open", { mission, step }, { quiet: true });
    this.#panel.focusWorld();
  }

  /**
   * Open another mission in its scene.
   * @param {string} mission
   */
  async #open(mission) {
    setOpenMission({ mission, step: 0 });
    this.#told = "";
    this.#wanted = mission;
    await this.#panel.send("mission_open", { mission, step: 0 }, { quiet: true });
    this.#tell();
    this.#panel.focusWorld();
  }

  /** Open the mission that the teacher has given, if there is one; its scene comes from the class. Returns true if there is. */
  #openAssigned() {
    const mission = takeAssigned();
    if (!mission) return false;
    setOpenMission({ mission, step: progressOf(mission).steps });
    this.#told = "";
    this.#panel.send("mission_open", { mission, step: progressOf(mission).steps }, { quiet: true }).then(() => this.#tell());
    return true;
  }

  async #openScene() {
    try {
      const text = await unsavedSentence();
      if (text && !(await ask({ title: t("Open “{title}”?", { title: this.#part.scene_title }), text, yes: t("Open") }))) return;
      await request("api/scene", { name: this.#part.scene });
    } catch (error) {
      await tell(t("The scene can't be opened"), error.message);
    }
  }

  async #leave() {
    setOpenMission(null);
    tellPlace({ mission: "" });
    const closing = this.#close();
    this.#invitation.focus();
    await closing;
  }

  #close() {
    this.#part = null;
    this.#draw();
    return this.#panel.send("mission_close", {}, { quiet: true });
  }

  /** Go where another window of this browser has gone: both are the same person's. */
  async #follow() {
    const open = openMission();
    if (!this.#isConnected) return;
    if (open === null) {
      if (this.#part) this.#close();
      return;
    }
    const { mission, step } = open;
    if (mission === this.#part?.mission && step === this.#part.step) {
      this.#draw();
      return;
    }
    this.#told = "";
    await this.#panel.send("mission_open", { mission, step }, { quiet: true });
    this.#tell();
  }

  /** @param {boolean} isHidden */
  #hide(isHidden) {
    setOpenMission({ mission: this.#part.mission, step: this.#part.step, isHidden });
    if (isHidden) this.#panel.layout.fold(false);
    this.#draw();
    (isHidden ? this.#pill : this.#next).focus();
  }
}

/**
 * Show a text with bold words if it differs: screen readers announce every change.
 * @param {HTMLElement} target
 * @param {string} text
 */
function setBold(target, text) {
  if (target.textContent !== text.replaceAll("*", "")) target.replaceChildren(...withBold(text));
}
