/** Maps over the floor: arrows for what the agent would do at each place, colours for what it is worth. */

/**
 * @import { MapProgress, MapsPart, ValueMap } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, setText } from "../../shared/dom.js";
import { number, seconds } from "../../shared/numbers.js";
import { t } from "../../shared/text.js";
import { choice, howComputed, toggle } from "../widgets/parts.js";

const AS_NOW = "";
const TURNS = [
  { text: t("turns left"), kind: "left" },
  { text: t("goes straight"), kind: "straight" },
  { text: t("turns right"), kind: "right" },
];

/** @typedef {"field" | "values"} MapKind */

export class Maps {
  #panel;
  #facing = AS_NOW;
  #isOn = { field: false, values: false };
  #switches = {
    field: toggle(t("Arrows: where it would go"), (isOn) => this.#turn("field", isOn)),
    values: toggle(t("Colours: good and bad places"), (isOn) => this.#turn("values", isOn)),
  };
  #faced = choice(t("Facing"), (name) => this.#face(name));
  #problem = element("p", { className: "ai4u-map-problem", hidden: true });
  #field = new Progress(t("Arrows"), () => this.#cancel("field"));
  #values = new Progress(t("Values"), () => this.#cancel("values"));
  #turns = element("ul", { className: "ai4u-map-turns", ariaLabel: t("Arrows") }, ...TURNS.map(turnItem));
  #low = element("span");
  #high = element("span");
  #ramp = element("i", { ariaHidden: "true" });
  #scale = element("p", { className: "ai4u-map-scale" }, this.#low, this.#ramp, this.#high);
  #worth = element("p", { className: "ai4u-soft", textContent: t("Yellow: starting here ends well. Blue: it ends badly.") });
  /** The source of the colours' numbers. */
  #source = element("p", { className: "ai4u-soft" });
  #how = howComputed(this.#source);
  #moment = element("p", { className: "ai4u-soft" });
  #result = element(
    "div",
    { className: "ai4u-maps", hidden: true },
    this.#faced.element,
    this.#problem,
    this.#field.element,
    this.#turns,
    this.#values.element,
    this.#scale,
    this.#worth,
    this.#moment,
    this.#how,
  );
  element = element("div", {}, this.#switches.field.element, this.#switches.values.element, this.#result);

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#clear();
    panel.addEventListener("part:maps", ({ detail }) => this.#draw(detail));
    panel.addEventListener("agent", () => this.#clear());
    // a new connection has a new page on the server, which shows nothing yet
    panel.addEventListener("connected", () => this.#isAnyOn && this.#send());
  }

  get #isAnyOn() {
    return this.#isOn.field || this.#isOn.values;
  }

  /**
   * @param {MapKind} kind
   * @param {boolean} isOn
   */
  #turn(kind, isOn) {
    this.#isOn[kind] = isOn;
    this.#clear();
    this.#send();
  }

  /** @param {MapKind} kind */
  #cancel(kind) {
    this.#switches[kind].set(false);
    this.#switches[kind].element.focus();
    this.#turn(kind, false);
  }

  /** @param {string} name of a thing; AS_NOW for none */
  #face(name) {
    this.#facing = name;
    this.#clear();
    this.#send();
  }

  async #send() {
    const answer = await this.#panel.send("maps", { ...this.#isOn, facing: this.#facing }, { quiet: true });
    if (answer.ok) return;
    this.#isOn = { field: false, values: false };
    for (const { set } of Object.values(this.#switches)) set(false);
    this.#clear();
  }

  /** Show nothing until something is known. */
  #clear() {
    this.#result.hidden = !this.#isAnyOn;
    this.#problem.hidden = true;
    this.#drawField(null);
    this.#drawValues(null);
    setText(this.#moment, "");
  }

  /** @param {MapsPart} part */
  #draw(part) {
    if (!this.#isAnyOn || part.agent !== this.#panel.shown.agent) return;
    this.#problem.hidden = !part.problem;
    setText(this.#problem, part.problem);
    // what was chosen stays in the list, also where the next scene has no such thing
    const names = [...new Set([...part.faced, this.#facing])].filter((name) => name !== AS_NOW);
    const options = [{ value: AS_NOW, text: t("same as now") }, ...names.map((value) => ({ value, text: t("the {thing}", { thing: value }) }))];
    this.#faced.element.hidden = names.length === 0;
    this.#faced.set(options, this.#facing);
    this.#drawField(part.field);
    this.#drawValues(part.values);
    const shown = part.field ?? part.values;
    setText(this.#moment, shown ? momentWords(shown.seconds) : "");
  }

  /** @param {MapProgress | null} field */
  #drawField(field) {
    const isOn = this.#isOn.field && Boolean(this.#problem.hidden);
    this.#field.draw(isOn, field);
    this.#turns.hidden = !isOn || !field;
  }

  /** @param {ValueMap | null} values */
  #drawValues(values) {
    const isOn = this.#isOn.values && Boolean(this.#problem.hidden);
    this.#values.draw(isOn, values);
    const hasScale = isOn && typeof values?.low === "number";
    this.#scale.hidden = this.#worth.hidden = this.#how.hidden = !hasScale;
    if (!hasScale) return;
    setText(this.#low, number(values.low));
    setText(this.#high, number(values.high));
    this.#ramp.style.background = `linear-gradient(to right, ${values.colours.join(", ")})`;
    setText(this.#source, values.words);
  }
}

/** The progress of a map, with a button to cancel it; nothing once it is complete. */
class Progress {
  #bar;
  #words = element("span");
  element;

  /**
   * @param {string} name
   * @param {() => void} onCancel
   */
  constructor(name, onCancel) {
    this.#bar = element("progress", { ariaLabel: name });
    const cancel = button(t("Cancel"), onCancel, { kind: "quiet", label: t("Cancel: {map}", { map: name.toLowerCase() }) });
    this.element = element("div", { className: "ai4u-map-progress", hidden: true }, this.#bar, this.#words, cancel);
  }

  /**
   * @param {boolean} isOn
   * @param {MapProgress | null} map null before anything of it is known
   */
  draw(isOn, map) {
    this.element.hidden = !isOn || Boolean(map && map.done >= map.count);
    if (this.element.hidden) return;
    if (map) {
      this.#bar.max = map.count;
      this.#bar.value = map.done;
    } else this.#bar.removeAttribute("value");
    setText(this.#words, map ? t("{done} of {count} places", { done: map.done, count: map.count }) : t("Starting …"));
  }
}

/** @param {typeof TURNS[number]} turn */
function turnItem({ text, kind }) {
  return element("li", { dataset: { turn: kind } }, element("i", { ariaHidden: "true" }), text);
}

/** @param {number} time (s) */
function momentWords(time) {
  return t("We put a resting robot on each spot and ask what it would do. Everything else stays as it is now ({time}).", { time: seconds(time) });
}
