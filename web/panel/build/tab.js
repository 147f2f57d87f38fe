/** The tab "Build": the blocks of the shown agent, its driver and its settings. */

/**
 * @import { BlockRow, BlocksPart, ListBlocks } from "../../generated/messages.js"
 * @import { DriverChoice } from "../../types/panel.js"
 * @import { Panel } from "../panel.js"
 * @import { CardList } from "./block_card.js"
 */
import { button, element } from "../../shared/dom.js";
import { t } from "../../shared/text.js";
import { updateCards } from "./block_card.js";
import { Form } from "../widgets/form.js";
import { openGallery } from "./gallery.js";
import { choice, section } from "../widgets/parts.js";

/** @type {{kind: ListBlocks["kind"], title: string, one: string, add: string, none: string, detailsOnly?: boolean}[]} */
const KINDS = [
  { kind: "sensors", title: t("Sensors"), one: t("Sensor"), add: t("Add a sensor"), none: t("No sensors yet.") },
  { kind: "actuators", title: t("Actuators"), one: t("Actuator"), add: t("Add an actuator"), none: t("It can't do anything yet.") },
  { kind: "rewards", title: t("Rewards"), one: t("Reward"), add: t("Add a reward"), none: t("No rewards yet.") },
  { kind: "brains", title: t("Brains"), one: t("Brain"), add: t("Add a brain"), none: "", detailsOnly: true },
];
/** Delay after a change until the drivers are listed again (ms). */
const DRIVERS_DELAY_MS = 300;

export class BuildTab {
  #panel;
  #driver;
  /** @type {DriverChoice[]} */
  #drivers = [];
  #driversKey = "";
  /** Name of the scene that the drivers are for. */
  #scene = "";
  #shownDriver = "";
  #timer = 0;
  /**
   * Lists by kind of block.
   * @type {Map<string, {cards: CardList, none: HTMLElement}>}
   */
  #lists = new Map();
  #settings;

  /**
   * @param {HTMLElement} root
   * @param {Panel} panel
   */
  constructor(root, panel) {
    this.#panel = panel;
    this.#driver = choice(t("Driven by"), (name) => this.#setDriver(name));
    const adding = KINDS.map(({ kind, one, add, detailsOnly }) => {
      const made = button(one, () => openGallery(panel, { title: add, kind }), { icon: "add", label: add });
      made.classList.toggle("ai4u-details-only", Boolean(detailsOnly));
      return made;
    });
    root.append(
      element("h3", { textContent: t("Add to the robot") }),
      element("div", { className: "ai4u-add", role: "group", ariaLabel: t("Add to the robot") }, ...adding),
      this.#driver.element,
    );
    for (const { kind, title, none: noneText, detailsOnly } of KINDS) {
      const cards = element("div", { className: "ai4u-card-list" });
      const none = element("p", { className: "ai4u-hint-text", textContent: noneText });
      const made = section(`build-${kind}`, title, { detailsOnly }, cards, none);
      made.dataset.blocks = kind;
      root.append(made);
      this.#lists.set(kind, { cards, none });
    }
    this.#settings = new Form({
      onChange: (values) => panel.send("change_agent", { values }),
    });
    root.append(section("build-settings", t("Robot settings"), { isOpen: false }, this.#settings.element));
    this.#scene = panel.part("scene")?.scene ?? "";
    panel.addEventListener("part:scene", ({ detail }) => this.#onScene(detail.scene));
  }

  /** @param {BlocksPart} part */
  update(part) {
    this.#followDrivers(part);
    for (const [kind, { cards, none }] of this.#lists) {
      const blocks = part.kinds?.[kind] ?? [];
      updateCards(this.#panel, cards, blocks, part.form);
      none.hidden = blocks.length > 0;
    }
    this.#settings.update(part.settings ?? []);
  }

  /**
   * Ask for the drivers again if others may be able to drive now: each is tried, which takes a while.
   * @param {BlocksPart} part
   */
  #followDrivers({ agent, driver, kinds }) {
    this.#showDrivers(driver);
    /** @type {(blocks: BlockRow[]) => unknown[]} */
    const classes = (blocks) => blocks.map((block) => [block.class, block.is_on, classes(block.children ?? [])]);
    const key = JSON.stringify([agent, driver, Object.values(kinds ?? {}).map(classes)]);
    if (key === this.#driversKey) return;
    this.#driversKey = key;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#fetchDrivers(), DRIVERS_DELAY_MS);
  }

  /**
   * Forget the drivers of another scene, which may not fit.
   * @param {string} scene
   */
  #onScene(scene) {
    if (scene === this.#scene) return;
    this.#scene = scene;
    this.#drivers = [];
    this.#driversKey = ""; // the next part asks for them again, also if it has the same blocks
    this.#showDrivers(this.#shownDriver);
    const part = this.#panel.part("blocks");
    if (part) this.#followDrivers(part);
  }

  async #fetchDrivers() {
    const scene = this.#scene;
    const answer = await this.#panel.send("drivers", {}, { quiet: true });
    if (!answer.ok || scene !== this.#scene) return;
    this.#drivers = answer.items;
    this.#showDrivers(this.#shownDriver);
  }

  /** @param {string} driver name of the present one */
  #showDrivers(driver) {
    const options = this.#drivers.map(({ name, title, reason = "" }) => ({ value: name, text: title, reason }));
    if (!this.#drivers.some(({ name }) => name === driver)) {
      const text = this.#drivers.length ? t("Somebody else") : "…";
      options.unshift({ value: driver ?? "", text, reason: "" });
    }
    this.#shownDriver = driver ?? "";
    this.#driver.set(options, this.#shownDriver);
  }

  /** @param {string} name */
  async #setDriver(name) {
    const before = this.#shownDriver;
    const answer = await this.#panel.send("driver", { name });
    if (!answer.ok) this.#showDrivers(before);
  }
}
