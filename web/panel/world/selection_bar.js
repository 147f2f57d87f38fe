/** The bar over the picture for the selected things, and the frame with which several are selected. */

/**
 * @import { Panel } from "../panel.js"
 * @import { Point } from "./ground.js"
 */
import { button, element, setAttributes, setText } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";
import { isTextInput } from "../../page/keys.js";
import { Ground } from "./ground.js";
import { alignSelected, choose, chooseMore, copySelected, duplicateSelected, paste, removeSelected, selected } from "./selection.js";

/** Distance by which an arrow key moves a thing if there is no grid, or while Alt is held (m). */
const FREE_STEP_M = 0.05;
/** Angle by which an arrow key rotates a thing while Shift is held (degrees). */
const TURN_STEP_DEG = 15;
/**
 * Directions of arrow keys.
 * @type {Record<string, [right: number, up: number]>}
 */
export const DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
/** Size (px) from which a pulled frame is one; a smaller one is a click. */
const MIN_FRAME_PX = 6;

export class SelectionBar {
  #panel;
  #say;
  #several = button("", () => this.#setMode(!this.#isMode), { icon: "area", label: t("Select several") });
  #count = element("p", { className: "ai4u-selection-count", role: "status" });
  #one;
  #many;
  #paste;
  #layer = element("div", { className: "ai4u-layer ai4u-frame-layer", ariaHidden: "true" });
  #frame = element("div", { className: "ai4u-frame", hidden: true });
  element = element("div", { className: "ai4u-selection", role: "toolbar", ariaLabel: t("Selected things"), hidden: true });
  /** True while taps and frames select several things. */
  #isMode = false;
  #hasCopy = false;
  /**
   * The corner at which a frame begins (px); null while none is pulled.
   * @type {Point | null}
   */
  #start = null;
  /**
   * The latest place of the pointer over the picture (px); null if it is elsewhere.
   * @type {Point | null}
   */
  #pointer = null;

