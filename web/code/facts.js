/** Lists beside a program: what the agent senses and can do, and the variables of the latest decision. */

/** @import { Names } from "./start.js" */

import { element, keyed, setText } from "../shared/dom.js";
import { section } from "../panel/widgets/parts.js";

/** @typedef {{code: string, words: string}} Item */

/** Names to put into the program by a click. */
export class NameList {
  #readings = element("ul", { className: "ai4u-code-names" });
  #outputs = element("ul", { className: "ai4u-code-names" });
  #onChoose;
  element = section(
    "code-names",
    "Senses and actions",
    {},
    element("h4", { textContent: "It senses" }),
    this.#readings,
    element("h4", { textContent: "It can do" }),
    this.#outputs,
  );

  /** @param {(code: string) => void} onChoose called with the code of a name that is clicked */
  constructor(onChoose) {
    this.#onChoose = onChoose;
  }

  /** @param {Names} names */
  update({ readings, outputs }) {
    this.#fill(this.#readings, readings.map(({ key, words }) => ({ code: `percept["${key}"]`, words })));
    this.#fill(this.#outputs, outputs.map(({ name, words }) => ({ code: `"${name}"`, words })));
  }

  /**
   * @param {HTMLElement} list
   * @param {Item[]} items
   */
  #fill(list, items) {
    const make = (/** @type {Item} */ { code }) => {
      const insert = element("button", { type: "button", title: `Insert ${code}` }, element("code", { textContent: code }));
      insert.addEventListener("click", () => this.#onChoose(code));
      return element("li", {}, insert, element("span"));
    };
    keyed(list, items, ({ code }) => code, make, (item, { words }) => setText(item.lastChild, words));
  }
}

/** The variables at the end of the latest decision. */
export class VariableList {
  #list = element("dl", { className: "ai4u-code-variables" });
  element = section("code-variables", "Variables", {}, this.#list);

  constructor() {
    this.update({});
  }

  /** @param {Record<string, string>} variables texts by name */
  update(variables) {
    const items = Object.entries(variables);
    this.element.hidden = items.length === 0;
    const make = (/** @type {[string, string]} */ [name]) => element("div", {}, element("dt", { textContent: name }), element("dd"));
    keyed(this.#list, items, ([name]) => name, make, (item, [, text]) => setText(item.lastChild, text));
  }
}
