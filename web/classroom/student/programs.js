/**
 * The class's copy of a student's programs: saved while they write, and read where they go on.
 *
 * Only a page of a class does this; elsewhere nothing is sent. The program that was saved last counts. The class numbers
 * all saves, and a device says which one it has seen last: clocks differ and may be set. A program that does not count
 * is kept among the earlier runs.
 */

/** @import { KeptProgram } from "../../types/class.js" */

import { element, setText } from "../../shared/dom.js";
import { randomId } from "../../shared/ids.js";
import { roomOfPage } from "../../shared/room.js";
import { recall, remember } from "../../shared/storage.js";
import { t } from "../../shared/text.js";

/** Pause in typing after which a program is saved (ms). */
const SAVE_DELAY_MS = 2000;
/** Delays before the class is asked again if it can't be reached (ms); the last one is used again. */
const RETRY_DELAYS_MS = [3000, 10_000, 30_000];
/** Most characters of a program that a closing page can still send; UTF-8 needs up to three times as much. */
const MAX_LAST_CHARS = 20_000;
const MAX_SCENE_NAME_CHARS = 200;
const ADDRESS = "../../api/program";
const NEWER = t("The class has a newer program of yours, from another device. It is among the earlier runs.");
const UNREACHABLE = t("The class can't be reached. Your program is kept in this browser, and saved there later.");

/** @typedef {{scene: string, agent: string}} Place */
/** @typedef {{place: Place, source: string}} Program */

export class ClassPrograms {
  /** Sentence on where the present program is kept. */
  element = element("p", { className: "ai4u-soft", role: "status", hidden: true });
  #tab;
  #isInClass = roomOfPage() !== "";
  /** @type {Place | null} */
  #place = null;
  /** The person has changed or run the program since it was opened. */
  #isTouched = false;
  /**
   * Programs to save, by place.
   * @type {Map<string, Program>}
   */
  #waiting = new Map();
  /**
   * Text that the class has, by place.
   * @type {Map<string, string>}
   */
  #saved = new Map();
  #isSaving = false;
  #failures = 0;
  #saveTimer = 0;
  #readTimer = 0;

