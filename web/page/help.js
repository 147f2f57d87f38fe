/** The help dialog ("?"): the scene's goal, the parts of the page, and the keys, which can be changed. */

import { element } from "../shared/dom.js";
import { t } from "../shared/text.js";
import { isDrawnBySoftware } from "./graphics.js";
import { isTextInput } from "./keys.js";
import { label } from "./labels.js";
import { copyLink } from "../scenes/share.js";

const PAGE_PARTS = {
  [t("The picture")]: t("The world from above. Scroll or pinch to zoom; click Arena to see everything again."),
  [t("The panel")]: t("Time and speed, and what the agent senses, does and is rewarded for. On small screens it is folded at the bottom."),
  [t("The line beside the keys")]: t("Shows who is driving. If a network or script drives, press a drive key to take over; Let go hands it back."),
};
const GAMEPAD_TEXT = t("A gamepad drives too: its left stick or its cross, A to jump, B to jump forward, Start to restart.");

const START_TEXT = t("R tries the same start again. N gives a new start, unless N is a driving key.");
const GRAPHICS_TEXT = t("Drawn without a graphics card, so the picture may be slow. If there is one, turn hardware acceleration on in the browser.");

export class Help {
  #keys;
  #keymap;
  #changed;
  #dialog = element("dialog", { className: "ai4u-help" });
  #goal = element("p", { className: "ai4u-goal" });
  #list = element("div", { className: "ai4u-bindings" });
  #status = element("p", { className: "ai4u-status", role: "status" });
  #graphics = element("p", { hidden: true, textContent: GRAPHICS_TEXT });
  #reset = element("button", { type: "button", className: "ai4u-plain", textContent: t("Reset keys") });
  /**
   * The action whose new key is waited for; null if none is.
   * @type {string | null}
   */
  #actionToRebind = null;

