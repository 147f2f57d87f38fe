/** The networks of a scene: what learned, and who drives. */

/**
 * @import { TaughtNetwork, TeachPart } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { button, element, keyed } from "../shared/dom.js";
import { field, showForm } from "../shared/form_dialog.js";
import { Card } from "../panel/widgets/card.js";

const MAX_TITLE_CHARS = 40;

export class Networks {
  #panel;
  /** Cards by the network's number. */
  #cards = /** @type {Map<number, Card>} */ (new Map());
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
        button("Rename", () => void this.#rename(number), { icon: "text" }),
        button("Download", () => void this.#download(number), { icon: "download" }),
        button("Delete", () => send("teach_delete"), { icon: "trash", kind: "danger" }),
      ),
    );
    this.#cards.set(number, card);
    return card;
  }

  /** @param {TaughtNetwork} network */
  #draw({ number, title, how, is_driving: isDriving }) {
    const mark = isDriving ? "drives" : "";
    this.#cards.get(number)?.update({ icon: "network", title, reads: how, mark, isOpen: this.#open === number });
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
