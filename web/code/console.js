/** Output of a program, with the number of the decision; the oldest lines go. */

import { element } from "../shared/dom.js";
import { t } from "../shared/text.js";
import { section } from "../panel/widgets/parts.js";

const MAX_LINES = 200;
const MAX_LINE_CHARS = 2000;

/** @typedef {{number: number | "", line: string}} Line with the number of its decision, or none */

export class CodeConsole {
  #lines = element("ol");
  /** A role of its own would take the list's, and with it the meaning of its items. */
  #log = element("div", { className: "ai4u-code-output", role: "log", ariaLabel: t("Output"), tabIndex: 0 }, this.#lines);
  #none = element("p", { className: "ai4u-hint-text", textContent: t("What your program prints appears here.") });
  /** @type {Line[]} */
  #waiting = [];
  element = section("code-output", t("Output"), {}, this.#none, this.#log);

  constructor() {
    this.clear();
  }

  clear() {
    this.#waiting.length = 0;
    this.#lines.replaceChildren();
    this.#show();
  }

  /**
   * Add what a decision printed.
   * @param {number} number of the decision; 0 is before the first one
   * @param {string} text
   */
  add(number, text) {
    const lines = text.replace(/\n$/, "").split("\n").slice(-MAX_LINES);
    lines.forEach((line, index) => this.#waiting.push({ number: index ? "" : number || "", line: line.slice(0, MAX_LINE_CHARS) }));
    if (this.#waiting.length === lines.length) requestAnimationFrame(() => this.#flush());
  }

  #flush() {
    const list = this.#lines;
    const log = this.#log;
    const isAtEnd = log.scrollTop + log.clientHeight >= log.scrollHeight - 4;
    list.append(...this.#waiting.splice(0).slice(-MAX_LINES).map(lineElement));
    while (list.childElementCount > MAX_LINES) list.firstElementChild.remove();
    this.#show();
    if (isAtEnd) log.scrollTop = log.scrollHeight;
  }

  #show() {
    const isEmpty = !this.#lines.childElementCount;
    this.#none.hidden = !isEmpty;
    this.#log.hidden = isEmpty;
  }
}

/** @param {Line} line */
function lineElement({ number, line }) {
  return element("li", {}, element("b", { textContent: number }), element("span", { textContent: line || " " }));
}
