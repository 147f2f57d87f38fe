/** Which keys of this keyboard mean what: the scene's, or those that a person chose, remembered. */

import { caption, label } from "./labels.js";
import { cross } from "./places.js";

const STORE = "ai4u-keys";
const CODE = /^[A-Za-z0-9]{1,24}$/;
/** What the browser, the page or the keyboard itself needs. */
const RESERVED = /^(Tab|Escape|F\d+|(Control|Alt|Meta|OS)(Left|Right)?|CapsLock|ContextMenu|Unidentified)$/;

export class KeyMap {
  #bindings = {};
  #captions = {};
  /** By place or action, so that a choice holds in all scenes. */
  #chosen = remembered();

  /** @param bindings for each action the codes that the agent listens to; captions: their names here */
  arrange(bindings, captions = {}) {
    this.#bindings = bindings;
    this.#captions = captions;
  }

  get isChanged() {
    return Object.keys(this.#chosen).length > 0;
  }

  /** For each action the keys that mean it now; none if others took them all. */
  get keys() {
    const actions = Object.entries(this.#bindings);
    const slot = this.#slots();
    const taken = new Set(actions.flatMap(([action]) => this.#chosen[slot(action)] ?? []));
    return Object.fromEntries(
      actions.map(([action, codes]) => [
        action,
        this.#chosen[slot(action)] ?? codes.filter((code) => !taken.has(code)),
      ]),
    );
  }

  /** For each key the code that the agent listens to. */
  get means() {
    const keys = this.keys;
    const pairs = Object.entries(this.#bindings).flatMap(([action, codes]) =>
      // of codes for the same action the agent may tell its own keys apart, but not chosen ones
      keys[action].map((key) => [key, codes.includes(key) ? key : codes[0]]),
    );
    return new Map(pairs);
  }

  /** Gives an action another key; in a sentence what came of it, empty if just that. */
  change(action, code) {
    if (RESERVED.test(code) || !CODE.test(code)) return `${label(code)} is needed elsewhere; press another key.`;
    const { keys } = this;
    const slot = this.#slots();
    const holder = Object.keys(keys).find((each) => each !== action && keys[each].includes(code));
    const before = keys[action];
    this.#chosen[slot(action)] = [code];
    let told = "";
    if (holder !== undefined) {
      const left = keys[holder].filter((key) => key !== code);
      this.#chosen[slot(holder)] = left.length ? left : before;
      const now = this.keys[holder].map(label).join(", ") || "no key";
      told = `${label(code)} was “${this.name(holder)}”, which is ${now} now.`;
    }
    remember(this.#chosen);
    return told;
  }

  /** Back to the keys of the scene. */
  reset() {
    this.#chosen = {};
    remember(this.#chosen);
  }

  /** What an action is called here. */
  name(action) {
    return caption(action, this.#captions);
  }

  #slots() {
    const places = new Map([...cross(this.#bindings)].map(([place, action]) => [action, `at ${place}`]));
    return (action) => places.get(action) ?? action;
  }
}

function remembered() {
  try {
    const found = JSON.parse(localStorage.getItem(STORE) ?? "{}");
    const isKeys = (keys) => Array.isArray(keys) && keys.every((key) => CODE.test(key));
    return Object.fromEntries(Object.entries(found).filter(([, keys]) => isKeys(keys)));
  } catch {
    return {}; // forbidden here, or written by somebody else
  }
}

function remember(chosen) {
  try {
    if (Object.keys(chosen).length) localStorage.setItem(STORE, JSON.stringify(chosen));
    else localStorage.removeItem(STORE);
  } catch {
    // forbidden here: it holds as long as the page
  }
}
