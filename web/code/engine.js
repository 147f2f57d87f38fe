/** Python in the browser: starts the worker of a student's program, and ends it if it does not answer. */

/** @import { Reading, Value } from "../types/remote.js" */

import { limits } from "../shared/limits.js";
import { pageCatalogue, t } from "../shared/text.js";

/** Time until the spare worker is started, which would slow down a program's first decisions. */
const SPARE_DELAY_MS = 3000;
const WASM = "../vendor/pyodide/pyodide.asm.wasm?v=cc36e3ca";
const LIBRARY = "../vendor/pyodide/python_stdlib.zip?v=aabcb2cf";
const PROGRAM = "../../program.zip";
const ENDLESS = t("The program did not come back from this line, so it was ended. Is something in it endless or huge?");
const NOT_LOADED = t("The program is not running. Press Run.");
const UNAVAILABLE = t("Python could not be loaded. Is the world still running? Reload the page.");

/** Numbers that JSON does not have, as host.py reads them. */
const NUMBER_WORDS = new Map([[Infinity, "inf"], [-Infinity, "-inf"], [NaN, "nan"]]);

/**
 * @typedef {object} Answer of host.py
 * @property {boolean} ok
 * @property {string} [kind] of a mistake
 * @property {string} [text]
 * @property {number} [line] 0 for none
 * @property {string} [printed]
 * @property {number[]} [lines] that ran
 * @property {Record<string, string>} [variables]
 * @property {TracedMoment[]} [moments] from a line on at which it was to stop
 * @property {Record<string, number[]>} [values] the action, by actuator
 * @property {string} [value] what a called function returned, as JSON
 */
/** @typedef {{line: number, variables: Record<string, string>}} TracedMoment a line that ran, and the variables before it */
/** @typedef {{wasm: WebAssembly.Module, library: Uint8Array<ArrayBuffer>, program: Uint8Array<ArrayBuffer>, messages: Record<string, unknown>}} Parts */
/** @typedef {{outputs: Record<string, [low: number[], high: number[]]>, readings: Pick<Reading, "key" | "dtype">[]}} Facts of an agent */

/** @type {Facts} */
const NO_FACTS = { outputs: {}, readings: [] };

/**
 * Files that all workers share; the compiled module, too, so that only the first worker waits for it.
 * @type {Promise<Parts> | null}
 */
let parts = null;

/**
 * Return an answer in the form of host.py for what happens outside of it.
 * @param {string} kind
 * @param {string} text
 * @returns {Answer}
 */
function problem(kind, text, line = 0) {
  return { ok: false, kind, text, line, printed: "", lines: [], variables: {} };
}

/**
 * Return an answer with the sentence for what happened in the worker outside of host.py.
 * @param {Answer} answer
 * @returns {Answer}
 */
function said(answer) {
  if (answer.kind === "broken") return { ...answer, text: t("Python has stopped: {error}", { error: answer.text }) };
  if (answer.kind === "too_large") return { ...answer, text: t("The program sent too much at once.") };
  return answer;
}

/**
 * Return JSON for host.py.
 * @param {unknown} value
 */
function json(value) {
  return JSON.stringify(value, (_, part) => (Object.is(part, -0) ? "-0" : (NUMBER_WORDS.get(part) ?? part)));
}

/**
 * Methods may be called one after another or all at once; each waits for the one before.
 *
 * Each program has a worker of its own, which ends with it: so none of its timers, tasks, files or changed modules is left
 * for the next one.
 */
export class CodeEngine {
  /**
   * The worker that has the program, or will have the next one.
   * @type {Runtime | null}
   */
  #runtime = null;
  /**
   * A worker that is ready for when the other one is ended.
   * @type {Runtime | null}
   */
  #spare = null;
  /** Counts ends of programs: what was asked before is not done later. */
  #ends = 0;
  /**
   * The end of the latest call.
   * @type {Promise<unknown>}
   */
  #last = Promise.resolve();
  /** Until the spare worker is started. */
  #timer = 0;
  #isLoaded = false;

