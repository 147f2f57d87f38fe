/** Key bindings: the scene's, with the person's own choices over them, kept in local storage. */

import { forget, recall, remember } from "../shared/storage.js";
import { t } from "../shared/text.js";
import { dpadActions } from "./dpad.js";
import { caption, label } from "./labels.js";

const STORAGE_KEY = "keys";
/** A KeyboardEvent.code; stored choices are checked against it. */
const CODE = /^[A-Za-z0-9]{1,24}$/;
/** Codes of keys that the browser, the page or the keyboard itself needs. */
export const RESERVED_CODE = /^(Tab|Escape|F\d+|(Control|Alt|Meta|OS)(Left|Right)?|CapsLock|ContextMenu|Unidentified)$/;

/** @typedef {Record<string, string[]>} KeyCodes by action, or by slot */

export class KeyMap {
  /** @type {KeyCodes} */
  #bindings = {};
  /** @type {Record<string, string>} */
  #captions = {};
  /** Chosen key codes by slot (direction of the pad, or action), so a choice applies in all scenes. */
  #chosen = loadChoices();

  /**
   * @param {KeyCodes} bindings of the agent, by action
   * @param {Record<string, string>} captions the scene's names of actions
   */
  arrange(bindings, captions = {}) {
    this.#bindings = bindings;
    this.#captions = captions;
  }

  get isChanged() {
    return Object.keys(this.#chosen).length > 0;
  }

  /**
   * The key codes of each action now; empty if all its keys were given to other actions.
   * @returns {KeyCodes}
   */
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

  /** A map from the code of each pressed key to the code that is sent to the agent. */
  get sentCodes() {
    const keys = this.keys;
    const pairs = Object.entries(this.#bindings).flatMap(([action, codes]) =>
      // The agent may distinguish its own keys for one action; a chosen key is sent as the first of them.
      keys[action].map((key) => /** @type {const} */ ([key, codes.includes(key) ? key : codes[0]])),
    );
    return new Map(pairs);
  }

  /**
   * Bind an action to a key; return a message if the key was refused or taken from another action.
   * @param {string} action
   * @param {string} code of the key
   */
  change(action, code) {
    if (RESERVED_CODE.test(code) || !CODE.test(code)) {
      return t("{key} is needed elsewhere; press another key.", { key: label(code) });
    }
    const { keys } = this;
    const slot = this.#slots();
    const holder = Object.keys(keys).find((other) => other !== action && keys[other].includes(code));
    const before = keys[action];
    this.#chosen[slot(action)] = [code];
    let message = "";
    if (holder !== undefined) {
      const others = keys[holder].filter((key) => key !== code);
      this.#chosen[slot(holder)] = others.length ? others : before;
      const now = this.keys[holder].map(label).join(", ") || t("no key");
      message = t("{key} was “{action}”, which is {now} now.", { key: label(code), action: this.name(holder), now });
    }
    storeChoices(this.#chosen);
    return message;
  }

  /** Return to the scene's keys. */
  reset() {
    this.#chosen = {};
    storeChoices(this.#chosen);
  }

  /**
   * Return an action's name in this scene.
   * @param {string} action
   */
  name(action) {
    return caption(action, this.#captions);
  }

  /** Return a function from an action to its slot in the stored choices. */
  #slots() {
    const dpad = [...dpadActions(this.#bindings)];
    const slots = new Map(dpad.map(([direction, action]) => /** @type {const} */ ([action, `at ${direction}`])));
    return (/** @type {string} */ action) => slots.get(action) ?? action;
  }
}

/** @returns {KeyCodes} */
function loadChoices() {
  const areCodes = (/** @type {unknown} */ keys) => Array.isArray(keys) && keys.every((key) => CODE.test(key));
  return Object.fromEntries(Object.entries(recall(STORAGE_KEY, {}) ?? {}).filter(([, keys]) => areCodes(keys)));
}

/** @param {KeyCodes} chosen by slot */
function storeChoices(chosen) {
  if (Object.keys(chosen).length) remember(STORAGE_KEY, chosen);
  else forget(STORAGE_KEY);
}
