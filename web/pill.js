/** Who drives, in a line, with a button that changes it. */

import { element } from "./dom.js";

export class Pill {
  #dot = element("span", { className: "ai4u-dot", ariaHidden: "true" });
  #text = element("span");
  #hint = element("span", { className: "ai4u-hint" });
  #take = element("button", { type: "button", className: "ai4u-button", textContent: "Take over" });
  #letGo = element("button", { type: "button", className: "ai4u-button", textContent: "Let go" });

  /**
   * @param {HTMLElement} row where it lies
   * @param {() => void} take called when the person wants to drive
   * @param {() => void} letGo called when the person wants to drive no more
   */
  constructor(row, take, letGo) {
    this.#take.addEventListener("click", take);
    this.#letGo.addEventListener("click", letGo);
    const status = element("span", { role: "status" }, this.#text, this.#hint);
    row.append(element("div", { className: "ai4u-seat" }, this.#dot, status, this.#take, this.#letGo));
  }

  /** @param {string} way how one would take over, in words */
  draw({ connected, hello, seat, way }) {
    const [kind, text] = standing({ connected, hello, seat, way });
    this.#dot.dataset.kind = kind;
    show(this.#text, text);
    show(this.#hint, kind === "auto" ? ` – ${way} to take over` : "");
    this.#take.hidden = kind !== "other" && kind !== "auto";
    this.#letGo.hidden = kind !== "mine" || !(hello.instead || seat.pages > 1);
    this.#letGo.title = hello.instead && `${hello.instead} goes on then`;
  }
}

function show(place, text) {
  if (place.textContent !== text) place.textContent = text; // what is written anew is read out anew
}

function standing({ connected, hello, seat, way }) {
  if (!connected) return ["lost", "Connecting …"];
  if (Object.keys(hello.keys).length === 0) return ["none", `${hello.others || hello.brain} drives`];
  if (hello.others) return ["auto", `${hello.others} drives`];
  if (seat.driver === null) return ["free", `${way[0].toUpperCase()}${way.slice(1)} to drive`];
  if (seat.driver !== hello.you) return ["other", `Page ${seat.driver} drives`];
  return ["mine", seat.pages > 1 ? `You drive (page ${hello.you})` : "You drive"];
}
