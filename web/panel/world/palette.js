/**
 * The palette under the world: things to drag out, or to click and then to place with a click or the arrow keys.
 *
 * While a thing is held, a layer over the picture takes the pointer, so that the camera stays where it is.
 */

/**
 * @import { PaletteThing } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 * @import { Point } from "./ground.js"
 */
import { element, setAttributes, setText } from "../../shared/dom.js";
import { recall } from "../../shared/storage.js";
import { t } from "../../shared/text.js";
import { Ground, onGrid } from "./ground.js";
import { chooseAdded, setMoveMode } from "./selection.js";
import { DIRECTIONS, SelectionBar } from "./selection_bar.js";

/** Keys under which the page remembers whether things are moved by the mouse, and the distance of the grid (m). */
export const MOVES_KEY = "move-things";
export const SNAP_KEY = "snap-m";
/** Usual distance of the grid (m). */
export const SNAP_M = 0.5;
/** Side of the held thing's picture (px), as in styles/panel/build.css. */
const GHOST_PX = 96;
/** Way (px) after which a pressed entry is dragged. */
const DRAG_PX = 6;
/** Time (ms) after which the camera may have moved. */
const GROUND_MS = 400;
/** Step of an arrow key (m) without a grid, and with Alt. */
const STEP_M = 0.25;
const FINE_STEP_M = 0.05;

/** @typedef {Pick<PointerEvent, "clientX" | "clientY" | "altKey">} Aim */

export class Palette {
  #panel;
  #entries = element("div", { className: "ai4u-palette-entries", role: "group", ariaLabel: t("Things to add") });
  #says = element("p", { className: "ai4u-hidden-text", role: "status" });
  #hint = element("p", { className: "ai4u-palette-hint", textContent: t("Drag a thing into the world.") });
  #layer = element("div", { className: "ai4u-layer", ariaHidden: "true" });
  #ghost = element("img", { className: "ai4u-ghost", alt: "", draggable: false });
  /** The bar for the selected things. */
  bar;
  element = element("section", { className: "ai4u-palette", ariaLabel: t("Add to the world"), hidden: true });
  /**
   * The thing that is held; null for none.
   * @type {PaletteThing | null}
   */
  #held = null;
  /**
   * The place of the held thing (m); null before the pointer is over the picture.
   * @type {Point | null}
   */
  #place = null;
  /**
   * The pointer that it follows; null for one that keys move.
   * @type {Aim | null}
   */
  #pointer = null;
  /** @type {Ground | null} */
  #ground = null;
  #timer = 0;
  /**
   * The press of an entry that may become a drag; null while none is pressed.
   * @type {{thing: PaletteThing, x: number, y: number} | null}
   */
  #press = null;
  /** True once the latest press of an entry was a drag. */
  #isDrag = false;
  #isListed = false;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.bar = new SelectionBar(panel, (text) => this.say(text));
    this.#layer.append(this.#ghost);
    this.element.append(this.bar.element, this.#hint, this.#entries, this.#says);
    this.#layer.addEventListener("pointermove", (event) => this.#follow(event));
    this.#layer.addEventListener("pointerdown", (event) => this.#follow(event));
    this.#layer.addEventListener("pointerup", (event) => this.#putAt(event));
    addEventListener("resize", () => this.element.hidden || setMoveMode(panel, recall(MOVES_KEY, true)));
    panel.addEventListener("connected", () => this.element.hidden || this.show(true));
  }

