/** The wall's filter, order and size of cards, which this browser remembers. */

/** @import { Wall } from "./wall.js" */

import { element, setText } from "../../shared/dom.js";
import { recall, remember } from "../../shared/storage.js";
import { t } from "../../shared/text.js";
import { FILTERS } from "./order.js";

const STORAGE_KEY = "wall";
/** Widths of cards (px) at the two ends of the slider. Below its first step, all cards fit into the window. */
const MIN_WIDTH_PX = 112;
const MAX_WIDTH_PX = 640;

export class WallControls {
  #wall;
  /**
   * Buttons by filter.
   * @type {Map<string, HTMLButtonElement>}
   */
  #buttons = new Map();

  /**
   * @param {HTMLElement} place has elements for filters, order and size
   * @param {Wall} wall
   */
  constructor(place, wall) {
    this.#wall = wall;
    const { by, size } = { by: "help", size: 0, ...recall(STORAGE_KEY, {}) };
    for (const [filter, { text }] of Object.entries(FILTERS)) {
      const button = element("button", { type: "button", className: "ai4u-chip" }, element("span", { textContent: text }), element("small"));
      button.addEventListener("click", () => this.#filter(filter));
      this.#buttons.set(filter, button);
    }
    place.querySelector("#filters").append(...this.#buttons.values());
    const sort = /** @type {HTMLSelectElement} */ (place.querySelector("#sort"));
    const slider = /** @type {HTMLInputElement} */ (place.querySelector("#size"));
    sort.value = by === "name" ? "name" : "help";
    slider.value = String(size);
    const look = () => {
      const width = widthOf(slider.valueAsNumber);
      slider.setAttribute("aria-valuetext", width ? t("cards {width} pixels wide", { width: Math.round(width) }) : t("all cards fit"));
      wall.look({ by: sort.value, width });
    };
    sort.addEventListener("change", look);
    slider.addEventListener("input", look);
    for (const each of [sort, slider]) {
      each.addEventListener("change", () => remember(STORAGE_KEY, { by: sort.value, size: slider.valueAsNumber }));
    }
    look();
    this.#filter("all");
  }

  /** Bring the filters' counts up to date. */
  update() {
    for (const [filter, button] of this.#buttons) setText(button.querySelector("small"), String(this.#wall.count(filter)));
  }

  /** @param {string} chosen */
  #filter(chosen) {
    for (const [filter, button] of this.#buttons) button.setAttribute("aria-pressed", String(filter === chosen));
    this.#wall.look({ filter: chosen });
  }
}

/** @param {number} size */
function widthOf(size) {
  return size === 0 ? 0 : MIN_WIDTH_PX * (MAX_WIDTH_PX / MIN_WIDTH_PX) ** (size / 100);
}
