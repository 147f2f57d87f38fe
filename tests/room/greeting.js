/** The tab "Greeting". */

import { button, element } from "../shared/dom.js";

export class Tab {
  #text = element("p");

  constructor(root, panel) {
    root.append(button("Say hello", () => panel.send("greet", { who: "browser" })), this.#text);
  }

  update(part) {
    this.#text.textContent = `The world said: ${part.text}`;
  }
}
