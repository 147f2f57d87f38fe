/** A thing of the world as a card: its form when it is chosen, copy and delete. */

/**
 * @import { SceneThing, ThingForm } from "../../generated/messages.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element } from "../../shared/dom.js";
import { t } from "../../shared/text.js";
import { Card } from "../widgets/card.js";
import { Form } from "../widgets/form.js";
import { choose, duplicateSelected, removeSelected, selected } from "./selection.js";

/** @type {Record<string, string>} */
const KIND_ICONS = { area: "area", picture: "area", floor: "floor", lamp: "lamp", agent: "agent" };
/** @type {Record<string, string>} */
const KIND_WORDS = { area: t("area"), picture: t("picture"), floor: t("floor"), lamp: t("lamp"), agent: t("agent") };
/** @type {Record<string, string>} */
const SHAPE_ICONS = { circle: "ball", segment: "wall", capsule: "wall", ring: "target" };

export class BodyCard {
  #panel;
  #name = "";
  #card;
  #form;
  #delete;
  #copy;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#card = new Card({ onToggle: (isOpen) => choose(panel, isOpen ? this.#name : null) });
    this.#form = new Form({ onChange: (values) => panel.send("change_body", { name: this.#name, values }) });
    this.#copy = button(t("Duplicate"), () => duplicateSelected(panel), { icon: "copy", kind: "quiet" });
    this.#delete = button(t("Delete"), () => removeSelected(panel), { icon: "trash", kind: "danger" });
    const tools = element("div", { className: "ai4u-tools" }, this.#copy, this.#delete);
    this.#card.body.append(this.#form.element, tools);
  }

  get element() {
    return this.#card.element;
  }

  /**
   * @param {SceneThing} body
   * @param {ThingForm | null} form of the selected thing, which may be another one
   */
  update(body, form) {
    const { name, kind, shape, x, y, is_random: isRandom } = body;
    this.#name = name;
    const isOpen = this.#panel.shown.body === name;
    const place = isRandom ? t("random place") : `${metres(x)}, ${metres(y)}`;
    const reads = kind in KIND_WORDS ? `${KIND_WORDS[kind]}, ${place}` : place;
    const icon = KIND_ICONS[kind] ?? SHAPE_ICONS[shape] ?? "box";
    this.#card.element.toggleAttribute("data-selected", selected(this.#panel).includes(name));
    this.#card.update({ icon, title: name, type: shape, reads, isOpen });
    const isMine = isOpen && form?.name === name;
    this.#form.element.hidden = !isMine;
    if (isMine) this.#form.update(form.fields);
    this.#copy.title = t("Duplicate {title}", { title: name });
    this.#delete.title = t("Delete {title}", { title: name });
  }
}

/** @param {number} value */
function metres(value) {
  return `${Number(value ?? 0).toFixed(1)} m`;
}
