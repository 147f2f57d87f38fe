/** The networks of a scene: what learned, and who drives. */

/**
 * @import { TaughtNetwork, TeachPart } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { button, element, keyed, setText } from "../shared/dom.js";
import { field, showForm } from "../shared/form_dialog.js";
import { Card } from "../panel/widgets/card.js";

const MAX_TITLE_CHARS = 40;

export class Networks {
  #panel;
  /** Cards by the network's number. */
  #cards = /** @type {Map<number, Card>} */ (new Map());
  /** Details below a card's buttons, by the network's number. */
  #details = /** @type {Map<number, Details>} */ (new Map());
  /** Number of the network whose card is open. */
  #open = /** @type {number | null} */ (null);
  /** @type {TeachPart | null} */
  #part = null;
  element = element("div", { className: "ai4u-card-list" });

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
  }

  /** @param {TeachPart} part */
  update(part) {
    this.#part = part;
    keyed(
      this.element,
      part.networks,
      ({ number }) => number,
      (network) => this.#card(network).element,
      (_, network) => this.#draw(network),
    );
  }

  /** @param {TaughtNetwork} network */
  #card({ number }) {
    const card = new Card({
      onToggle: (isOpen) => {
        this.#open = isOpen ? number : null;
        if (this.#part) this.update(this.#part);
      },
    });
    const send = (/** @type {"teach_drive" | "teach_delete"} */ command) => this.#panel.send(command, { network: number });
    card.body.append(
      element(
        "div",
        { className: "ai4u-tools" },
        button("Let it drive", () => send("teach_drive"), { icon: "play", kind: "main" }),
        button("Why?", () => void this.#explain(number), { icon: "rays", title: "Let it drive, and see in Drive why it acts so" }),
        button("Rename", () => void this.#rename(number), { icon: "text" }),
        button("Download", () => void this.#download(number), { icon: "download" }),
        button("Delete", () => send("teach_delete"), { icon: "trash", kind: "danger" }),
      ),
    );
    const details = new Details(this.#panel, number);
    card.body.append(details.element);
    this.#details.set(number, details);
    this.#cards.set(number, card);
    return card;
  }

  /** @param {TaughtNetwork} network */
  #draw(network) {
    const { number, title, how, is_driving: isDriving } = network;
    this.#details.get(number)?.update(network);
    const mark = isDriving ? "drives" : "";
    this.#cards.get(number)?.update({ icon: "network", title, reads: how, mark, isOpen: this.#open === number });
  }

  /** @param {number} number */
  async #explain(number) {
    const { ok } = await this.#panel.send("teach_drive", { network: number });
    if (ok) this.#panel.openTab("drive");
  }

  /** @param {number} number */
  async #rename(number) {
    const network = this.#part?.networks.find((each) => each.number === number);
    const input = element("input", { type: "text", maxLength: MAX_TITLE_CHARS, value: network?.title ?? "", required: true });
    await showForm({ title: "Rename the network", content: [field("Name", input)], yes: "Rename" }, async () => {
      const answer = await this.#panel.send("teach_rename", { network: number, title: input.value }, { quiet: true });
      if (!answer.ok) throw new Error(answer.text);
    });
  }

  /** @param {number} number */
  async #download(number) {
    const { ok, name, data } = await this.#panel.send("teach_download", { network: number }, { quiet: true });
    if (!ok) return;
    const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
    const url = URL.createObjectURL(new Blob([bytes], { type: "application/octet-stream" }));
    element("a", { href: url, download: name }).click();
    URL.revokeObjectURL(url);
  }
}

/** The making of a network in words, and a slider through the episodes of its practice. */
class Details {
  #panel;
  #number;
  #facts = element("ul", { className: "ai4u-teach-remarks" });
  #slider = element("input", { type: "range", min: "0", step: "1", value: "0" });
  #shown = element("output");
  #replays = /** @type {number[]} */ ([]);
  #practice;
  element;

  /**
   * @param {Panel} panel
   * @param {number} number of the network
   */
  constructor(panel, number) {
    this.#panel = panel;
    this.#number = number;
    this.#slider.addEventListener("input", () => this.#name());
    this.#slider.addEventListener("change", () => this.#replay());
    const watch = button("Watch", () => this.#replay(), { icon: "play" });
    const label = element("label", { className: "ai4u-teach-replays" }, element("span", { textContent: "How it got better" }), this.#slider, this.#shown);
    this.#practice = element("div", {}, label, watch);
    this.element = element("div", {}, this.#facts, this.#practice);
  }

  /** @param {TaughtNetwork} network */
  update({ made_at: madeAt, facts, replays }) {
    const made = madeAt ? [`Made on ${new Date(1000 * madeAt).toLocaleString()}.`] : [];
    keyed(
      this.#facts,
      [...made, ...facts],
      (fact) => fact,
      (textContent) => element("li", { textContent }),
    );
    this.#replays = replays;
    this.#practice.hidden = replays.length < 2;
    this.#slider.max = String(Math.max(0, replays.length - 1));
    this.#name();
  }

  #name() {
    const decisions = this.#replays[this.#slider.valueAsNumber] ?? 0;
    const text = decisions === 0 ? "at the beginning" : `after ${decisions.toLocaleString("en")} decisions`;
    setText(this.#shown, text);
    this.#slider.setAttribute("aria-valuetext", text);
  }

  #replay() {
    this.#panel.send("teach_replay", { network: this.#number, decisions: this.#replays[this.#slider.valueAsNumber] }, { quiet: true });
  }
}
