/** A block as a card: switch, order, copy, delete, and its form when it is open. */

/**
 * @import { BlockAddition, BlockRow } from "../../generated/messages.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, keyed, setText } from "../../shared/dom.js";
import { Card } from "../widgets/card.js";
import { Form } from "../widgets/form.js";
import { openGallery } from "./gallery.js";

export const isSamePath = (one, other) => JSON.stringify(one ?? null) === JSON.stringify(other ?? null);

export class BlockCard {
  #panel;
  /** @type {BlockRow} */
  #block = null;
  #summary = element("p", { className: "ai4u-hint-text" });
  #detail = element("p", { className: "ai4u-hint-text ai4u-details-only" });
  #form;
  #tools = element("div", { className: "ai4u-tools", role: "toolbar" });
  #parts = element("div", { className: "ai4u-card-list" });
  #adds = element("div", { className: "ai4u-tools" });
  #card;

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    this.#card = new Card({ onToggle: (isOpen) => panel.show({ block: isOpen ? this.#block.path : null }) });
    this.#form = new Form({
      onChange: (values) => panel.send("change_block", { path: this.#block.path, values }),
    });
    this.#form.element.hidden = true;
    this.#card.body.append(this.#summary, this.#detail, this.#form.element, this.#tools, this.#parts, this.#adds);
    this.#card.element.addEventListener("keydown", (event) => this.#onKey(event));
  }

  get element() {
    return this.#card.element;
  }

  /**
   * @param {BlockRow} block
   * @param form the form of the chosen block, which may be another one
   */
  update(block, form) {
    this.#block = block;
    const { path, title, icon, reads, is_on: isOn = true, children = [] } = block;
    const chosen = this.#panel.shown.block;
    const isOpen = isSamePath(chosen, path);
    const holdsChosen = Boolean(chosen) && !isOpen && isSamePath(chosen.slice(0, path.length), path);
    this.#card.update({ icon, title, type: block.class, reads, isOn, isOpen: isOpen || holdsChosen });
    const { can_switch: canSwitch = true, can_remove: isListed = typeof path.at(-1) === "number" } = block;
    this.#card.actions(canSwitch ? [this.#switch(isOn, title)] : []);
    if (!isOpen && !holdsChosen) return;
    const isMine = isOpen && isSamePath(form?.path, path);
    this.#form.element.hidden = !isMine;
    setText(this.#summary, isMine ? (form.summary ?? "") : "");
    setText(this.#detail, isMine ? (form.detail ?? "") : "");
    if (isMine) this.#form.update(form.fields, form.first);
    this.#showTools(isListed && isOpen, title);
    this.#showParts(children, form);
  }

  #switch(isOn, title) {
    return {
      icon: "power",
      label: `Turn ${isOn ? "off" : "on"} ${title}`,
      onClick: () => this.#do("switch_block", { on: !isOn }),
    };
  }

  #showTools(isShown, title) {
    const { can_up: canUp = true, can_down: canDown = true } = this.#block;
    const tools = [
      { icon: "up", label: `Move up ${title}`, isEnabled: canUp, run: () => this.#do("move_block", { by: -1 }) },
      { icon: "down", label: `Move down ${title}`, isEnabled: canDown, run: () => this.#do("move_block", { by: 1 }) },
      { icon: "copy", label: `Duplicate ${title}`, isEnabled: true, run: () => this.#do("duplicate_block") },
      { icon: "trash", label: `Delete ${title}`, isEnabled: true, kind: "danger", run: () => this.#do("remove_block") },
    ];
    this.#tools.ariaLabel = title;
    this.#tools.hidden = !isShown;
    keyed(
      this.#tools,
      isShown ? tools : [],
      ({ label }) => label,
      ({ icon, label, kind = "quiet", run }) => button("", run, { icon, label, kind }),
      (made, { isEnabled }) => {
        made.disabled = !isEnabled;
      },
    );
  }

  #showParts(children, form) {
    updateCards(this.#panel, this.#parts, children, form);
    this.#parts.hidden = children.length === 0;
    const adds = this.#block.adds ?? [];
    keyed(
      this.#adds,
      adds,
      ({ title }) => title,
      (add) => button(add.title, () => this.#addPart(add), { icon: "add", kind: "quiet" }),
    );
    this.#adds.hidden = adds.length === 0;
  }

  /** @param {BlockAddition} addition */
  async #addPart({ title, kind, class: type, parent }) {
    if (type) {
      const added = await this.#panel.send("add_block", { class: type, parent });
      if (added.ok && added.path) this.#panel.show({ block: added.path });
      return;
    }
    openGallery(this.#panel, { title: `Add a ${title.toLowerCase()}`, kind, parent });
  }

  async #do(command, args = {}) {
    const { path } = this.#block;
    const answer = await this.#panel.send(command, { path, ...args });
    if (!answer.ok || !isSamePath(this.#panel.shown.block, path)) return;
    if (command === "remove_block") this.#panel.show({ block: null });
    if (answer.path) this.#panel.show({ block: answer.path });
  }

  #onKey(event) {
    const by = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    const isHead = event.target.closest(".ai4u-card") === this.element && event.target.matches("[aria-expanded]");
    if (!event.altKey || !by || !isHead || !(by < 0 ? this.#block.can_up : this.#block.can_down)) return;
    event.preventDefault();
    this.#do("move_block", { by });
  }
}

/** Make an element's cards match a list of blocks. */
export function updateCards(panel, parent, blocks, form) {
  parent.cards ??= new Map();
  const { cards } = parent;
  const keyOf = ({ path, class: type }) => `${type} ${JSON.stringify(path)}`;
  const keys = new Set(blocks.map(keyOf));
  for (const key of [...cards.keys()]) if (!keys.has(key)) cards.delete(key);
  keyed(
    parent,
    blocks,
    keyOf,
    (block) => {
      const card = new BlockCard(panel);
      cards.set(keyOf(block), card);
      return card.element;
    },
    (_, block) => cards.get(keyOf(block)).update(block, form),
  );
}
