/** One sensor of the Drive tab: its name in words, and its reading as bars, strips, pictures or text. */

/**
 * @import { ReadingPicture, SensorReading } from "../../generated/messages.js"
 * @import { Panel } from "../panel.js"
 * @import { SensorWeights } from "../why/why.js"
 */
import { button, element, keyed, setAttributes, setText } from "../../shared/dom.js";
import { Bars } from "../widgets/bars.js";
import { icon } from "../../shared/icons.js";
import { t } from "../../shared/text.js";
import { drawStrip, makeStrip } from "../widgets/strip.js";
import { drawWeights } from "../why/why.js";

/** A picture with fewer rows is stretched to a line. */
const MIN_ROWS = 4;

/** @typedef {HTMLElement & {view?: SensorView}} SensorElement */

export class SensorView {
  #panel;
  #key;
  #title = "";
  #isShown = false;
  #heading = element("h4");
  #type = element("code", { className: "ai4u-details-only" });
  #eye = button("", () => this.#toggle(), { icon: "eye", label: t("Show in the picture"), kind: "quiet" });
  #bars = new Bars();
  #strips = element("div", { className: "ai4u-strips" });
  #weights = element("div", { className: "ai4u-why-weights", hidden: true, ariaHidden: "true" });
  #pictures = element("div", { className: "ai4u-pictures" });
  #text = element("p");
  #help = element("p", { className: "ai4u-soft ai4u-details-only" });
  /** @type {SensorElement} */
  element;

  /**
   * @param {Panel} panel
   * @param {SensorReading} sensor
   */
  constructor(panel, sensor) {
    this.#panel = panel;
    this.#key = sensor.key;
    const mark = element("span", { className: "ai4u-card-icon" }, icon(sensor.icon ?? "own"));
    const words = element("div", {}, this.#heading, this.#type);
    const head = element("header", {}, mark, words, this.#eye);
    const reading = [this.#bars.element, this.#strips, this.#pictures, this.#weights, this.#text];
    this.element = element("article", { className: "ai4u-sensor" }, head, ...reading, this.#help);
    this.element.view = this; // found again when the list is brought up to date
  }

  /**
   * @param {SensorReading} sensor
   * @param {SensorWeights | null} why how much its slots matter; null if that is not shown
   */
  update(sensor, why = null) {
    const { title, key, help = "", values = [], strips = [], pictures = [], text = "" } = sensor;
    this.#title = title || key;
    this.#isShown = Boolean(sensor.is_shown);
    setText(this.#heading, this.#title);
    setText(this.#type, [sensor.class, key].filter(Boolean).join(" · "));
    setText(this.#help, help);
    setAttributes(this.#heading, { title: help || null });
    this.#eye.hidden = !sensor.is_drawable;
    const label = t("Show {sensor} in the picture", { sensor: this.#title });
    setAttributes(this.#eye, { "aria-pressed": this.#isShown ? "true" : "false", "aria-label": label, title: label });
    this.#bars.element.hidden = values.length === 0;
    const hasBars = why !== null && why.slots.length === values.length;
    this.#bars.update(hasBars ? values.map((row, index) => ({ ...row, why: why.slots[index].share / why.scale })) : values);
    drawWeights(this.#weights, hasBars ? null : why, pictures[0]?.columns);
    list(this.#strips, strips, makeStrip, drawStrip);
    list(this.#pictures, pictures, makePicture, (made, picture) => drawPicture(made, picture, this.#title));
    this.#text.hidden = text === "";
    setText(this.#text, text);
  }

  async #toggle() {
    await this.#panel.send("sensor", { key: this.#key, on: !this.#isShown }, { quiet: true });
  }
}

/**
 * Make an element's children match a list by position.
 * @template Item
 * @template {HTMLElement} Child
 * @param {HTMLElement} parent
 * @param {Item[]} items
 * @param {() => Child} make
 * @param {(child: NoInfer<Child>, item: NoInfer<Item>) => void} draw
 */
function list(parent, items, make, draw) {
  parent.hidden = items.length === 0;
  const numbered = items.map((item, index) => ({ item, index }));
  keyed(parent, numbered, ({ index }) => index, make, (made, { item }) => draw(made, item));
}

function makePicture() {
  return element("figure", {}, element("img", { alt: "" }), element("figcaption"));
}

/**
 * @param {HTMLElement} figure
 * @param {ReadingPicture} picture
 * @param {string} title of the sensor
 */
function drawPicture(figure, { cells, caption, rows, columns }, title) {
  const [image, words] = /** @type {[HTMLImageElement, HTMLElement]} */ ([...figure.children]);
  if (image.src !== cells) image.src = cells;
  const isFlat = rows < MIN_ROWS;
  const isOlder = caption === "earlier";
  const text = isOlder ? t("earlier") : caption;
  setAttributes(image, { alt: text ? `${title}: ${text}` : title, "data-flat": isFlat });
  image.style.aspectRatio = isFlat ? "" : `${columns} / ${rows}`;
  setText(words, text);
  words.hidden = !caption;
  setAttributes(figure, { "data-older": isOlder });
}
