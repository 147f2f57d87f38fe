/** The line that says who drives the agent, with buttons to take over and to let go. */

import { element } from "./dom.js";

export class DriverStatus {
  #dot = element("span", { className: "ai4u-dot", ariaHidden: "true" });
  #text = element("span");
  #hint = element("span", { className: "ai4u-hint" });
  #take = element("button", { type: "button", className: "ai4u-button", textContent: "Take over" });
  #letGo = element("button", { type: "button", className: "ai4u-button", textContent: "Let go" });

  /**
   * @param {HTMLElement} row parent element
   * @param {() => void} take called when the person takes over
   * @param {() => void} letGo called when the person hands control back
   */
  constructor(row, take, letGo) {
    this.#take.addEventListener("click", take);
    this.#letGo.addEventListener("click", letGo);
    const status = element("span", { role: "status" }, this.#text, this.#hint);
    row.append(element("div", { className: "ai4u-driver" }, this.#dot, status, this.#take, this.#letGo));
  }

  /** @param {string} howToDrive what the person has to do to take over, such as "press a key" */
  draw({ connected, hello, control, howToDrive }) {
    const [kind, text] = status({ connected, hello, control, howToDrive });
    this.#dot.dataset.kind = kind;
    setText(this.#text, text);
    setText(this.#hint, kind === "auto" ? ` – ${howToDrive} to take over` : "");
    this.#take.hidden = kind !== "other" && kind !== "auto";
    this.#letGo.hidden = kind !== "mine" || !(hello.instead || control.pages > 1);
    this.#letGo.title = hello.instead && `${hello.instead} goes on then`;
  }
}

function setText(target, text) {
  if (target.textContent !== text) target.textContent = text; // screen readers announce every assignment
}

function status({ connected, hello, control, howToDrive }) {
  if (!connected) return ["lost", "Connecting …"];
  if (Object.keys(hello.keys).length === 0) return ["none", `${hello.others || hello.brain} drives`];
  if (hello.others) return ["auto", `${hello.others} drives`];
  if (control.driver === null) return ["free", `${howToDrive[0].toUpperCase()}${howToDrive.slice(1)} to drive`];
  if (control.driver !== hello.you) return ["other", `Page ${control.driver} drives`];
  return ["mine", control.pages > 1 ? `You drive (page ${hello.you})` : "You drive"];
}