  /** Load Python ahead of the first program. Rejects with a sentence if it can't be loaded. */
  async warm() {
    this.#runtime ??= new Runtime();
    try {
      await this.#runtime.ready;
    } catch (error) {
      this.end();
      throw error;
    }
  }

  /**
   * Load a program.
   *
   * @param {string} source
   * @param {Facts} facts
   * @param {number} spareDelay time until the worker of the program after it is started (ms)
   * @returns {Promise<Answer>}
   */
  load(source, facts, spareDelay = SPARE_DELAY_MS) {
    const ends = this.#ends;
    return this.#queue(() => this.#load(source, facts, spareDelay, () => ends !== this.#ends));
  }

  /**
   * Load functions to call, none of which decides.
   *
   * @param {string} source
   * @returns {Promise<Answer>}
   */
  loadFunctions(source) {
    const ends = this.#ends;
    return this.#queue(() => this.#load(source, NO_FACTS, SPARE_DELAY_MS, () => ends !== this.#ends, false));
  }

  /**
   * @param {string} source
   * @param {Facts} facts
   * @param {number} spareDelay (ms)
   * @param {() => boolean} isOver
   */
  async #load(source, { outputs, readings }, spareDelay, isOver, hasEntry = true) {
    this.#isLoaded = false;
    if (this.#runtime?.isUsed) this.#replace();
    try {
      await this.warm();
    } catch (error) {
      return problem("unavailable", error.message);
    }
    if (isOver()) return problem("ended", NOT_LOADED);
    this.#runtime.isUsed = true;
    const dtypes = Object.fromEntries(readings.map(({ key, dtype }) => [key, dtype]));
    const answer = await this.#call("load", json({ source, outputs, readings: dtypes, limit_s: limits.programS, has_entry: hasEntry }));
    this.#isLoaded = answer.ok;
    clearTimeout(this.#timer);
    if (answer.ok && !isOver()) this.#timer = setTimeout(() => (this.#spare ??= new Runtime()), spareDelay);
    return answer;
  }

  /** End the program at once, with all that it left behind; Python is loaded for the next one. */
  finish() {
    this.#ends += 1;
    clearTimeout(this.#timer);
    if (this.#runtime?.isUsed) this.#replace();
  }

  /** Tell the program that an episode begins. */
  begin() {
    return this.#callLoaded("begin", "");
  }

  /**
   * Let the program decide.
   *
   * @param {Record<string, Value>} percept readings by key
   * @param {number} number of the decision, which stands beside what the program prints
   * @param {number[]} [stops] lines at which to stop; 0 for the first one that runs
   */
  decide(percept, number, stops = []) {
    return this.#callLoaded("decide", json({ percept, decision: number, ...(stops.length ? { stops } : {}) }));
  }

  /**
   * Call a function of the program.
   *
   * @param {string} name
   * @param {string} args JSON, as host.py reads it
   */
  call(name, args) {
    return this.#callLoaded("call", json({ name, arguments: args }));
  }

  /** End all workers. */
  end() {
    this.#ends += 1;
    clearTimeout(this.#timer);
    this.#runtime?.end();
    this.#spare?.end();
    this.#runtime = this.#spare = null;
    this.#isLoaded = false;
  }

  /**
   * @param {string} method
   * @param {string} text
   */
  #callLoaded(method, text) {
    return this.#queue(() => (this.#isLoaded ? this.#call(method, text) : problem("not_loaded", NOT_LOADED)));
  }

  /**
   * Start a call when the one before is over: that may have to end the worker.
   * @template Answer
   * @param {() => Promise<Answer> | Answer} call
   * @returns {Promise<Answer>}
   */
  #queue(call) {
    const answer = this.#last.then(call);
    this.#last = answer.catch(() => {}); // the caller is told
    return answer;
  }

  /**
   * @param {string} method
   * @param {string} text
   */
  async #call(method, text) {
    const runtime = this.#runtime;
    if (runtime === null) return problem("ended", NOT_LOADED); // while Python was loaded
    const answer = await runtime.call(method, text);
    if (runtime.isStuck && this.#runtime === runtime) this.#replace();
    return answer;
  }

  /** End the program's worker, and take another one. */
  #replace() {
    this.#runtime.end();
    [this.#runtime, this.#spare] = [this.#spare ?? new Runtime(), null];
    this.#isLoaded = false;
  }
}

const ENDED_ANSWER = JSON.stringify(problem("ended", NOT_LOADED));

/** One worker. */
class Runtime {
  #worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  #isEnded = false;
  #lastId = 0;
  /**
   * Functions that take an answer's text, by the id of the call.
   * @type {Map<number, (text: string) => void>}
   */
  #waiting = new Map();
  /** The line of the program that ran last, as far as it was reported. */
  #line = 0;
  /** Called when the worker begins with a call. */
  #onbegun = () => {};
  /** True if the worker can't be called any more. */
  isStuck = false;
  /** True if it has got a program. */
  isUsed = false;

  constructor() {
    this.#worker.onmessage = ({ data: { id, text, line, isBegun } }) => {
      if (line) this.#line = line;
      if (isBegun) this.#onbegun();
      if (line || isBegun) return;
      const answer = this.#waiting.get(id);
      this.#waiting.delete(id);
      answer?.(text);
    };
    this.ready = this.#start();
    this.ready.catch(() => {}); // whoever waits for it is told
  }

  /**
   * Call a function of host.py; give up after a while.
   * @param {string} method
   * @param {string} text
   * @returns {Promise<Answer>}
   */
  async call(method, text) {
    this.#line = 0;
    let timer = 0;
    /** @type {Promise<string>} */
    const late = new Promise((resolve) => {
      timer = setTimeout(resolve, limits.beginMs, "");
      this.#onbegun = () => {
        clearTimeout(timer);
        timer = setTimeout(resolve, limits.callMs, "");
      };
    });
    const answer = await Promise.race([this.#ask({ method, text }), late]);
    clearTimeout(timer);
    const found = answer ? said(JSON.parse(answer)) : problem("endless", ENDLESS, this.#line);
    this.isStuck ||= !answer || found.kind === "broken";
    return found;
  }

  end() {
    this.#isEnded = true;
    this.#worker.terminate();
    for (const answer of this.#waiting.values()) answer(ENDED_ANSWER);
    this.#waiting.clear();
  }

  async #start() {
    const failed = new Promise((_, reject) => {
      this.#worker.onerror = () => reject(new Error(UNAVAILABLE));
    });
    failed.catch(() => {}); // it may fail while the files are fetched
    parts ??= fetchParts();
    const given = await parts.catch((error) => {
      parts = null; // the next worker tries again
      throw error;
    });
    const answer = said(JSON.parse(await Promise.race([this.#ask({ method: "start", parts: given }), failed])));
    if (answer.ok === false) throw new Error(answer.text);
  }

  /**
   * @param {{method: string, text?: string, parts?: Parts}} message
   * @returns {Promise<string>}
   */
  #ask(message) {
    if (this.#isEnded) return Promise.resolve(ENDED_ANSWER);
    const id = (this.#lastId += 1);
    return new Promise((resolve) => {
      this.#waiting.set(id, resolve);
      this.#worker.postMessage({ id, ...message });
    });
  }
}

/** @returns {Promise<Parts>} */
async function fetchParts() {
  try {
    const [wasm, library, program] = await Promise.all([
      WebAssembly.compileStreaming(fetched(WASM)),
      fetched(LIBRARY).then((answer) => answer.arrayBuffer()),
      fetched(PROGRAM).then((answer) => answer.arrayBuffer()),
    ]);
    return { wasm, library: new Uint8Array(library), program: new Uint8Array(program), messages: pageCatalogue().messages };
  } catch {
    throw new Error(UNAVAILABLE);
  }
}

/** @param {string} path */
async function fetched(path) {
  const answer = await fetch(new URL(path, import.meta.url));
  if (!answer.ok) throw new Error(UNAVAILABLE);
  return answer;
}
