/** Winning and falling, to see and to hear: confetti over the picture, stars that fly in, and sounds. */

/** @import { StateEvent } from "../generated/messages.js" */
import { element } from "../shared/dom.js";
import { Sounds } from "../shared/sound.js";
import { icon } from "../shared/icons.js";
import { t } from "../shared/text.js";
import { WINS } from "./results.js";

const LESS_MOTION = matchMedia("(prefers-reduced-motion: reduce)");
const PIECES = 60;
/** Duration of the confetti (ms). */
const CONFETTI_MS = 1600;
/** Duration of the stars' flight, from the first one to the last (ms). */
const STARS_MS = 2600;
/** Colours of Okabe and Ito's palette. */
const COLOURS = ["#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7"];
/** Pixels per second squared. */
const GRAVITY = 900;

export class Effects {
  #sounds = new Sounds();
  #button;

  /** @param {HTMLElement} row parent of the button that mutes */
  constructor(row) {
    this.#button = element("button", { type: "button", className: "ai4u-round-button ai4u-sound" });
    this.#button.addEventListener("click", () => {
      this.#sounds.isOn = !this.#sounds.isOn;
      this.#drawButton();
    });
    row.prepend(this.#button); // the line beside it changes its length
    this.#drawButton();
  }

  /**
   * Show and sound what has happened to the agent that this page drives.
   * @param {StateEvent | null} before the server's message before; null for none
   * @param {StateEvent} state
   * @param {boolean} isMine true if this page, or its program, drives it
   */
  follow(before, state, isMine) {
    const isSame = before !== null && before.episode === state.episode && before.agent_episode === state.agent_episode;
    if (before === null || !isMine || before.past || state.past) return;
    if (isSame && state.said > before.said) this.#sounds.speak();
    if (state.outcome && !(isSame && before.outcome)) {
      if (WINS.includes(state.outcome)) {
        this.celebrate();
      } else if (state.outcome === "fell") this.#sounds.fall();
    } else if (isSame && state.collects > before.collects) this.#sounds.collect();
    else if (isSame && state.bumps > before.bumps && !state.outcome) this.#sounds.bump();
  }

  /** Show and sound that something was reached. */
  celebrate() {
    this.#sounds.win();
    showConfetti();
  }

  /**
   * Let the motor hum, or stop it.
   * @param {boolean} isRunning
   */
  motor(isRunning) {
    this.#sounds.motor(isRunning);
  }

  /**
   * Follow the teacher's switch of a class.
   * @param {boolean} isOn true if students' pages may make sounds
   */
  allowSound(isOn) {
    this.#sounds.isForbidden = !isOn;
    if (!isOn) this.#sounds.motor(false);
    this.#drawButton();
  }

  #drawButton() {
    const { isOn, isForbidden } = this.#sounds;
    this.#button.hidden = isForbidden;
    this.#button.replaceChildren(icon(isOn ? "sound" : "mute", 18));
    this.#button.ariaLabel = this.#button.title = isOn ? t("Turn the sound off") : t("Turn the sound on");
  }
}

/**
 * Let stars fly in, one by one.
 * @param {number} count
 */
export function flyStars(count) {
  if (LESS_MOTION.matches || count < 1) return;
  const stars = Array.from({ length: count }, (_, index) => {
    const star = element("span", { textContent: "★" });
    star.style.animationDelay = `${index * 350}ms`;
    return star;
  });
  const row = element("div", { className: "ai4u-flying-stars", ariaHidden: "true" }, ...stars);
  document.body.append(row);
  setTimeout(() => row.remove(), STARS_MS);
}

/** Throw confetti over the picture, unless the person prefers less motion. */
function showConfetti() {
  if (LESS_MOTION.matches) return;
  const canvas = element("canvas", { className: "ai4u-confetti", ariaHidden: "true", width: innerWidth, height: innerHeight });
  const context = canvas.getContext("2d");
  if (context === null) return;
  document.body.append(canvas);
  const style = getComputedStyle(document.documentElement);
  const [left, right] = ["--ai4u-left", "--ai4u-right"].map((name) => parseFloat(style.getPropertyValue(name)) || 0);
  const middle = (left + innerWidth - right) / 2;
  const pieces = Array.from({ length: PIECES }, (_, index) => ({
    x: middle,
    y: innerHeight * 0.4,
    vx: (Math.random() - 0.5) * 900,
    vy: -200 - Math.random() * 500,
    turn: Math.random() * 6,
    size: 6 + Math.random() * 6,
    colour: COLOURS[index % COLOURS.length],
  }));
  const began = performance.now();
  let drawnAt = began;
  const draw = (/** @type {number} */ now) => {
    const [age, step] = [now - began, Math.min(0.1, Math.max(0, now - drawnAt) / 1000)];
    drawnAt = now;
    if (age >= CONFETTI_MS) {
      canvas.remove();
      return;
    }
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.globalAlpha = Math.min(1, (2 * (CONFETTI_MS - age)) / CONFETTI_MS);
    for (const piece of pieces) {
      piece.x += piece.vx * step;
      piece.y += piece.vy * step;
      piece.vy += GRAVITY * step;
      piece.turn += 8 * step;
      context.setTransform(Math.cos(piece.turn), Math.sin(piece.turn), -Math.sin(piece.turn), Math.cos(piece.turn), piece.x, piece.y);
      context.fillStyle = piece.colour;
      context.fillRect(-piece.size / 2, -piece.size / 4, piece.size, piece.size / 2);
    }
    context.setTransform(1, 0, 0, 1, 0, 0);
    requestAnimationFrame(draw);
  };
  requestAnimationFrame(draw);
}
