/**
 * Place of the panel: beside the canvas, below it on tablets held upright, a sheet above the keys on phones.
 *
 * It sets data-ai4u-layout (side, below, sheet), data-ai4u-panel (open, folded) and data-ai4u-wide of the document's
 * root, and the CSS variables --ai4u-panel-size and --ai4u-dock-height; styles/panel/layout.css does the rest.
 */

import { element, setAttributes } from "../shared/dom.js";
import { recall, remember } from "../shared/storage.js";
import { t } from "../shared/text.js";

const PHONE = matchMedia("(max-width: 576px) and (max-aspect-ratio: 3/2)");
/** A phone on its side: the panel stands beside the canvas, but folded at first. */
const LOW = matchMedia("(max-height: 500px)");
const UPRIGHT = matchMedia("(orientation: portrait) and (max-width: 1000px)");
/**
 * Smallest, largest and usual size: width beside the canvas (px), that of a wide tab (share of the window, %), height
 * below the canvas (%).
 * @type {Record<string, number[]>}
 */
const SIZES = { side: [280, 560, 340], wide: [25, 70, 45], below: [25, 70, 42] };
/** @type {Record<string, string>} */
const UNITS = { side: "px", wide: "vw", below: "dvh" };
/**
 * Change by an arrow key on the handle.
 * @type {Record<string, number>}
 */
const STEPS = { side: 20, wide: 5, below: 5 };

export class Layout {
  #root = document.documentElement;
  #onFold;
  #kind = "side";
  #isWide = false;
  handle = element("div", { className: "ai4u-resize", tabIndex: 0 });

  /** @param {(isFolded: boolean) => void} onFold called with true when the panel is folded, and with false when it is opened */
  constructor(onFold) {
    this.#onFold = onFold;
    setAttributes(this.handle, { role: "separator", "aria-label": t("Size of the panel") });
    this.handle.addEventListener("pointerdown", (event) => this.#startDrag(event));
    this.handle.addEventListener("pointermove", (event) => this.#drag(event));
    this.handle.addEventListener("keydown", (event) => this.#onKey(event));
    this.handle.addEventListener("dblclick", () => this.#resize(SIZES[this.#size]?.[2]));
    for (const query of [PHONE, LOW, UPRIGHT]) query.addEventListener("change", () => this.arrange());
  }

  get isFolded() {
    return this.#root.dataset.ai4uPanel === "folded";
  }

  /** @param {boolean} isFolded */
  fold(isFolded) {
    remember(this.#foldKey, isFolded);
    this.#showFold(isFolded);
  }

  /**
   * Show a tab that needs width, or one that doesn't: beside the canvas, each has a size of its own.
   * @param {boolean} isWide
   */
  widen(isWide) {
    this.#isWide = isWide;
    this.arrange();
  }

  /** Choose the place that fits the window. */
  arrange() {
    this.#kind = PHONE.matches ? "sheet" : UPRIGHT.matches ? "below" : "side";
    this.#root.dataset.ai4uLayout = this.#kind;
    this.handle.hidden = this.#kind === "sheet";
    this.#root.toggleAttribute("data-ai4u-wide", this.#size === "wide");
    this.#showSize(recall(`panel-size-${this.#size}`, SIZES[this.#size]?.[2]));
    this.#showFold(recall(this.#foldKey, this.#isSmall));
  }

  /**
   * Keep the height of the keys on the screen, above which a sheet stands.
   * @param {HTMLElement} dock
   */
  observeDock(dock) {
    const update = () => this.#root.style.setProperty("--ai4u-dock-height", `${dock.offsetHeight}px`);
    new ResizeObserver(update).observe(dock);
  }

  /** Name of the size that can be changed now; "sheet" has none. */
  get #size() {
    return this.#kind === "side" && this.#isWide ? "wide" : this.#kind;
  }

  get #isSmall() {
    return PHONE.matches || LOW.matches;
  }

  get #foldKey() {
    return this.#isSmall ? "panel-folded-small" : "panel-folded";
  }

  /** @param {boolean} isFolded */
  #showFold(isFolded) {
    this.#root.dataset.ai4uPanel = isFolded ? "folded" : "open";
    this.#onFold(isFolded);
  }

  /** @param {number | undefined} size undefined for a sheet, which has none */
  #showSize(size) {
    if (size === undefined) return;
    const [min, max] = SIZES[this.#size];
    this.#root.style.setProperty("--ai4u-panel-size", `${size}${UNITS[this.#size]}`);
    setAttributes(this.handle, {
      "aria-orientation": this.#kind === "side" ? "vertical" : "horizontal",
      "aria-valuemin": min,
      "aria-valuemax": max,
      "aria-valuenow": Math.round(size),
    });
  }

  /** @param {number | undefined} size */
  #resize(size) {
    if (!(this.#size in SIZES)) return;
    const [min, max] = SIZES[this.#size];
    const within = Math.max(min, Math.min(max, size));
    this.#showSize(within);
    remember(`panel-size-${this.#size}`, within);
  }

  /** @param {PointerEvent} event */
  #startDrag(event) {
    if (event.button !== 0) return;
    event.preventDefault(); // else the drag selects text
    this.handle.setPointerCapture(event.pointerId);
  }

  /** @param {PointerEvent} event */
  #drag(event) {
    if (!this.handle.hasPointerCapture(event.pointerId)) return;
    const width = innerWidth - event.clientX;
    if (this.#size === "side") this.#resize(width);
    else if (this.#size === "wide") this.#resize((100 * width) / innerWidth);
    else this.#resize((100 * (innerHeight - event.clientY)) / innerHeight);
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    const bigger = this.#kind === "side" ? "ArrowLeft" : "ArrowUp";
    const smaller = this.#kind === "side" ? "ArrowRight" : "ArrowDown";
    if (event.key !== bigger && event.key !== smaller) return;
    event.preventDefault();
    const step = STEPS[this.#size] * (event.key === bigger ? 1 : -1);
    this.#resize(Number(this.handle.getAttribute("aria-valuenow")) + step);
  }
}
