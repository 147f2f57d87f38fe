/** A card that folds out: a block, a body or an episode, with small buttons for what can be done with it. */

import { button, element, keyed, setAttributes, setText } from "../../shared/dom.js";
import { icon } from "../../shared/icons.js";
import { freeId } from "../../shared/ids.js";
import { t } from "../../shared/text.js";

export class Card {
  #onToggle;
  #icon = element("span", { className: "ai4u-card-icon" });
  #title = element("strong");
  #type = element("code", { className: "ai4u-details-only" });
  #reads = element("span", { className: "ai4u-card-reads" });
  #mark = element("span", { className: "ai4u-card-mark" });
  #head;
  #actions = element("div", { className: "ai4u-card-actions" });
  #iconName = "";
  /** Content of the open card. */
  body = element("div", { className: "ai4u-card-body", id: freeId(), hidden: true });
  element = element("article", { className: "ai4u-card" });

  /**
   * @param {object} [options]
   * @param {(isOpen: boolean) => void} [options.onToggle] called with true when the person opens it, and with false when they
   *   close it
   */
  constructor({ onToggle = () => {} } = {}) {
    this.#onToggle = onToggle;
    const words = element("span", { className: "ai4u-card-words" }, this.#title, this.#type, this.#reads);
    this.#head = element(
      "button",
      { type: "button", className: "ai4u-card-head" },
      this.#icon,
      words,
      this.#mark,
      icon("down", 14),
    );
    setAttributes(this.#head, { "aria-expanded": "false", "aria-controls": this.body.id });
    this.#head.addEventListener("click", () => this.#onToggle(Boolean(this.body.hidden)));
    const row = element("div", { className: "ai4u-card-row" }, this.#head, this.#actions);
    this.element.append(row, this.body);
  }

  /**
   * @param {object} state
   * @param {string} [state.icon] its name
   * @param {string} state.title
   * @param {string} [state.type] the class's name, shown in Details
   * @param {string} [state.reads] what it reads or does just now, short
   * @param {boolean} [state.isOn]
   * @param {boolean} [state.isOpen]
   * @param {string} [state.mark] a short remark such as "off" or "best"
   */
  update({ icon: name = "own", title, type = "", reads = "", isOn = true, isOpen = false, mark = "" }) {
    if (name !== this.#iconName) this.#icon.replaceChildren(icon((this.#iconName = name)));
    setText(this.#title, title);
    setText(this.#type, type);
    setText(this.#reads, reads);
    setText(this.#mark, mark || (isOn ? "" : t("off")));
    setAttributes(this.element, { "data-off": !isOn, "data-open": isOpen });
    setAttributes(this.#head, { "aria-expanded": isOpen ? "true" : "false" });
    this.body.hidden = !isOpen;
  }

  /** @param {{icon: string, label: string, isEnabled?: boolean, isDanger?: boolean, onClick: () => void}[]} list */
  actions(list) {
    keyed(
      this.#actions,
      list,
      (action) => action.label,
      (action) => {
        const { icon: name, label, isDanger = false } = action;
        return button("", () => {}, { icon: name, label, kind: isDanger ? "danger" : "quiet" });
      },
      (made, { onClick, isEnabled = true }) => {
        made.onclick = onClick;
        if (made.disabled === isEnabled) made.disabled = !isEnabled;
      },
    );
  }
}