  /** @param {boolean} isOn */
  show(isOn) {
    this.element.hidden = !isOn;
    setMoveMode(this.#panel, isOn && recall(MOVES_KEY, true));
    this.#panel.send("snap", { distance: recall(SNAP_KEY, SNAP_M) }, { quiet: true });
    this.bar.show(isOn);
    document.documentElement.toggleAttribute("data-ai4u-building", isOn);
    if (!isOn) this.#drop();
    else if (!this.#isListed) this.#list();
  }

  /**
   * Return what a key does, as a function; null if it does nothing here.
   * @param {KeyboardEvent} event
   */
  commandOf(event) {
    const { key, code, altKey, ctrlKey, metaKey, repeat } = event;
    if (this.#held === null || ctrlKey || metaKey) return this.bar.commandOf(event);
    if (key === "Escape") return () => this.#drop(t("Put away."));
    if (key === "Enter") return () => repeat || this.#put(); // the press that took it may still go on
    if (!(code in DIRECTIONS)) return this.bar.commandOf(event);
    const step = altKey ? FINE_STEP_M : this.#snap || STEP_M;
    const [right, up] = DIRECTIONS[code];
    return () => {
      this.#pointer = null;
      const { x, y } = this.#place ?? this.#middle ?? { x: 0, y: 0 };
      this.#move(onGrid({ x: x + right * step, y: y + up * step }, altKey ? 0 : this.#snap));
      this.say(`${this.#held.title}: ${placeWords(this.#place)}.`);
    };
  }

  /**
   * Say something to screen readers.
   * @param {string} text
   */
  say(text) {
    setText(this.#says, text);
  }

  async #list() {
    this.#isListed = true;
    const answer = await this.#panel.send("palette", {}, { quiet: true });
    this.#isListed = answer.ok;
    if (!answer.ok) return;
    this.#entries.replaceChildren(...answer.items.map((thing) => this.#entry(thing)));
  }

  /** @param {PaletteThing} thing */
  #entry(thing) {
    const made = element(
      "button",
      { type: "button", className: "ai4u-palette-entry", title: t("Drag it into the world, or click it and then a place"), value: thing.name },
      element("img", { src: thing.url, alt: "", draggable: false }),
      element("span", { textContent: thing.title }),
    );
    setAttributes(made, { "aria-pressed": "false" });
    made.addEventListener("pointerdown", (event) => this.#startPress(made, thing, event));
    made.addEventListener("pointermove", (event) => this.#dragOut(event));
    made.addEventListener("pointerup", (event) => this.#endPress(event));
    made.addEventListener("pointercancel", () => {
      this.#press = null;
      this.#drop();
    });
    made.addEventListener("click", (event) => this.#onClick(thing, event));
    return made;
  }

  /**
   * @param {HTMLElement} entry
   * @param {PaletteThing} thing
   * @param {PointerEvent} event
   */
  #startPress(entry, thing, { button, pointerId, clientX: x, clientY: y }) {
    if (button !== 0) return;
    entry.setPointerCapture(pointerId);
    this.#press = { thing, x, y };
    this.#isDrag = false;
  }

  /** @param {PointerEvent} event */
  #dragOut(event) {
    const press = this.#press;
    if (press === null) return;
    if (!this.#isDrag && Math.hypot(event.clientX - press.x, event.clientY - press.y) < DRAG_PX) return;
    if (!this.#isDrag) {
      this.#isDrag = true;
      this.#hold(press.thing);
    }
    this.#follow(event);
  }

  /** @param {PointerEvent} event */
  #endPress(event) {
    this.#press = null;
    if (!this.#isDrag) return; // the click that comes next holds it
    if (isWithin(event, this.#rect)) this.#putAt(event);
    else this.#drop(t("Put away."));
  }

  /**
   * @param {PaletteThing} thing
   * @param {MouseEvent} event
   */
  #onClick(thing, event) {
    if (this.#isDrag && event.detail > 0) return;
    if (this.#held === thing) return this.#drop(t("Put away."));
    this.#hold(thing, { isByKeys: event.detail === 0 });
  }

  /**
   * Hold a thing until it is placed or put away.
   * @param {PaletteThing} thing
   * @param {{isByKeys?: boolean}} [options] by keys it begins in the middle of the picture
   */
  async #hold(thing, { isByKeys = false } = {}) {
    this.#drop();
    this.#held = thing;
    for (const entry of this.#entries.children) {
      setAttributes(entry, { "aria-pressed": entry instanceof HTMLButtonElement && entry.value === thing.name ? "true" : "false" });
    }
    this.#ghost.src = thing.url;
    this.#ghost.hidden = true;
    document.body.append(this.#layer);
    const hint = isByKeys
      ? t("Arrow keys move it, Enter puts it there, Esc puts it away.")
      : t("Now click a place in the world. Esc puts it away.");
    setText(this.#hint, hint);
    this.say(t("{thing}: the arrow keys move it, Enter puts it there, Escape puts it away.", { thing: thing.title }));
    await this.#look();
    if (this.#held === thing && isByKeys && this.#place === null && this.#middle) this.#move(onGrid(this.#middle, this.#snap));
  }

  /** @param {string} [text] for screen readers */
  #drop(text = "") {
    clearTimeout(this.#timer);
    this.#held = this.#place = this.#ground = this.#pointer = null;
    this.#layer.remove();
    for (const entry of this.#entries.children) setAttributes(entry, { "aria-pressed": "false" });
    setText(this.#hint, t("Drag a thing into the world."));
    if (text) this.say(text);
  }

  /** @param {PointerEvent} event */
  async #putAt(event) {
    if (this.#ground === null) await this.#look(); // dropped before the map has come
    this.#follow(event);
    await this.#put();
  }

  async #put() {
    const [thing, place] = [this.#held, this.#place];
    if (thing === null || place === null) return;
    this.#drop();
    const answer = await this.#panel.send("add_body", { template: thing.name, ...place });
    if (!answer.ok) {
      this.say(answer.text || answer.problems.map((problem) => problem.text).join(" "));
      return;
    }
    this.say(answer.text);
    chooseAdded(this.#panel, answer);
  }

  /** Ask for the map between picture and ground, and again while a thing is held: the camera may follow a robot. */
  async #look() {
    clearTimeout(this.#timer);
    const rect = this.#rect;
    const answer = await this.#panel.send("ground", {}, { quiet: true });
    if (this.#held === null) return;
    if (answer.ok && rect !== null) {
      this.#ground = new Ground(answer.matrix, rect);
      if (this.#pointer) this.#follow(this.#pointer);
      else if (this.#place) this.#move(this.#place);
    }
    this.#timer = setTimeout(() => this.#look(), GROUND_MS);
  }

  /** @param {Aim} aim */
  #follow({ clientX, clientY, altKey }) {
    this.#pointer = { clientX, clientY, altKey };
    const isThere = isWithin(this.#pointer, this.#rect);
    if (this.#held === null) return;
    const place = isThere ? (this.#ground?.at({ x: clientX, y: clientY }) ?? null) : null;
    if (place === null) {
      this.#place = null;
      this.#ghost.hidden = true;
    } else this.#move(onGrid(place, altKey ? 0 : this.#snap));
  }

  /** @param {Point} place (m) */
  #move(place) {
    this.#place = place;
    const matrix = this.#ground?.matrixAt(place);
    this.#ghost.hidden = !matrix;
    if (!matrix) return;
    const share = this.#held.side_m / GHOST_PX;
    const scaled = matrix.map((number, index) => (index < 4 ? number * share : number));
    this.#ghost.style.transform = `matrix(${scaled.join(", ")})`;
  }

  get #snap() {
    return this.#panel.part("world")?.snap ?? 0;
  }

  /** The middle of the picture on the ground (m). */
  get #middle() {
    const rect = this.#rect;
    return rect && this.#ground?.at({ x: rect.left + rect.width / 2, y: rect.top + rect.height / 2 });
  }

  /** The place of the world's picture in the window. */
  get #rect() {
    return document.getElementById("root")?.getBoundingClientRect() ?? null;
  }
}

/** @param {Point} place (m) */
function placeWords({ x, y }) {
  const amounts = { across: Math.abs(x), along: Math.abs(y) };
  if (x < 0) return y < 0 ? t("{across} m left, {along} m down", amounts) : t("{across} m left, {along} m up", amounts);
  return y < 0 ? t("{across} m right, {along} m down", amounts) : t("{across} m right, {along} m up", amounts);
}

/**
 * @param {Pick<Aim, "clientX" | "clientY">} place
 * @param {DOMRect | null} rect
 */
function isWithin({ clientX, clientY }, rect) {
  return rect !== null && clientX >= rect.left && clientX < rect.right && clientY >= rect.top && clientY < rect.bottom;
}
