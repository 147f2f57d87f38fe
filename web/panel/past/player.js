/** The player of an episode: one number for the moment that is shown, and what can be done from there. */

/**
 * @import { Commands, PastPart, PlayedEpisode } from "../../generated/messages.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, setAttributes, setText } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";
import { segments } from "../widgets/parts.js";

const SPEEDS = [0.25, 0.5, 1, 2, 4];

export class Player {
  #panel;
  /** @type {PlayedEpisode | null} */
  #playing = null;
  #isShowing = false;
  #title = element("strong");
  #moment = element("output", { className: "ai4u-moment" });
  #slider = element("input", { type: "range", min: 0, step: 1, ariaLabel: t("Step") });
  #play;
  #back;
  #forward;
  #speeds;
  #live;
  #proceed;
  #race;
  #noGhost;
  #note = element("p", { className: "ai4u-hint-text", role: "status" });
  element;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    /** @type {<Name extends keyof Commands>(command: Name, args?: Commands[Name]) => void} */
    const send = (command, args) => void panel.send(command, args, { quiet: true });
    const goToSlider = () => send("step", { step: Number(this.#slider.value) });
    this.#slider.addEventListener("input", goToSlider);
    // a click where the slider stands already changes nothing, and yet the person wants to see it
    this.#slider.addEventListener("click", () => this.#isShowing || goToSlider());
    this.#back = button("", () => this.#step(-1), { icon: "back", label: t("Step back") });
    this.#play = button(t("Play"), () => send(this.#playing?.is_playing ? "stop" : "play"), { icon: "play", kind: "main" });
    this.#forward = button("", () => this.#step(1), { icon: "forward", label: t("Step forward") });
    this.#speeds = segments(
      t("Speed"),
      SPEEDS.map((speed) => ({ value: String(speed), text: `${speed}x`, title: t("Speed {speed}", { speed }) })),
      (speed) => send("play_speed", { speed: Number(speed) }),
    );
    this.#live = button(t("Back to live"), () => panel.send("back_to_live"), { icon: "live", kind: "main" });
    this.#proceed = button(t("Continue here"), () => panel.send("continue"), { icon: "proceed" });
    this.#race = button(t("Race against it"), () => panel.send("race"), { icon: "race" });
    this.#noGhost = button(t("Remove ghost"), () => panel.send("remove_ghost"), { icon: "remove" });
    this.element = element(
      "div",
      { className: "ai4u-player", role: "group", ariaLabel: t("Player") },
      element("div", { className: "ai4u-player-head" }, this.#title, this.#moment),
      this.#slider,
      element("div", { className: "ai4u-tools" }, this.#back, this.#play, this.#forward, this.#speeds.element),
      element("div", { className: "ai4u-tools" }, this.#live, this.#proceed, this.#race, this.#noGhost),
      this.#note,
    );
  }

  /** @param {Partial<PastPart>} part */
  update({ playing = null, is_showing: isShowing = false, ghost = "", problem = "" }) {
    this.#playing = playing;
    this.#isShowing = isShowing;
    this.element.hidden = !playing && !ghost && !problem;
    this.#noGhost.hidden = !ghost;
    setText(this.#note, [problem, ghost].filter(Boolean).join(" "));
    const parts = [this.#title, this.#moment, this.#slider, this.#back, this.#play, this.#forward, this.#proceed, this.#race];
    for (const part of [...parts, this.#speeds.element]) part.hidden = !playing;
    // in its place from the start: else it would push the others away when a step is shown
    this.#live.hidden = !playing && !isShowing;
    this.#live.disabled = !isShowing;
    if (playing) this.#show(playing);
  }

  /** @param {PlayedEpisode} playing */
  #show({ number, scene, is_here: isHere, step, steps, is_playing: isPlaying, speed }) {
    // as in the banner over the picture: steps count from 1, and the end comes after the last one
    const text =
      step < steps
        ? t("Step {step} of {steps}", { step: step + 1, steps })
        : tn("The end, after {n} step", "The end, after {n} steps", steps);
    const shown = isHere ? t("Showing episode {number}", { number }) : t("Showing episode {number} · {scene}", { number, scene });
    setText(this.#title, number ? shown : t("Current episode"));
    setText(this.#moment, text);
    setAttributes(this.#slider, { max: steps, "aria-valuetext": text });
    if (document.activeElement !== this.#slider || isPlaying) this.#slider.value = String(step);
    this.#back.disabled = step <= 0;
    this.#forward.disabled = step >= steps;
    setText(this.#play.querySelector("span"), isPlaying ? t("Stop") : t("Play"));
    setAttributes(this.#play, { "data-playing": Boolean(isPlaying) });
    this.#speeds.set(String(speed));
    this.#race.hidden = !number;
  }

  /** @param {number} by */
  #step(by) {
    const { step, steps } = this.#playing;
    const wanted = Math.min(Math.max(step + by, 0), steps);
    this.#panel.send("step", { step: wanted }, { quiet: true });
  }
}
