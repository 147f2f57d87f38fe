/** Overlays of a class: the teacher's blank screen, and a race's countdown. */

import { element, setText } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";

/** Time that "Go!" is shown (ms). */
const GO_MS = 900;
/** Time that its words stay for screen readers (ms). */
const GO_WORDS_MS = 3000;
const GO = t("Go!");

/** A screen that hides the page, and keeps focus and keys, until the teacher ends it. */
export class BlankScreen {
  #message = element("p", { className: "ai4u-blank-message", id: "ai4u-blank-message" });
  #time = element("p", { className: "ai4u-blank-time", role: "timer" });
  #dialog = element("dialog", { className: "ai4u-blank", role: "alertdialog", tabIndex: -1 });
  #isWanted = false;

  constructor() {
    const title = element("h1", { id: "ai4u-blank-title", textContent: t("Look at your teacher") });
    this.#dialog.append(title, this.#message, this.#time);
    this.#dialog.setAttribute("aria-labelledby", title.id);
    this.#dialog.setAttribute("aria-describedby", this.#message.id);
    this.#dialog.addEventListener("cancel", (event) => event.preventDefault());
    this.#dialog.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key === "Tab" || event.key === "Escape") event.preventDefault(); // nothing else can have the focus
    });
    // a browser may let a second Escape through
    this.#dialog.addEventListener("close", () => this.#isWanted && this.#open());
    document.body.append(this.#dialog);
  }

  /** @param {{message: string, left: string} | null} blank the message and the time left; null ends it */
  draw(blank) {
    this.#isWanted = blank !== null;
    if (blank === null) {
      if (this.#dialog.open) this.#dialog.close();
      return;
    }
    setText(this.#message, blank.message);
    setText(this.#time, blank.left);
    if (!this.#dialog.open) this.#open();
  }

  #open() {
    // a dialog that is opened later would lie above it
    for (const other of /** @type {NodeListOf<HTMLDialogElement>} */ (document.querySelectorAll("dialog:modal"))) other.close();
    this.#dialog.showModal();
    this.#dialog.focus();
  }
}

/**
 * Hide the page of somebody who is not in the class any more, and lead to the page on which one joins.
 * @param {string} reason
 */
export function showLeft(reason) {
  if (document.querySelector(".ai4u-left")) return;
  const title = element("h1", { id: "ai4u-left-title", textContent: t("This world is closed for you now") });
  const words = `${reason.charAt(0).toUpperCase()}${reason.slice(1)}.`.replace(/\.+$/, ".");
  const message = element("p", { className: "ai4u-blank-message", textContent: words });
  const link = element("a", { className: "ai4u-button", href: "../../", textContent: t("To the class’s start page") });
  const dialog = element("dialog", { className: "ai4u-blank ai4u-left" }, title, message, link);
  dialog.setAttribute("aria-labelledby", title.id);
  dialog.addEventListener("cancel", (event) => event.preventDefault());
  document.body.append(dialog);
  for (const other of /** @type {NodeListOf<HTMLDialogElement>} */ (document.querySelectorAll("dialog:modal"))) other.close();
  dialog.showModal();
}

/** The seconds before a race, large above the world. */
export class RaceCountdown {
  #number = element("div", { className: "ai4u-countdown", ariaHidden: "true", hidden: true });
  #words = element("div", { className: "ai4u-hidden-text", role: "status" });
  #wasCounting = false;

  constructor() {
    document.body.append(this.#number, this.#words);
  }

  get isShown() {
    return !this.#number.hidden;
  }

  /** @param {number} ms time to the start; negative after it */
  draw(ms) {
    const isCounting = ms > 0;
    const isGo = !isCounting && ms > -GO_MS && (this.#wasCounting || this.isShown);
    if (isCounting && !this.#wasCounting) setText(this.#words, tn("A race starts in {n} second", "A race starts in {n} seconds", Math.ceil(ms / 1000)));
    if (isGo && this.#words.textContent !== GO) {
      setText(this.#words, GO);
      setTimeout(() => this.#wasCounting || setText(this.#words, ""), GO_WORDS_MS);
    }
    this.#wasCounting = isCounting;
    this.#number.hidden = !(isCounting || isGo);
    setText(this.#number, isCounting ? String(Math.ceil(ms / 1000)) : GO);
  }
}
