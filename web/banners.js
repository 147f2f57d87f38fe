/**
 * What has happened, in a sentence at the top of the page, with a button that mends it; and the
 * window's title.
 */

import { element } from "./dom.js";

/** Kinds of banners that are whole sentences, and not printed bold. */
const PLAIN = ["error", "task"];
/** How an episode has ended, by the server's word for it: about you, and about an agent by name. */
const OUTCOMES = {
  goal: ["Reached the goal!", "reached the goal!"],
  won: ["You win!", "wins!"],
  lost: ["You lost.", "lost."],
  fell: ["Fell.", "fell."],
  time: ["Time is up."],
  over: ["Episode over."],
};
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
  #drawn = [null, {}];

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
   * @param about.restart what is printed on the key that begins anew
   * @param about.name of the agent, if it is not for this page to drive
   * @param about.isNew whether the person has done nothing yet, and may want to know the goal
   */
  draw(state, about) {
    this.#drawn = [state, about];
    if (state?.title) document.title = state.title;
    const banner = this.#banner(state, about);
    const key = JSON.stringify(banner);
    if (key === this.#shown) return;
    this.#shown = key;
    const [urgent, calm] = banner?.kind === "error" ? [this.#alerts, this.#news] : [this.#news, this.#alerts];
    calm.replaceChildren();
    urgent.replaceChildren(...(banner ? [this.#card(banner)] : []));
  }

  #banner(state, about) {
    if (this.#fatal) return { kind: "error", text: this.#fatal, button: "Reload" };
    if (state?.error) return { kind: "error", text: state.error, button: "Reset" };
    if (this.#complaint) return { kind: "error", text: this.#complaint };
    if (state?.past) return { kind: "paused", text: `Past: ${state.past}`, button: "Back to now" };
    if (state?.outcome) return ending(state, about);
    if (state?.paused) return { kind: "paused", text: "Paused", button: "Resume" };
    if (state?.goal && about.isNew && !about.name) return { kind: "task", text: state.goal };
    return null;
  }

  #card({ kind, text, amount, hint, details, button }) {
    const words = element("p", {}, element(PLAIN.includes(kind) ? "span" : "strong", { textContent: text }));
    if (amount) words.append(" ", element("span", { className: "ai4u-amount", textContent: amount }));
    if (hint) words.append(element("span", { className: "ai4u-hint", textContent: hint }));
    if (details) words.append(element("small", { textContent: details }));
    const card = element("div", { className: "ai4u-banner" }, words);
    card.dataset.kind = kind;
    if (button) {
      const resume = () => this.#order("resume");
      const does = { Reload: () => location.reload(), Resume: resume, "Back to now": resume };
      const press = element("button", { type: "button", className: "ai4u-button", textContent: button });
      press.addEventListener("click", does[button] ?? (() => this.#order("reset")));
      card.append(press);
    }
    return card;
  }
}

function ending({ outcome, reward, terms }, { restart, name }) {
  const [mine, theirs] = OUTCOMES[outcome];
  const parts = Object.entries(terms).filter(([, value]) => Math.abs(value) >= 0.005);
  return {
    kind: outcome === "goal" || outcome === "won" ? "goal" : "over",
    text: name && theirs ? `${name} ${theirs}` : mine,
    amount: signed(reward),
    hint: restart && ` – press ${restart} to try again`,
    details: parts.length > 1 ? parts.map(([name, value]) => `${name} ${signed(value)}`).join(" · ") : "",
    button: "Try again",
  };
}

function signed(value) {
  if (value === null) return "";
  const size = Math.abs(value);
  const digits = size.toLocaleString(undefined, { maximumFractionDigits: size < 10 ? 2 : size < 100 ? 1 : 0 });
  return (value < 0 ? "−" : "+") + digits;
}
