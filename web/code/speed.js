/** The world's speed during a test, and how it comes back to what it was. */

/** @import { Panel } from "../panel/panel.js" */

import { limits } from "../shared/limits.js";

export class WorldSpeed {
  #panel;
  /**
   * The speed to come back to; null while the world has it.
   * @type {number | "max" | null}
   */
  #before = null;
  #isFast = false;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    panel.addEventListener("part:run", ({ detail }) => {
      if (!this.#isFast && detail.speed === this.#before) this.#before = null;
    });
    panel.addEventListener("connected", () => this.#sendBefore()); // it may have got lost
  }

  /** Let the world run as fast as it goes. */
  async max() {
    this.#before ??= this.#panel.part("run")?.speed ?? 1;
    this.#isFast = true;
    await this.#panel.send("speed", { speed: "max" }, { quiet: true });
  }

  /** Let the world run as before; nothing happens if it does. */
  async restore() {
    if (!this.#isFast) return;
    this.#isFast = false;
    await this.#sendBefore();
  }

  async #sendBefore() {
    if (this.#isFast || this.#before === null) return;
    await this.#panel.send("speed", { speed: this.#before }, { quiet: true });
  }
}

/**
 * Return the panel's word for the end of an episode: "fell", "lost" or "over".
 * @param {Panel} panel
 * @param {{step: number}} percept the last one
 * @param {number} seed
 * @returns {Promise<string>}
 */
export function outcomeOf(panel, { step }, seed) {
  return new Promise((resolve) => {
    const end = (/** @type {string} */ word) => {
      clearTimeout(timer);
      panel.removeEventListener("part:run", check);
      resolve(word);
    };
    const check = () => {
      const run = panel.part("run");
      if (run?.result && run.decision === step && run.seed === String(seed)) end(run.result);
    };
    const timer = setTimeout(end, limits.outcomeMs, "over");
    panel.addEventListener("part:run", check);
    check();
  });
}