  /**
   * @param {object} tab
   * @param {() => string | null} tab.source returns the program that the person has here; null for none
   * @param {(source: string) => void} tab.take replaces the program, and keeps the one before
   * @param {(source: string) => void} tab.keep keeps another program
   * @param {(agents: string[]) => void} tab.learn called with the agents, and names behind a slash, of the programs that
   *   the class has in a scene, the one that was saved last first
   */
  constructor(tab) {
    this.#tab = tab;
    if (!this.#isInClass) return;
    addEventListener("pagehide", () => this.#saveLast());
    addEventListener("visibilitychange", () => document.hidden && this.#save());
  }

  /**
   * Read the class's copy of a program of an agent in a scene.
   * @param {string} scene
   * @param {string} agent with the program's name behind a slash, if it has got one
   */
  open(scene, agent) {
    if (!this.#isInClass) return;
    const before = this.#place;
    this.#place = placeOf(scene, agent);
    this.#isTouched = false;
    this.#say("");
    this.#save();
    this.#read(this.#place);
    if (before?.scene !== this.#place.scene) this.#readNames(this.#place);
  }

  /**
   * Have the class forget a program that the person has deleted.
   * @param {string} scene
   * @param {string} agent as of open()
   */
  removed(scene, agent) {
    if (!this.#isInClass) return;
    const place = placeOf(scene, agent);
    this.#waiting.set(keyOf(place), { place, source: "" });
    this.#saveIn(0);
  }

  /**
   * Save a program that was changed, after a pause.
   * @param {string} source
   */
  changed(source) {
    if (!this.#isInClass || this.#place === null) return;
    this.#isTouched = true;
    this.#queue(source, SAVE_DELAY_MS);
  }

  /**
   * Save a program that runs, at once.
   * @param {string} source
   */
  ran(source) {
    if (!this.#isInClass || this.#place === null) return;
    this.#isTouched = true;
    this.#queue(source, 0);
  }

  // -- reading -----------------------------------------------------------------------------------

  /** @param {Place} place */
  async #read(place) {
    clearTimeout(this.#readTimer);
    const { status, found } = await get(place);
    if (place !== this.#place) return;
    if (status === 403) {
      this.#isInClass = false; // a teacher who looks in
    } else if (status !== 200) {
      this.#say(UNREACHABLE);
      this.#readTimer = setTimeout(() => this.#read(place), this.#retryDelay());
    } else {
      this.#failures = 0;
      this.#compare(place, found);
    }
  }

  /** @param {Place} place */
  async #readNames(place) {
    const { found } = await getNames(place.scene); // without an answer, the program itself says so
    if (found !== null && this.#place?.scene === place.scene) this.#tab.learn(found.agents);
  }

  /**
   * @param {Place} place
   * @param {KeptProgram} kept
   */
  #compare(place, { source, version, is_of_device: isOfDevice }) {
    const own = this.#tab.source();
    if (!source) {
      if (own !== null) this.#queue(own, 0);
      return;
    }
    const isSeen = isOfDevice || version === versionOf(place);
    remember(versionKey(place), version);
    this.#saved.set(keyOf(place), source);
    if (source === own) {
      this.#say(t("Kept in the class."));
    } else if (!this.#isTouched && (own === null || !isSeen)) {
      this.#tab.take(source);
      this.#say(t("This is your program from the class."));
    } else {
      this.#tab.keep(source);
      if (own !== null) this.#queue(own, 0);
    }
  }

  // -- saving ------------------------------------------------------------------------------------

  /**
   * @param {string} source
   * @param {number} delay (ms)
   */
  #queue(source, delay) {
    const place = this.#place;
    if (this.#saved.get(keyOf(place)) === source) {
      this.#waiting.delete(keyOf(place));
      return;
    }
    this.#waiting.set(keyOf(place), { place, source });
    this.#saveIn(delay);
  }

  /** @param {number} delay (ms) */
  #saveIn(delay) {
    clearTimeout(this.#saveTimer);
    this.#saveTimer = setTimeout(() => this.#save(), delay);
  }

  async #save() {
    if (this.#isSaving) return;
    this.#isSaving = true;
    clearTimeout(this.#saveTimer);
    const waiting = [...this.#waiting];
    let isReached = true;
    for (const [key, program] of waiting) {
      isReached = this.#note(key, program, await put(program));
      if (!isReached) break;
    }
    this.#isSaving = false;
    if (!this.#isInClass) this.#waiting.clear();
    else if (this.#waiting.size) this.#saveIn(isReached ? SAVE_DELAY_MS : this.#retryDelay());
  }

  /**
   * Note the class's answer; return true if the program need not be sent again.
   * @param {string} key
   * @param {Program} program
   * @param {{status: number, problem: string, version: number}} answer
   */
  #note(key, program, { status, problem, version }) {
    const isShown = program.place === this.#place;
    if (status === 403) {
      this.#isInClass = false; // a teacher who looks in, or a student who was sent out
      return true;
    }
    if (status === 0 || status === 429 || status >= 500) {
      this.#say(problem || UNREACHABLE);
      return false;
    }
    this.#failures = 0;
    if (this.#waiting.get(key) === program) this.#waiting.delete(key);
    if (status === 200) {
      this.#saved.set(key, program.source);
      remember(versionKey(program.place), version);
    }
    if (status === 409 && isShown) this.#keepNewer(program.place);
    if (isShown) this.#say(status === 200 ? t("Kept in the class.") : status === 409 ? NEWER : problem);
    return true;
  }

  /**
   * Keep the program that another device has saved; what the person changes from now on replaces it in the class.
   * @param {Place} place
   */
  async #keepNewer(place) {
    const { status, found } = await get(place);
    if (status !== 200 || found.source === null || place !== this.#place) return;
    this.#tab.keep(found.source);
    remember(versionKey(place), found.version);
  }

  /** Save while the page is closed. */
  #saveLast() {
    for (const program of this.#waiting.values()) put(program, { keepalive: program.source.length <= MAX_LAST_CHARS });
  }

  #retryDelay() {
    this.#failures += 1;
    return RETRY_DELAYS_MS[Math.min(this.#failures, RETRY_DELAYS_MS.length) - 1];
  }

  /** @param {string} text */
  #say(text) {
    setText(this.element, text);
    this.element.hidden = !text;
  }
}

/**
 * @param {string} scene
 * @param {string} agent
 * @returns {Place}
 */
function placeOf(scene, agent) {
  return { scene: (scene || "scene").slice(0, MAX_SCENE_NAME_CHARS), agent };
}

/**
 * Return the class's answer; status 0 if it can't be reached.
 * @param {Place} place
 * @returns {Promise<{status: number, found: KeptProgram | null}>}
 */
function get({ scene, agent }) {
  return getFound({ scene, agent, device: deviceId() });
}

/**
 * Return the agents of the programs that the class has in a scene.
 * @param {string} scene
 * @returns {Promise<{status: number, found: {agents: string[]} | null}>}
 */
function getNames(scene) {
  return getFound({ scene });
}

/** @param {Record<string, string>} facts of the query */
async function getFound(facts) {
  try {
    const query = new URLSearchParams(facts);
    const answer = await fetch(`${ADDRESS}?${query}`, { cache: "no-store" });
    return { status: answer.status, found: answer.ok ? await answer.json() : null };
  } catch {
    return { status: 0, found: null };
  }
}

/**
 * Send a program; return {status, problem, version}; status 0 if the class can't be reached.
 * @param {Program} program
 * @param {RequestInit} [options]
 */
async function put({ place, source }, options = {}) {
  try {
    const answer = await fetch(ADDRESS, {
      method: "PUT",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ ...place, source, base: versionOf(place), device: deviceId() }),
      ...options,
    });
    const { problem = "", version = 0 } = await answer.json().catch(() => ({}));
    return { status: answer.status, problem, version };
  } catch {
    return { status: 0, problem: "", version: 0 };
  }
}

/** @param {Place} place */
function keyOf({ scene, agent }) {
  return JSON.stringify([scene, agent]);
}

/**
 * Return the latest version of a place's program that this browser has seen; 0 for none.
 * @param {Place} place
 */
function versionOf(place) {
  const version = recall(versionKey(place), 0);
  return Number.isSafeInteger(version) && version > 0 ? version : 0;
}

/** @param {Place} place */
function versionKey({ scene, agent }) {
  return `code-version-${roomOfPage()}/${scene}-${agent}`;
}

/** Return the random id of this browser in the room, by which the class knows its own saves again. */
function deviceId() {
  const key = `code-device-${roomOfPage()}`;
  const known = recall(key, "");
  if (typeof known === "string" && /^[\w-]{1,64}$/.test(known)) return known;
  const made = randomId(12);
  remember(key, made);
  return made;
}
