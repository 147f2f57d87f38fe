/** The run of the world: goal, time, score, stages, and the buttons to pause and start again. */

/**
 * @import { RunPart, ScenePart, Stage } from "../generated/messages.js"
 * @import { Panel } from "./panel.js"
 */
import { button, element, keyed, setAttributes, setText } from "../shared/dom.js";
import { freeId } from "../shared/ids.js";
import { fact, toggle } from "./widgets/parts.js";
import { number, seconds } from "../shared/numbers.js";
import { t } from "../shared/text.js";
import { Watch } from "./why/watch.js";

/** Most characters of a goal, as a scene's file takes. */
const MAX_GOAL_CHARS = 2000;
/**
 * Names of best times by the kind of driver.
 * @type {Record<string, string>}
 */
const BEST = { program: t("Best (code)"), network: t("Best (network)") };
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8, "max"];

export class RunControls {
  #panel;
  #isPaused = false;
  #goalText = element("span");
  #goal = element("p", { className: "ai4u-goal-text" }, this.#goalText);
  #facts = { time: fact(t("Time")), score: fact(t("Score")), best: fact(t("Best")) };
  #stages = element("ol", { className: "ai4u-stages", ariaLabel: t("Stages") });
  /** Result for screen readers: the banner over the picture shows it, and a visible line would move the buttons. */
  #result = element("p", { className: "ai4u-hidden-text", role: "status" });
  #problem = element("p", { className: "ai4u-run-problem", role: "alert" });
  #status = element("p", { className: "ai4u-soft ai4u-details-only ai4u-run-status" });
  #change = button("", () => this.#changeGoal(), { icon: "text", label: t("Change the goal"), kind: "quiet" });
  #pause = button(t("Pause"), () => this.#panel.send(this.#isPaused ? "resume" : "pause", {}, { quiet: true }));
  #speed = element("select", { id: freeId() });
  watch;
  #seed = element("input", { type: "text", inputMode: "numeric", id: freeId(), autocomplete: "off" });
  #lock = toggle(t("Lock"), (on) => this.#panel.send("lock_seed", { on }), { title: t("Begin each episode with this seed") });
  element;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.watch = new Watch(panel);
    this.#goal.append(this.#change);
    this.#goalText.addEventListener("click", () => this.#change.hidden || this.#changeGoal());
    this.drawBest(null, "");
    this.#facts.score.element.classList.add("ai4u-details-only");
    const quietly = (/** @type {"try_again" | "new_start"} */ command) => panel.send(command, {}, { quiet: true });
    const again = button(t("Try again"), () => quietly("try_again"), { title: t("Start again from the same place"), kind: "main" });
    const fresh = button(t("New start"), () => quietly("new_start"), { title: t("Start again from another place") });
    const facts = element("dl", { className: "ai4u-facts" }, ...Object.values(this.#facts).map(({ element: made }) => made));
    this.element = element(
      "section",
      { className: "ai4u-run", ariaLabel: t("Run") },
      this.#goal,
      facts,
      element("div", { className: "ai4u-buttons" }, again, fresh, this.#pause),
      this.watch.element,
      this.#stages,
      this.#details(),
      this.#status,
      this.#result,
      this.#problem,
    );
    panel.addEventListener("part:run", ({ detail }) => this.#draw(detail));
    panel.addEventListener("part:scene", ({ detail }) => this.#drawScene(detail));
  }

  #details() {
    const panel = this.#panel;
    const tick = button(t("One tick"), () => panel.send("tick", {}, { quiet: true }), { title: t("Pause, and run one tick of the physics") });
    const decision = button(t("One decision"), () => panel.send("decision", {}, { quiet: true }), { title: t("Pause, and run to the agent's next decision") });
    const options = SPEEDS.map((speed) => element("option", { value: speed, textContent: speed === "max" ? t("maximum") : `${speed}x` }));
    this.#speed.append(...options);
    this.#speed.addEventListener("change", () => {
      panel.send("speed", { speed: this.#speed.value === "max" ? "max" : Number(this.#speed.value) }, { quiet: true });
    });
    this.#seed.addEventListener("change", () => this.#setSeed());
    const copy = button("", () => this.#copySeed(), { icon: "copy", label: t("Copy the seed"), kind: "quiet" });
    return element(
      "div",
      { className: "ai4u-run-details ai4u-details-only" },
      tick,
      decision,
      element("div", { className: "ai4u-inline" }, element("label", { htmlFor: this.#speed.id, textContent: t("Speed") }), this.#speed),
      element(
        "div",
        { className: "ai4u-inline ai4u-seed" },
        element("label", { htmlFor: this.#seed.id, textContent: t("Seed") }),
        this.#seed,
        this.#lock.element,
        copy,
      ),
    );
  }

  /**
   * Show the best time (s) of a kind of driver.
   * @param {number | null} time null for none
   * @param {string} by the kind, as of results.js
   */
  drawBest(time, by) {
    const { best } = this.#facts;
    best.element.hidden = typeof time !== "number";
    if (best.element.hidden) return;
    setText(best.element.firstChild, BEST[by] ?? t("Best"));
    best.set(seconds(time));
  }

  /** @param {RunPart} run */
  #draw(run) {
    this.#isPaused = run.is_paused;
    setText(this.#pause.querySelector("span"), run.is_paused ? t("Resume") : t("Pause"));
    this.#facts.time.set(seconds(run.time_s));
    this.#facts.score.set(number(run.score));
    setText(this.#result, run.result && run.result_text);
    setAttributes(this.#result, { "data-result": run.result || null });
    setText(this.#problem, run.error || "");
    const place = t("Episode {episode}, decision {decision}", { episode: run.episode, decision: run.decision });
    setText(this.#status, [place, run.status, run.slow, run.stall].filter(Boolean).join(" · "));
    this.#drawStages(run.stages);
    const speed = String(run.speed);
    if (![...this.#speed.options].some(({ value }) => value === speed)) {
      this.#speed.append(element("option", { value: speed, textContent: `${speed}x` }));
    }
    if (document.activeElement !== this.#speed) this.#speed.value = speed;
    if (document.activeElement !== this.#seed) this.#seed.value = run.seed;
    this.#lock.set(run.is_seed_locked);
  }

  /** @param {ScenePart} scene */
  #drawScene(scene) {
    setText(this.#goalText, scene.goal);
    this.#change.hidden = !scene.can_edit_goal;
    this.#goal.hidden = !scene.goal && !scene.can_edit_goal;
  }

  /** @param {Stage[]} stages */
  #drawStages(stages) {
    this.#stages.hidden = stages.length === 0;
    keyed(
      this.#stages,
      stages.map((stage, index) => ({ index, ...stage })),
      ({ index }) => index,
      () => element("li"),
      (item, { title, is_done: isDone, is_now: isNow }) => {
        setText(item, title);
        setAttributes(item, { "data-done": Boolean(isDone), "aria-current": isNow ? "step" : null });
      },
    );
  }

  /** Ask the person for another goal, in words. */
  #changeGoal() {
    const text = element("textarea", { rows: 3, maxLength: MAX_GOAL_CHARS, id: freeId(), value: this.#goalText.textContent });
    const problem = element("p", { className: "ai4u-problem", role: "alert" });
    const save = async () => {
      const answer = await this.#panel.send("change_settings", { values: { goal: text.value.trim() } });
      if (answer.ok) return close();
      setText(problem, answer.problems.map((problem) => problem.text).join(" ") || answer.text);
    };
    const label = element("label", { htmlFor: text.id, textContent: t("The task, in a sentence") });
    const { close } = this.#panel.dialog(t("Goal"), label, text, problem, button(t("Save"), save, { kind: "main" }));
    text.focus();
  }

  async #setSeed() {
    const seed = this.#seed.value.trim();
    if (seed === this.#panel.part("run")?.seed) return;
    if (!/^\d{1,40}$/.test(seed)) {
      this.#panel.notice(t("Seed: expected a whole number such as 42, got \"{seed}\".", { seed: seed.slice(0, 40) }), "error");
      return;
    }
    await this.#panel.send("seed", { seed });
  }

  async #copySeed() {
    await copyText(this.#panel, this.#seed.value, t("Seed copied."));
  }
}

/**
 * Copy a text, and say so; where the browser forbids it, say what to do.
 * @param {Panel} panel
 * @param {string} text
 * @param {string} done the sentence to say
 */
export async function copyText(panel, text, done) {
  try {
    await navigator.clipboard.writeText(text);
    panel.notice(done);
  } catch {
    panel.notice(t("The browser doesn't let this page copy. Select the text and press Ctrl+C."), "error");
  }
}
