/** The line that says who drives the agent, with buttons to take over and to let go. */

/** @import { HelloEvent, SeatEvent } from "../generated/messages.js" */
import { element, setText } from "../shared/dom.js";
import { t } from "../shared/text.js";

/**
 * @typedef {object} DriverView who drives, and what a person has to know to drive
 * @property {boolean} connected
 * @property {Omit<HelloEvent, "type">} hello the server's first message
 * @property {Omit<SeatEvent, "type"> & {name?: string}} control who drives
 * @property {string} howToDrive what the person has to do to take over, such as "press a key"
 * @property {boolean} isPaused true while the world is paused
 * @property {boolean} isWaiting true while the world waits for a key
 * @property {boolean} isHeld true while a teacher holds the world
 * @property {boolean} isReached false while the keyboard goes elsewhere, such as into a text field
 */

export class DriverStatus {
  #dot = element("span", { className: "ai4u-dot", ariaHidden: "true" });
  #text = element("span");
  #hint = element("span", { className: "ai4u-hint" });
  #take = element("button", { type: "button", className: "ai4u-button", textContent: t("Take over") });
  #letGo = element("button", { type: "button", className: "ai4u-button", textContent: t("Let go") });

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

  /** @param {DriverView} view */
  draw(view) {
    const { connected, hello, control, howToDrive, isPaused, isHeld } = view;
    const [kind, who] = status(view);
    // whoever drives, no key and no stick moves anything now
    const isStill = connected && isPaused && !isHeld;
    this.#dot.dataset.kind = kind;
    setText(this.#text, isStill ? t("Paused") : who);
    setText(this.#hint, kind === "auto" && !isStill ? " – " + t("{what} to take over", { what: howToDrive }) : "");
    this.#take.hidden = kind !== "other" && kind !== "auto";
    this.#letGo.hidden = kind !== "mine" || !(hello.instead || control.pages > 1);
    this.#letGo.title = hello.instead && t("{driver} goes on then", { driver: hello.instead });
  }
}

/**
 * Return a text with a capital first letter.
 * @param {string} text
 */
export function capitalized(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/**
 * Return the kind of the driver, and what the line says.
 * @param {DriverView} view
 */
function status({ connected, hello, control, howToDrive, isWaiting, isHeld, isReached }) {
  if (!connected) return ["lost", t("Connecting …")];
  if (isHeld) return ["none", t("The world stands still")];
  if (Object.keys(hello.keys).length === 0) return ["none", t("{driver} drives", { driver: hello.others || hello.brain })];
  const isMine = control.driver === hello.you;
  if (hello.others) return ["auto", t("{driver} drives", { driver: hello.others })];
  if (!isReached && (isMine || control.driver === null)) return [isMine ? "mine" : "free", t("Click the picture to drive")];
  if (isWaiting && (isMine || control.driver === null)) return [isMine ? "mine" : "free", t("{what} to start", { what: capitalized(howToDrive) })];
  if (control.driver === null) return ["free", t("{what} to drive", { what: capitalized(howToDrive) })];
  if (!isMine) return ["other", control.name ? t("{driver} drives", { driver: control.name }) : t("Another page drives")];
  return ["mine", t("You're driving")];
}
