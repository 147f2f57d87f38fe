/** What has happened, in a sentence at the top of the page, with a button that mends it. */

import { element } from "./dom.js";

/** How long a complaint stays (ms). */
const STAYS = 8000;

export class Banners {
  #order;
  #news = element("div", { className: "ai4u-banners", role: "status" });
  #alerts = element("div", { className: "ai4u-banners", role: "alert" });
  #shown = "";
  #fatal = "";
  #complaint = "";
  #timer = 0;
  #drawn = [null, ""];

  /** @param {(name: string) => void} order called with the name of a command */
  constructor(order) {
    this.#order = order;
    document.body.append(this.#news, this.#alerts);
  }

  /** The server will not have us; nothing but a new page helps. Empty takes it back. */
  fatal(reason) {
    this.#fatal = reason;
  }

  /** Something that was asked for could not be done. */
  complain(text) {
    this.#complaint = text;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.#complaint = "";
      this.draw(...this.#drawn);
    }, STAYS);
  }

  /**
   * @param state what the server told last; null while it is away
   * @param {string} restart what is printed on the key that begins anew
   */
  draw(state, restart) {
    this.#drawn = [state, restart];
    const banner = this.#banner(state, restart);
    const key = JSON.stringify(banner);
    if (key === this.#shown) return;
    this.#shown = key;
    const [urgent, calm] = banner?.kind === "error" ? [this.#alerts, this.#news] : [this.#news, this.#alerts];
    calm.replaceChildren();
    urgent.replaceChildren(...(banner ? [this.#card(banner)] : []));
  }

  #banner(state, restart) {
    if (this.#fatal) return { kind: "error", text: this.#fatal, button: "Reload" };
    if (state?.error) return { kind: "error", text: state.error, button: "Reset" };
    if (this.#complaint) return { kind: "error", text: this.#complaint };
    if (state?.terminated || state?.truncated) return ending(state, restart);
    if (state?.paused) return { kind: "paused", text: "Paused", button: "Resume" };
    return null;
  }

  #card({ kind, text, amount, hint, details, button }) {
    const words = element("p", {}, element(kind === "error" ? "span" : "strong", { textContent: text }));
    if (amount) words.append(" ", element("span", { className: "ai4u-amount", textContent: amount }));
    if (hint) words.append(element("span", { className: "ai4u-hint", textContent: hint }));
    if (details) words.append(element("small", { textContent: details }));
    const card = element("div", { className: "ai4u-banner" }, words);
    card.dataset.kind = kind;
    if (button) {
      const does = { Reload: () => location.reload(), Resume: () => this.#order("resume") };
      const press = element("button", { type: "button", className: "ai4u-button", textContent: button });
      press.addEventListener("click", does[button] ?? (() => this.#order("reset")));
      card.append(press);
    }
    return card;
  }
}

function ending({ fallen, truncated, reward, terms }, restart) {
  const text = fallen ? "Fell." : truncated ? "Time is up." : reward > 0 ? "Reached the goal!" : "Episode over.";
  const parts = Object.entries(terms).filter(([, value]) => Math.abs(value) >= 0.005);
  return {
    kind: reward > 0 && !fallen ? "goal" : "over",
    text,
    amount: signed(reward),
    hint: restart && ` – press ${restart} to try again`,
    details: parts.length > 1 ? parts.map(([name, value]) => `${name} ${signed(value)}`).join(" · ") : "",
    button: "Try again",
  };
}

function signed(value) {
  if (value === null) return "";
  const size = Math.abs(value);
  const digits = size.toLocaleString(undefined, { maximumFractionDigits: size < 10 ? 2 : 1 });
  return (value < 0 ? "−" : "+") + digits;
}
