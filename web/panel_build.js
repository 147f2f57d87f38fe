/** The tab "Build": the blocks of the shown agent, its driver and its settings. */

import { button, element } from "./dom.js";
import { updateCards } from "./panel_block_card.js";
import { Form } from "./panel_form.js";
import { openGallery } from "./panel_gallery.js";
import { choice, section } from "./panel_parts.js";

const KINDS = {
  sensors: { title: "Sensors", one: "Sensor", add: "Add a sensor", none: "It notices nothing yet." },
  actuators: { title: "Actuators", one: "Actuator", add: "Add an actuator", none: "It can't do anything yet." },
  rewards: { title: "Rewards", one: "Reward", add: "Add a reward", none: "It gets no reward yet." },
  brains: { title: "Brains", one: "Brain", add: "Add a brain", none: "", detailsOnly: true },
};
/** Value of the list of drivers if none of them drives. */
const OTHER_DRIVER = "";

export class BuildTab {
  #panel;
  #part = null;
  #driver;
  #lists = new Map();
  #settings;

  constructor(root, panel) {
    this.#panel = panel;
    this.#driver = choice("Driven by", (name) => this.#setDriver(name));
    root.append(this.#driver.element);
    for (const [kind, words] of Object.entries(KINDS)) {
      const cards = element("div", { className: "ai4u-card-list" });
      const none = element("p", { className: "ai4u-hint-text", textContent: words.none });
      const add = button(words.one, () => this.#openGallery(kind), { icon: "add", label: words.add, kind: "quiet" });
      const { detailsOnly = false } = words;
      root.append(section(`build-${kind}`, words.title, { detailsOnly }, cards, none, add));
      this.#lists.set(kind, { cards, none });
    }
    this.#settings = new Form({
      onChange: (values) => panel.send("change_agent", { agent: panel.shown.agent, values }),
    });
    root.append(section("build-settings", "Agent's settings", { isOpen: false }, this.#settings.element));
  }

  /** @param part as "blocks" in the protocol */
  update(part) {
    this.#part = part;
    this.#showDrivers(part);
    for (const [kind, { cards, none }] of this.#lists) {
      const blocks = part.kinds?.[kind] ?? [];
      updateCards(this.#panel, cards, blocks, part.form);
      none.hidden = blocks.length > 0;
    }
    const { fields = [], first = [] } = settingsOf(part);
    this.#settings.update(fields, first);
  }

  #showDrivers({ driver, drivers = [] }) {
    const options = drivers.map(({ name, title, reason = "" }) => ({ value: name, text: title, reason }));
    if (!drivers.some(({ name }) => name === driver)) {
      options.unshift({ value: OTHER_DRIVER, text: "Somebody else", reason: "" });
    }
    this.#driver.set(options, driver ?? OTHER_DRIVER);
  }

  async #setDriver(name) {
    if (name !== OTHER_DRIVER) await this.#panel.send("driver", { agent: this.#panel.shown.agent, name });
    this.#showDrivers(this.#part); // the one that drives, if the change failed
  }

  #openGallery(kind) {
    openGallery(this.#panel, { title: KINDS[kind].add, agent: this.#panel.shown.agent, kind });
  }
}

/** Return a form; a list of fields is one without an order. */
function settingsOf({ settings = [] }) {
  return Array.isArray(settings) ? { fields: settings } : settings;
}
