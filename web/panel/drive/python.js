/** Python code that drives the shown agent from a notebook or a script, with a button to copy it. */

/** @import { Panel } from "../panel.js" */
import { button, element, setText } from "../../shared/dom.js";
import { t } from "../../shared/text.js";
import { copyText } from "../run.js";

export class PythonLines {
  #code = element("code");
  element;

  /** @param {Panel} panel */
  constructor(panel) {
    const copy = button(t("Copy"), () => copyText(panel, this.#code.textContent, t("Copied. Paste it into a notebook or a script.")), {
      icon: "copy",
    });
    this.element = element("div", { className: "ai4u-python" }, element("pre", { tabIndex: 0 }, this.#code), copy);
  }

  /** @param {string[] | string} lines */
  update(lines) {
    setText(this.#code, Array.isArray(lines) ? lines.join("\n") : lines);
  }
}
