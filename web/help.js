/** What there is to know about the page, on "?"; and which key does what, to be changed. */

import { element } from "./dom.js";
import { isText } from "./keys.js";
import { label } from "./labels.js";

const PARTS = {
  "The picture": "The world from above. Scroll or pinch to come nearer; Camera in the panel brings all of it back.",
  "The panel": "The time and its speed, and what the agent senses, does and gets for it. On small screens it lies folded at the bottom.",
  "The line beside the keys":
    "Says who drives. Where a network or a script does, take over by driving; “Let go” gives the agent back.",
};
const GAMEPAD = "A gamepad drives too: its left stick or its cross, A to jump, B to leap, Start to restart.";

export class Help {
  #keys;
  #keymap;
  #changed;
  #dialog = element("dialog", { className: "ai4u-help" });
  #goal = element("p", { className: "ai4u-goal" });
  #list = element("div", { className: "ai4u-bindings" });
  #told = element("p", { className: "ai4u-told", role: "status" });
  #reset = element("button", { type: "button", className: "ai4u-plain", textContent: "Reset keys" });
  #learning = null;

  /**
   * @param {HTMLElement} row where its button lies
   * @param {import("./keys.js").HeldKeys} keys
   * @param {import("./keymap.js").KeyMap} keymap
   * @param {() => void} changed called when keys have another meaning
   */
  constructor(row, keys, keymap, changed) {
    this.#keys = keys;
    this.#keymap = keymap;
    this.#changed = changed;
    const button = element("button", {
      type: "button",
      className: "ai4u-ask",
      textContent: "?",
      ariaLabel: "Help",
      title: "Help (?)",
    });
    button.addEventListener("click", () => this.open());
    row.append(button);
    this.#build();
    keys.isAsleep = () => this.#dialog.open; // what is told when it closes comes a moment too late
    document.body.append(this.#dialog);
    addEventListener("keydown", (event) => this.#ask(event), { capture: true });
  }

  /** @param {string} goal of the scene */
  tell(goal) {
    if (this.#goal.textContent !== goal) this.#goal.textContent = goal;
  }

  open() {
    if (this.#dialog.open) return;
    this.#keys.releaseAll();
    this.#told.textContent = "";
    this.#listKeys();
    this.#dialog.showModal(); // it keeps the focus inside, and gives it back
  }

  /** Another agent, or keys that mean something else. */
  refresh() {
    if (this.#dialog.open) this.#listKeys();
  }

  #build() {
    const title = element("h2", { id: "ai4u-help", textContent: "Help" });
    const close = element("button", {
      type: "button",
      className: "ai4u-ask",
      textContent: "✕",
      ariaLabel: "Close",
    });
    close.addEventListener("click", () => this.#dialog.close());
    this.#reset.addEventListener("click", () => {
      this.#keymap.reset();
      this.#say("All keys are as the scene has them.");
    });
    const parts = Object.entries(PARTS).flatMap(([name, text]) => [
      element("dt", { textContent: name }),
      element("dd", { textContent: text }),
    ]);
    this.#dialog.setAttribute("aria-labelledby", title.id);
    this.#dialog.append(
      element("header", {}, title, close),
      element("h3", { textContent: "The goal" }),
      this.#goal,
      element("h3", { textContent: "Keys" }),
      element("p", { textContent: "To change one, click it and press another key." }),
      this.#list,
      this.#told,
      this.#reset,
      element("p", { textContent: GAMEPAD }),
      element("h3", { textContent: "On this page" }),
      element("dl", {}, ...parts),
    );
    this.#dialog.addEventListener("keydown", (event) => this.#learn(event), { capture: true });
    // viser would move its camera
    this.#dialog.addEventListener("keydown", (event) => event.stopPropagation());
    this.#dialog.addEventListener("click", (event) => event.target === this.#dialog && this.#dialog.close());
    this.#dialog.addEventListener("close", () => (this.#learning = null));
  }

  #listKeys() {
    this.#reset.hidden = !this.#keymap.isChanged;
    const focused = document.activeElement?.dataset?.action;
    const rows = Object.entries(this.#keymap.keys).map(([action, codes]) => {
      const isLearning = this.#learning === action;
      const printed = codes.map(label).join(" or ") || "no key";
      const name = this.#keymap.name(action);
      const button = element("button", {
        type: "button",
        className: "ai4u-binding",
        textContent: isLearning ? "Press a key …" : printed,
        ariaLabel: isLearning ? `${name}: press a key` : `${name}: ${printed}. Change`,
        ariaPressed: String(isLearning),
      });
      button.dataset.action = action;
      button.addEventListener("click", () => this.#await(isLearning ? null : action));
      return element("div", {}, element("span", { textContent: name }), button);
    });
    this.#list.replaceChildren(...rows);
    if (focused) this.#list.querySelector(`[data-action="${CSS.escape(focused)}"]`)?.focus();
  }

  #await(action) {
    this.#learning = action;
    this.#told.textContent = "";
    this.#listKeys();
  }

  /** The key after a click on one. */
  #learn(event) {
    const action = this.#learning;
    if (action === null || event.code === "Tab" || event.isComposing) return;
    event.preventDefault(); // Escape would close, Space and Enter press the button
    event.stopPropagation();
    if (event.repeat || ["Control", "Alt", "Meta"].includes(event.key)) return;
    this.#learning = null;
    this.#say(event.code === "Escape" ? "" : this.#keymap.change(action, event.code));
  }

  #say(text) {
    this.#told.textContent = text;
    this.#changed();
    this.#listKeys();
  }

  #ask(event) {
    // a character and not a place: it is where the keyboard says so
    const isAsked = event.key === "?" && !event.ctrlKey && !event.metaKey && !event.altKey;
    if (!isAsked || event.repeat || isText(event.target)) return;
    event.stopPropagation();
    event.preventDefault();
    if (!this.#dialog.open) this.open();
  }
}
