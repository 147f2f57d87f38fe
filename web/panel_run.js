/** The run of the world: goal, time, score, stages, and the buttons to pause and start again. */

import { button, element, keyed, setAttributes, setText } from "./dom.js";
import { fact, freeId, toggle } from "./panel_parts.js";
import { number, seconds } from "./panel_numbers.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8, "max"];

export class RunControls {
  #panel;
  #isPaused = false;
  #goal = element("p", { className: "ai4u-goal-text" });
  #facts = { time: fact("Time"), score: fact("Score"), best: fact("Best") };
  #stages = element("ol", { className: "ai4u-stages", ariaLabel: "Stages" });
  #result = element("p", { className: "ai4u-result", role: "status" });
  #problem = element("p", { className: "ai4u-run-problem", role: "alert" });
  #status = element("p", { className: "ai4u-soft ai4u-details-only" });
  #pause = button("Pause", () => this.#panel.send(this.#isPaused ? "resume" : "pause", {}, { quiet: true }), { kind: "main" });
  #speed = element("select", { id: freeId() });
  #seed = element("input", { type: "text", inputMode: "numeric", id: freeId(), autocomplete: "off" });
  #lock;
  element;

  constructor(panel) {
    this.#panel = panel;
    const quietly = (command) => panel.send(command, {}, { quiet: true });
    const again = button("Try again", () => quietly("try_again"), { title: "Begin an episode with the same start" });
    const fresh = button("New start", () => quietly("new_start"), { title: "Begin an episode with a new start" });
    const facts = element("dl", { className: "ai4u-facts" }, ...Object.values(this.#facts).map((each) => each.element));
    this.element = element(
      "section",
      { className: "ai4u-run", ariaLabel: "Run" },
      this.#goal,
      facts,
      this.#stages,
      this.#result,
      this.#problem,
      element("div", { className: "ai4u-buttons" }, this.#pause, again, fresh),
      this.#details(),
      this.#status,
    );
    panel.addEventListener("part:run", ({ detail }) => this.#draw(detail));
    panel.addEventListener("part:scene", ({ detail }) => this.#drawScene(detail));
  }

  #details() {
    const panel = this.#panel;
    const tick = button("Tick", () => panel.send("tick", {}, { quiet: true }), { title: "Pause, and run one tick of the physics" });
    const decision = button("Decision", () => panel.send("decision", {}, { quiet: true }), { title: "Pause, and run to the agent's next decision" });
    const options = SPEEDS.map((speed) => element("option", { value: speed, textContent: speed === "max" ? "maximum" : `${speed}x` }));
    this.#speed.append(...options);
    this.#speed.addEventListener("change", () => {
      panel.send("speed", { speed: this.#speed.value === "max" ? "max" : Number(this.#speed.value) }, { quiet: true });
    });
    this.#seed.addEventListener("change", () => this.#setSeed());
    this.#lock = toggle("Lock", (on) => panel.send("lock_seed", { on }), { title: "Begin each episode with this seed" });
    const copy = button("", () => this.#copySeed(), { icon: "copy", label: "Copy the seed", kind: "quiet" });
    return element(
      "div",
      { className: "ai4u-run-details ai4u-details-only" },
      tick,
      decision,
      element("div", { className: "ai4u-inline" }, element("label", { htmlFor: this.#speed.id, textContent: "Speed" }), this.#speed),
      element(
        "div",
        { className: "ai4u-inline ai4u-seed" },
        element("label", { htmlFor: this.#seed.id, textContent: "Seed" }),
        this.#seed,
        this.#lock.element,
        copy,
      ),
    );
  }

  #draw(run) {
    this.#isPaused = run.is_paused;
    setText(this.#pause.querySelector("span"), run.is_paused ? "Resume" : "Pause");
    this.#facts.time.set(seconds(run.time_s));
    this.#facts.score.set(number(run.score));
    this.#facts.best.set(number(run.best));
    this.#facts.best.element.hidden = run.best === null || run.best === undefined;
    setText(this.#result, run.result ? (run.result_text ?? run.result) : "");
    setAttributes(this.#result, { "data-result": run.result || null });
    setText(this.#problem, run.error || "");
    const place = `Episode ${run.episode}, decision ${run.decision}`;
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

  #drawScene(scene) {
    setText(this.#goal, scene.goal);
    this.#goal.hidden = !scene.goal;
    if (scene.stages?.length) this.#drawStages(scene.stages);
  }

  /** @param stages [{title, is_done, is_now}] or texts */
  #drawStages(stages) {
    if (!stages) return;
    this.#stages.hidden = stages.length === 0;
    keyed(
      this.#stages,
      stages.map((each, index) => ({ index, ...(typeof each === "string" ? { title: each } : each) })),
      ({ index }) => index,
      () => element("li"),
      (item, { title, is_done: isDone, is_now: isNow }) => {
        setText(item, title);
        setAttributes(item, { "data-done": Boolean(isDone), "aria-current": isNow ? "step" : null });
      },
    );
  }

  async #setSeed() {
    const seed = this.#seed.value.trim();
    if (seed === this.#panel.part("run")?.seed) return;
    if (!/^\d{1,40}$/.test(seed)) {
      this.#panel.notice(`Seed: expected a whole number such as 42, got "${seed.slice(0, 40)}".`, "error");
      return;
    }
    await this.#panel.send("seed", { seed });
  }

  async #copySeed() {
    await copyText(this.#panel, this.#seed.value, "Seed copied.");
  }
}

/** Copy a text, and say so; where the browser forbids it, say what to do. */
export async function copyText(panel, text, done) {
  try {
    await navigator.clipboard.writeText(text);
    panel.notice(done);
  } catch {
    panel.notice("The browser doesn't let this page copy. Select the text and press Ctrl+C.", "error");
  }
}
