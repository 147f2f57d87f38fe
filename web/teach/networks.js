/** The networks of a scene: what learned, and who drives. */

/**
 * @import { TaughtNetwork, TeachPart } from "../generated/messages.js"
 * @import { Panel } from "../panel/panel.js"
 */
import { handIns, showHandIn } from "../classroom/student/hand_in_dialog.js";
import { ask } from "../shared/dialog.js";
import { button, element, keyed, setText, tableHead } from "../shared/dom.js";
import { field, showForm } from "../shared/form_dialog.js";
import { percent, sizeProblem } from "../shared/numbers.js";
import { t, whole } from "../shared/text.js";
import { Card } from "../panel/widgets/card.js";
import { choice } from "../panel/widgets/parts.js";

const MAX_TITLE_CHARS = 40;

export class Networks {
  #panel;
  /** Cards by the network's number. */
  #cards = /** @type {Map<number, Card>} */ (new Map());
  /** Details below a card's buttons, by the network's number. */
  #details = /** @type {Map<number, Details>} */ (new Map());
  /** Buttons that hand in, by the network's number: shown in a class alone. */
  #handIns = /** @type {Map<number, HTMLButtonElement>} */ (new Map());
  /** Number of the network whose card is open. */
  #open = /** @type {number | null} */ (null);
  /** @type {TeachPart | null} */
  #part = null;
  #list = element("div", { className: "ai4u-card-list" });
  #file = element("input", { type: "file", accept: ".onnx", hidden: true });
  #opener = button(t("Open a file"), () => this.#file.click(), { icon: "open" });
  #opening = element("p", { role: "status" });
  element = element("div", { className: "ai4u-networks" }, this.#list, element("div", { className: "ai4u-tools" }, this.#opener, this.#file), this.#opening);

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    handIns.addEventListener("change", () => this.#part && this.update(this.#part));
    this.#file.addEventListener("change", () => {
      const [file] = this.#file.files;
      this.#file.value = ""; // the same file can be chosen again
      if (file) void this.#openFile(file);
    });
  }

  /** @param {TeachPart} part */
  update(part) {
    this.#part = part;
    setText(this.#opening, part.opening);
    this.#opening.hidden = !part.opening;
    this.#opener.disabled = part.opening !== "";
    keyed(
      this.#list,
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
    const handIn = button(t("Hand in"), () => void this.#handIn(number), { icon: "upload", title: t("Hand in this network for a tournament of the class") });
    card.body.append(
      element(
        "div",
        { className: "ai4u-tools" },
        button(t("Let it drive"), () => this.#panel.send("teach_drive", { network: number }), { icon: "play", kind: "main" }),
        button(t("Why?"), () => void this.#explain(number), { icon: "rays", title: t("Let it drive, and see in Drive why it acts so") }),
        button(t("Rename"), () => void this.#rename(number), { icon: "text" }),
        button(t("Download"), () => void this.#download(number), { icon: "download" }),
        handIn,
        button(t("Compare"), () => void this.#compare(number), { icon: "race" }),
        button(t("Delete"), () => void this.#delete(number), { icon: "trash", kind: "danger" }),
      ),
    );
    const details = new Details(this.#panel, number);
    card.body.append(details.element);
    this.#handIns.set(number, handIn);
    this.#details.set(number, details);
    this.#cards.set(number, card);
    return card;
  }

  /** @param {TaughtNetwork} network */
  #draw(network) {
    const { number, title, how, is_driving: isDriving } = network;
    this.#details.get(number)?.update(network);
    this.#handIns.get(number).hidden = !handIns.isOpen();
    const mark = isDriving ? t("drives") : "";
    this.#cards.get(number)?.update({ icon: "network", title, reads: how, mark, isOpen: this.#open === number });
  }

  /** @param {number} number */
  async #explain(number) {
    const { ok } = await this.#panel.send("teach_drive", { network: number });
    if (ok) this.#panel.openTab("drive");
  }

  /** @param {number} number */
  async #rename(number) {
    const { title } = this.#network(number);
    const input = element("input", { type: "text", maxLength: MAX_TITLE_CHARS, value: title, required: true });
    await showForm({ title: t("Rename the network"), content: [field(t("Name"), input)], yes: t("Rename") }, async () => {
      const answer = await this.#panel.send("teach_rename", { network: number, title: input.value }, { quiet: true });
      if (!answer.ok) throw new Error(answer.text);
    });
  }

  /** @param {File} file */
  async #openFile(file) {
    const problem = sizeProblem(file, t("a network (.onnx)"), this.#panel.part("teach").max_network_bytes);
    if (problem) {
      this.#panel.notice(problem, "error");
      return;
    }
    await this.#panel.sendFile("teach_open", file);
  }

  /** Ask before the driver of the robot is deleted. @param {number} number */
  async #delete(number) {
    const { title, is_driving: isDriving } = this.#network(number);
    const text = t("It drives the robot now. The scene's own driver takes its place.");
    if (isDriving && !(await ask({ title: t("Delete {title}?", { title }), text, yes: t("Delete") }))) return;
    await this.#panel.send("teach_delete", { network: number, even_if_driving: isDriving });
  }

  /** Show a network beside another one. @param {number} number */
  async #compare(number) {
    const others = this.#part.networks.filter((network) => network.number !== number);
    if (others.length === 0) {
      this.#panel.notice(t("There is no other network of this scene to compare it with."), "error");
      return;
    }
    const table = element("table", { className: "ai4u-table ai4u-compare" });
    const draw = (/** @type {string} */ other) => table.replaceChildren(...comparison(this.#network(number), this.#network(Number(other))));
    const chosen = choice(t("With"), draw);
    chosen.set(others.map((other) => ({ value: String(other.number), text: other.title })), String(others[0].number));
    draw(String(others[0].number));
    await showForm({ title: t("Compare networks"), content: [chosen.element, table], no: t("Close") });
  }

  /** @param {number} number */
  #network(number) {
    return this.#part.networks.find((network) => network.number === number);
  }

  /** Hand a network in to the class, as its file would be. @param {number} number */
  async #handIn(number) {
    const file = await this.#read(number);
    const { title } = this.#network(number);
    if (file) await showHandIn({ title, scene: this.#panel.part("scene").scene, agent: this.#part.agent, file });
  }

  /** @param {number} number */
  async #download(number) {
    const file = await this.#read(number);
    if (!file) return;
    const url = URL.createObjectURL(file);
    element("a", { href: url, download: file.name }).click();
    URL.revokeObjectURL(url);
  }

  /**
   * Return a network's file; null if it can't be had.
   * @param {number} number
   */
  async #read(number) {
    const { ok, name, data } = await this.#panel.send("teach_download", { network: number }, { quiet: true });
    if (!ok) return null;
    const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
    return new File([bytes], name, { type: "application/octet-stream" });
  }
}

/**
 * Return the rows of a table about two networks.
 * @param {TaughtNetwork} one
 * @param {TaughtNetwork} other
 */
function comparison(one, other) {
  /** @type {[string, (network: TaughtNetwork) => string][]} */
  const rows = [
    [t("Goal"), ({ score }) => (score === null ? t("not tried") : percent(score.successes / score.starts))],
    [t("From"), ({ score }) => (score === null ? "" : score.has_all ? t("all {starts} starts", { starts: score.starts }) : t("{starts} new starts", { starts: score.starts }))],
    [t("95% between"), ({ score }) => (score === null || score.has_all ? "" : t("{low} and {high}", { low: percent(score.low), high: percent(score.high) }))],
    [t("Learned"), ({ how }) => how],
    [t("Made on"), ({ made_at: madeAt }) => (madeAt ? new Date(1000 * madeAt).toLocaleString() : "")],
  ];
  const line = (/** @type {string} */ name, /** @type {(network: TaughtNetwork) => string} */ cell) =>
    element(
      "tr",
      {},
      element("th", { scope: "row", textContent: name }),
      ...[one, other].map((network) => element("td", { textContent: cell(network) })),
    );
  const differing = rows.filter(([, cell]) => cell(one) || cell(other));
  return [tableHead("", one.title, other.title), element("tbody", {}, ...differing.map(([name, cell]) => line(name, cell)))];
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
    const watch = button(t("Watch"), () => this.#replay(), { icon: "play" });
    const label = element("label", { className: "ai4u-teach-replays" }, element("span", { textContent: t("How it got better") }), this.#slider, this.#shown);
    this.#practice = element("div", {}, label, watch);
    this.element = element("div", {}, this.#facts, this.#practice);
  }

  /** @param {TaughtNetwork} network */
  update({ made_at: madeAt, facts, replays }) {
    const made = madeAt ? [t("Made on {date}.", { date: new Date(1000 * madeAt).toLocaleString() })] : [];
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
    const text = decisions === 0 ? t("at the beginning") : t("after {count} decisions", { count: whole(decisions) });
    setText(this.#shown, text);
    this.#slider.setAttribute("aria-valuetext", text);
  }

  #replay() {
    this.#panel.send("teach_replay", { network: this.#number, decisions: this.#replays[this.#slider.valueAsNumber] }, { quiet: true });
  }
}