  /**
   * @param {Panel} panel
   * @param {(text: string) => void} say says something to screen readers
   */
  constructor(panel, say) {
    this.#panel = panel;
    this.#say = say;
    setAttributes(this.#several, { "aria-pressed": "false" });
    this.#one = [
      button("", () => this.#copy(), { icon: "copy", label: t("Copy (Ctrl+C)") }),
      button("", () => duplicateSelected(panel), { icon: "duplicate", label: t("Duplicate (Ctrl+D)") }),
      button("", () => removeSelected(panel), { icon: "trash", label: t("Delete") }),
    ];
    this.#many = [
      button("", () => alignSelected(panel, "row"), { icon: "align_row", label: t("Put into a row") }),
      button("", () => alignSelected(panel, "column"), { icon: "align_column", label: t("Put into a column") }),
      button("", () => alignSelected(panel, "spread"), { icon: "spread", label: t("Space evenly") }),
    ];
    this.#paste = button("", () => paste(panel, null), { icon: "paste", label: t("Paste (Ctrl+V)") });
    this.element.append(this.#count, this.#several, ...this.#one, this.#paste, ...this.#many);
    this.#layer.append(this.#frame);
    this.#layer.addEventListener("pointerdown", (event) => this.#startFrame(event));
    this.#layer.addEventListener("pointermove", (event) => this.#pull(event));
    this.#layer.addEventListener("pointerup", (event) => this.#endFrame(event));
    this.#layer.addEventListener("pointercancel", () => this.#stopFrame());
    addEventListener("keydown", (event) => event.key === "Shift" && !isTextInput(event.target) && this.#showLayer(true));
    addEventListener("keyup", (event) => event.key === "Shift" && this.#showLayer(false));
    addEventListener("blur", () => this.#showLayer(false));
    addEventListener("pointermove", (event) => this.#notePointer(event), { capture: true });
    panel.addEventListener("shown", () => this.#update());
    panel.addEventListener("part:world", () => this.#update());
    this.#update();
  }

  /** @param {boolean} isOn */
  show(isOn) {
    this.element.hidden = !isOn;
    if (!isOn) this.#setMode(false);
  }

  /**
   * Return what a key does to the selected things, as a function; null if it does nothing here.
   * @param {KeyboardEvent} event
   */
  commandOf(event) {
    const { key, code } = event;
    const panel = this.#panel;
    if (!panel.shown.tabs.includes("world")) return null;
    const names = selected(panel);
    if (event.ctrlKey || event.metaKey) {
      const letter = key.toLowerCase();
      if (letter === "v") return () => this.#pasteHere();
      if (names.length === 0) return null;
      if (letter === "d") return () => duplicateSelected(panel);
      return letter === "c" && getSelection().isCollapsed ? () => this.#copy() : null;
    }
    if (names.length === 0) return null;
    if (key === "Delete" || key === "Backspace") return () => removeSelected(panel);
    if (key === "Escape" && !panel.part("world")?.is_dragging) return () => choose(panel, null);
    const moves = code in DIRECTIONS && panel.part("world")?.is_move_mode && !usesArrows(event.target);
    return moves ? () => this.#nudge(names, event) : null;
  }

  /**
   * @param {string[]} names
   * @param {KeyboardEvent} event
   */
  async #nudge(names, { code, shiftKey, altKey }) {
    const [right, up] = DIRECTIONS[code];
    const step = (!altKey && this.#panel.part("world")?.snap) || FREE_STEP_M;
    const turn = shiftKey ? -right * TURN_STEP_DEG : 0;
    const [dx, dy] = shiftKey ? [0, 0] : [right * step, up * step];
    const answer = await this.#panel.send("nudge", { names, dx, dy, turn_deg: turn }, { quiet: true });
    if (answer.ok) this.#say(answer.text);
  }

  #copy() {
    this.#hasCopy = true;
    copySelected(this.#panel);
    this.#update();
  }

  /** Paste where the pointer is, or beside where it was copied. */
  async #pasteHere() {
    const place = this.#pointer;
    const ground = place && (await this.#ground());
    await paste(this.#panel, ground ? ground.at(place) : null);
  }

  #update() {
    const names = selected(this.#panel);
    const words = names.length > 1 ? tn("{n} thing selected", "{n} things selected", names.length) : "";
    setText(this.#count, this.#isMode ? words || t("Tap things, or pull a frame around them") : words);
    for (const tool of this.#one) tool.hidden = names.length === 0;
    for (const tool of this.#many) tool.hidden = names.length < 2;
    this.#paste.hidden = !this.#hasCopy;
  }

  /** @param {boolean} isOn */
  #setMode(isOn) {
    this.#isMode = isOn;
    setAttributes(this.#several, { "aria-pressed": isOn ? "true" : "false" });
    this.#showLayer(isOn);
    this.#update();
  }

  /** @param {boolean} isOn */
  #showLayer(isOn) {
    if (isOn ? this.element.hidden : this.#isMode || this.#start) return;
    if (isOn) document.body.append(this.#layer);
    else this.#layer.remove();
  }

  /** @param {PointerEvent} event */
  #startFrame({ pointerId, clientX: x, clientY: y }) {
    this.#layer.setPointerCapture(pointerId);
    this.#start = { x, y };
  }

  /** @param {PointerEvent} event */
  #pull(event) {
    if (this.#start === null) return;
    const { left, top, width, height } = between(this.#start, event);
    this.#frame.hidden = Math.max(width, height) < MIN_FRAME_PX;
    Object.assign(this.#frame.style, { left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` });
  }

  /** @param {PointerEvent} event */
  async #endFrame(event) {
    const start = this.#start;
    this.#stopFrame();
    if (!event.shiftKey) this.#showLayer(this.#isMode);
    if (start === null) return;
    const { left, top, width, height } = between(start, event);
    const isFrame = Math.max(width, height) >= MIN_FRAME_PX;
    const corners = isFrame
      ? [[left, top], [left + width, top], [left + width, top + height], [left, top + height]]
      : [[left, top]];
    const ground = await this.#ground();
    const places = corners.map(([x, y]) => ground?.at({ x, y }) ?? null);
    if (places.includes(null)) return;
    const answer = await this.#panel.send("find_things", { corners: places.map(({ x, y }) => [x, y]) }, { quiet: true });
    if (!answer.ok) return;
    if (answer.names.length) chooseMore(this.#panel, answer.names, { isToggle: !isFrame });
    else if (!isFrame && !event.shiftKey) choose(this.#panel, null);
  }

  #stopFrame() {
    this.#start = null;
    this.#frame.hidden = true;
  }

  /** Return the map between picture and ground; null if there is none. */
  async #ground() {
    const rect = document.getElementById("root")?.getBoundingClientRect();
    const answer = await this.#panel.send("ground", {}, { quiet: true });
    return answer.ok && rect ? new Ground(answer.matrix, rect) : null;
  }

  /** @param {PointerEvent} event */
  #notePointer({ target, clientX: x, clientY: y }) {
    const isThere = target instanceof HTMLCanvasElement || target === this.#layer;
    this.#pointer = isThere ? { x, y } : null;
  }
}

/** @param {EventTarget} target */
function usesArrows(target) {
  return target instanceof Element && target.matches("[role=tab], [role=slider], input, select");
}

/**
 * @param {Point} start
 * @param {PointerEvent} end
 */
function between(start, { clientX, clientY }) {
  const [left, top] = [Math.min(start.x, clientX), Math.min(start.y, clientY)];
  return { left, top, width: Math.abs(start.x - clientX), height: Math.abs(start.y - clientY) };
}
