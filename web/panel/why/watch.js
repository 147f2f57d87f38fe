/** "Watch it think": a trained network drives for a while and says why; "Beat it!" races against it. */

/**
 * @import { WatchPart } from "../../generated/messages.js"
 * @import { WhyPart } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, setText } from "../../shared/dom.js";
import { roomOfPage } from "../../shared/room.js";
import { t } from "../../shared/text.js";
import { choice } from "../widgets/parts.js";

/** A sentence that changes more often can't be read. */
const SENTENCE_MS = 1200;
const WATCH = t("Watch it think");
const STOP = t("Stop watching");

export class Watch {
  #panel;
  /**
   * The end of the latest command: the next one waits for it, as the world shows its effect before its answer comes.
   * @type {Promise<void>}
   */
  #last = Promise.resolve();
  /** Name of the chosen network; empty for the usual one. */
  #network = "";
  #saidAt = -SENTENCE_MS;
  #later = 0;
  /** The sentence that waits until the one before it was read. */
  #next = "";
  #watch = button(WATCH, () => (this.isOn ? this.stop() : this.start()), { icon: "brain" });
  #beat = button(t("Beat it!"), () => this.beat(), { icon: "race", title: t("Drive against the network's ghost, from the same start") });
  #against = button(t("Let it race me"), () => this.start(true), {});
  #networks = choice(t("Network"), (name) => (this.#network = name));
  element = element(
    "div",
    { className: "ai4u-watch", hidden: true },
    element("div", { className: "ai4u-buttons" }, this.#watch, this.#beat, this.#against),
    this.#networks.element,
  );
  /** Sentence on why the watched network acts as it does; empty while none is watched. */
  thought = "";

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    panel.addEventListener("part:watch", ({ detail }) => this.#draw(detail));
    panel.addEventListener("part:why", ({ detail }) => this.#explain(detail));
  }

  /** True while a network is watched. */
  get isOn() {
    return Boolean(this.#panel.part("watch")?.watching);
  }

  /** The race of the present start; null if there is none. */
  get race() {
    const race = this.#panel.part("watch")?.race;
    return race && race.seed === this.#panel.part("run")?.seed ? race : null;
  }

  /**
   * Let the network drive from the start.
   * @param {boolean} againstMyDrive true to race against a person's best drive, from the start of that
   */
  start(againstMyDrive = false) {
    return this.#ask("watch_network", { network: this.#network, against_my_drive: againstMyDrive });
  }

  stop() {
    return this.#ask("stop_watching");
  }

  /** Let the person drive against the network's ghost. */
  beat() {
    if (!this.isOn && this.#panel.driver?.hello.others) this.#panel.driving.take();
    return this.#ask("race_network", { network: this.#network });
  }

  /**
   * @template {"watch_network" | "stop_watching" | "race_network"} Name
   * @param {Name} command
   * @param {import("../../generated/messages.js").Commands[Name]} [args]
   */
  #ask(command, args) {
    this.#last = this.#last.then(async () => {
      await this.#panel.send(command, args, { quiet: true });
    });
    return this.#last;
  }

  /** @param {WatchPart} part */
  #draw({ networks, has_drive: hasDrive }) {
    // in a class, the teacher decides what drives
    this.element.hidden = networks.length === 0 || roomOfPage() !== "";
    setText(this.#watch.querySelector("span"), this.isOn ? STOP : WATCH);
    this.#against.disabled = !hasDrive;
    this.#against.title = hasDrive ? t("The network drives against the ghost of your best drive") : t("Drive once yourself, and it can race you");
    if (!networks.some(({ name }) => name === this.#network)) this.#network = networks[0]?.name ?? "";
    this.#networks.element.hidden = networks.length < 2;
    this.#networks.set(networks.map(({ name, title }) => ({ value: name, text: title })), this.#network);
    if (!this.isOn) this.#forget();
  }

  #forget() {
    clearTimeout(this.#later);
    this.#later = 0;
    this.#saidAt = -SENTENCE_MS;
    this.#say("");
  }

  /** @param {WhyPart} part */
  #explain({ agent, problem, sentence }) {
    if (!this.isOn || agent !== this.#panel.shown.agent) return;
    this.#next = problem || sentence;
    this.#later ||= setTimeout(
      () => {
        this.#later = 0;
        this.#saidAt = performance.now();
        if (this.isOn) this.#say(this.#next);
      },
      Math.max(0, this.#saidAt + SENTENCE_MS - performance.now()),
    );
  }

  /** @param {string} text */
  #say(text) {
    if (text === this.thought) return;
    this.thought = text;
    this.#panel.dispatchEvent(new Event("thought"));
  }
}
