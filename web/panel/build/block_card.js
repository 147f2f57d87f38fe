/** A block as a card: switch, order, copy, delete, and its form when it is open. */

/**
 * @import { BlockAddition, BlockForm, BlockRow } from "../../generated/messages.js"
 * @import { Answer } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 */
import { button, element, keyed, setText } from "../../shared/dom.js";
import { t } from "../../shared/text.js";
import { Card } from "../widgets/card.js";
import { Form } from "../widgets/form.js";
import { openGallery } from "./gallery.js";

/** @typedef {HTMLElement & {cards?: Map<string, BlockCard>}} CardList with its cards by block */
/** @typedef {(string | number)[] | null} BlockPath null for no block */

/**
 * @param {BlockPath} one
 * @param {BlockPath} other
 */
const isSamePath = (one, other) => JSON.stringify(one ?? null) === JSON.stringify(other ?? null);

export class BlockCard {
  #panel;
  /** @type {BlockRow} */
  #block = null;
  #summary = element("p", { className: "ai4u-hint-text" });
  #detail = element("p", { className: "ai4u-hint-text ai4u-details-only" });
  #form;
  #tools = element("div", { className: "ai4u-tools", role: "toolbar" });
  /** @type {CardList} */
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
   * @param {BlockForm | null} form of the chosen block, which may be another one
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
    if (isMine) this.#form.update(form.fields);
    this.#showTools(isListed && isOpen, title);
    this.#showParts(children, form);
  }

  /**
   * @param {boolean} isOn
   * @param {string} title
   */
  #switch(isOn, title) {
    return {
      icon: "power",
      label: isOn ? t("Turn off {title}", { title }) : t("Turn on {title}", { title }),
      onClick: () => {
        this.#panel.send("switch_block", { path: this.#block.path, on: !isOn });
      },
    };
  }

  /**
   * @param {boolean} isShown
   * @param {string} title
   */
  #showTools(isShown, title) {
    const { can_up: canUp = true, can_down: canDown = true } = this.#block;
    const tools = [
      { icon: "up", label: t("Move up {title}", { title }), isEnabled: canUp, run: () => this.#move(-1) },
      { icon: "down", label: t("Move down {title}", { title }), isEnabled: canDown, run: () => this.#move(1) },
      { icon: "copy", label: t("Duplicate {title}", { title }), isEnabled: true, run: () => this.#duplicate() },
      { icon: "trash", label: t("Delete {title}", { title }), isEnabled: true, kind: "danger", run: () => this.#remove() },
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

  /**
   * @param {BlockRow[]} children
   * @param {BlockForm | null} form
   */
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
    openGallery(this.#panel, { title: t("Add a {block}", { block: title.toLowerCase() }), kind, parent });
  }

  /** @param {number} by -1 for up, 1 for down */
  #move(by) {
    const { path } = this.#block;
    this.#follow(path, this.#panel.send("move_block", { path, by }));
  }

  #duplicate() {
    const { path } = this.#block;
    this.#follow(path, this.#panel.send("duplicate_block", { path }));
  }

  async #remove() {
    const { path } = this.#block;
    const { ok } = await this.#panel.send("remove_block", { path });
    if (ok && isSamePath(this.#panel.shown.block, path)) this.#panel.show({ block: null });
  }

  /**
   * Choose the block that a command made or moved, unless another one than this was chosen meanwhile.
   * @param {BlockPath} path of this block when the command was sent
   * @param {Promise<Answer & {path?: BlockPath}>} answer
   */
  async #follow(path, answer) {
    const { ok, path: next } = await answer;
    if (ok && next && isSamePath(this.#panel.shown.block, path)) this.#panel.show({ block: next });
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    const by = event.key === "ArrowUp" ? -1 : event.key === "ArrowDown" ? 1 : 0;
    const target = /** @type {Element} */ (event.target);
    const isHead = target.closest(".ai4u-card") === this.element && target.matches("[aria-expanded]");
    if (!event.altKey || !by || !isHead || !(by < 0 ? this.#block.can_up : this.#block.can_down)) return;
    event.preventDefault();
    this.#move(by);
  }
}

/**
 * Make an element's cards match a list of blocks.
 * @param {Panel} panel
 * @param {CardList} parent
 * @param {BlockRow[]} blocks
 * @param {BlockForm | null} form of the chosen block
 */
export function updateCards(panel, parent, blocks, form) {
  parent.cards ??= new Map();
  const { cards } = parent;
  const keyOf = (/** @type {BlockRow} */ { path, class: type }) => `${type} ${JSON.stringify(path)}`;
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