  /**
   * @param {HTMLElement} row parent of the "?" button
   * @param {import("./keys.js").HeldKeys} keys
   * @param {import("./keymap.js").KeyMap} keymap
   * @param {() => void} changed called when a key was rebound
   */
  constructor(row, keys, keymap, changed) {
    this.#keys = keys;
    this.#keymap = keymap;
    this.#changed = changed;
    const button = element("button", {
      type: "button",
      className: "ai4u-round-button",
      textContent: "?",
      ariaLabel: t("Help"),
      title: t("Help (?)"),
    });
    button.addEventListener("click", () => this.open());
    row.prepend(button); // the line beside it changes its length
    this.#build();
    // asked at each key: a dialog's close event comes too late
    keys.isSuspended = () => document.querySelector("dialog:modal") !== null;
    document.body.append(this.#dialog);
    addEventListener("keydown", (event) => this.#openOnQuestionMark(event), { capture: true });
  }

  /** @param {string} goal of the scene */
  setGoal(goal) {
    if (this.#goal.textContent !== goal) this.#goal.textContent = goal;
  }

  open() {
    if (this.#dialog.open) return;
    this.#keys.releaseAll();
    this.#status.textContent = "";
    this.#graphics.hidden = !isDrawnBySoftware();
    this.#listKeys();
    this.#dialog.showModal(); // traps the focus, and restores it on closing
  }

  /** Redraw the list of keys after the agent or its keys have changed. */
  refresh() {
    if (this.#dialog.open) this.#listKeys();
  }

  #build() {
    const title = element("h2", { id: "ai4u-help", textContent: t("Help") });
    const close = element("button", {
      type: "button",
      className: "ai4u-round-button",
      textContent: "✕",
      ariaLabel: t("Close"),
    });
    close.addEventListener("click", () => this.#dialog.close());
    this.#reset.addEventListener("click", () => {
      this.#keymap.reset();
      this.#setStatus(t("Keys reset to the defaults."));
    });
    const share = element("button", { type: "button", className: "ai4u-plain", textContent: t("Copy link") });
    const shared = element("p", { className: "ai4u-shared", role: "status" });
    share.addEventListener("click", async () => (shared.textContent = await copyLink()));
    const descriptions = Object.entries(PAGE_PARTS).flatMap(([name, text]) => [
      element("dt", { textContent: name }),
      element("dd", { textContent: text }),
    ]);
    this.#dialog.setAttribute("aria-labelledby", title.id);
    this.#dialog.append(
      element("header", {}, title, close),
      element("h3", { textContent: t("The goal") }),
      this.#goal,
      element("h3", { textContent: t("Share this scene") }),
      element("p", { textContent: t("The link holds the whole scene and its seed. Nothing is uploaded.") }),
      share,
      element("a", { href: "./start", className: "ai4u-plain", textContent: t("All scenes and lessons") }),
      shared,
      element("h3", { textContent: t("Keys") }),
      element("p", { textContent: t("To change one, click it and press another key.") }),
      this.#list,
      this.#status,
      this.#reset,
      element("p", { textContent: START_TEXT }),
      element("p", { textContent: GAMEPAD_TEXT }),
      element("h3", { textContent: t("On this page") }),
      element("dl", {}, ...descriptions),
      this.#graphics,
    );
    this.#dialog.addEventListener("keydown", (event) => this.#rebind(event), { capture: true });
    // else viser moves its camera
    this.#dialog.addEventListener("keydown", (event) => event.stopPropagation());
    this.#dialog.addEventListener("click", (event) => event.target === this.#dialog && this.#dialog.close());
    this.#dialog.addEventListener("close", () => (this.#actionToRebind = null));
  }

  #listKeys() {
    this.#reset.hidden = !this.#keymap.isChanged;
    const focused = /** @type {HTMLElement | null} */ (document.activeElement)?.dataset?.action;
    const rows = Object.entries(this.#keymap.keys).map(([action, codes]) => {
      const isRebinding = this.#actionToRebind === action;
      const printed = labelsOf(codes);
      const name = this.#keymap.name(action);
      const button = element("button", {
        type: "button",
        className: "ai4u-binding",
        textContent: isRebinding ? t("Press a key …") : printed,
        ariaLabel: isRebinding ? t("{action}: press a key", { action: name }) : t("{action}: {key}. Change", { action: name, key: printed }),
        ariaPressed: String(isRebinding),
      });
      button.dataset.action = action;
      button.addEventListener("click", () => this.#startRebinding(isRebinding ? null : action));
      return element("div", {}, element("span", { textContent: name }), button);
    });
    this.#list.replaceChildren(...rows);
    /** @type {HTMLElement | null} */
    const button = focused && this.#list.querySelector(`[data-action="${CSS.escape(focused)}"]`);
    button?.focus();
  }

  /** @param {string | null} action null to stop waiting for a key */
  #startRebinding(action) {
    this.#actionToRebind = action;
    this.#status.textContent = "";
    this.#listKeys();
  }

  /**
   * Take the key pressed after a click on an action as its new key.
   * @param {KeyboardEvent} event
   */
  #rebind(event) {
    const action = this.#actionToRebind;
    if (action === null || event.code === "Tab" || event.isComposing) return;
    event.preventDefault(); // Escape would close the dialog, Space and Enter press the button
    event.stopPropagation();
    if (event.repeat || ["Control", "Alt", "Meta"].includes(event.key)) return;
    this.#actionToRebind = null;
    this.#setStatus(event.code === "Escape" ? "" : this.#keymap.change(action, event.code));
  }

  /** @param {string} text */
  #setStatus(text) {
    this.#status.textContent = text;
    this.#changed();
    this.#listKeys();
  }

  /** @param {KeyboardEvent} event */
  #openOnQuestionMark(event) {
    // the character, not the key's position: its position depends on the keyboard layout
    const isQuestionMark = event.key === "?" && !event.ctrlKey && !event.metaKey && !event.altKey;
    if (!isQuestionMark || event.repeat || isTextInput(event.target)) return;
    event.stopPropagation();
    event.preventDefault();
    if (!this.#dialog.open) this.open();
  }
}

/**
 * Return the labels of the keys that do the same.
 * @param {string[]} codes
 */
function labelsOf(codes) {
  if (codes.length === 0) return t("no key");
  return codes.map(label).reduce((keys, key) => t("{keys} or {key}", { keys, key }));
}
