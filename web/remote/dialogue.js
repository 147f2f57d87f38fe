/**
 * A page's side of the dialogue with a world, without input and output: as ai4u_edu/remote/dialogue.py.
 *
 * Its methods are generators. They yield steps ({open: ms}, {send: frame}, {receive: ms}, {pause: ms}, {close: true});
 * a connection carries them out and sends back the result. If no answer arrives in time, the dialogue repeats its
 * last frame; if the connection is lost, it reconnects, as long as the world keeps the agent for it.
 */

/** @import { Percept, Problem, Welcome } from "../types/remote.js" */

import { limits } from "../shared/limits.js";
import { t } from "../shared/text.js";
import { actionFrame, frameOf, messageIn, PROBLEMS, resetFrame, valuesOf, VERSION } from "./messages.js";

/** Time after which a frame is repeated for the first time; it doubles with each repetition. */
const FIRST_TIMEOUT_MS = 200;
const MAX_TIMEOUT_MS = 1000;
/** Timeout of one attempt to connect, hello and welcome included. */
const ATTEMPT_TIMEOUT_MS = 3000;
const FIRST_BACKOFF_MS = 20;
const MAX_BACKOFF_MS = 500;
/** Time that opening a connection gets even if the deadline is nearer. */
const MIN_OPEN_TIMEOUT_MS = 100;
/** Close code of a server in front of the world that refuses. */
const CLOSE_REFUSED = 1008;

/** @typedef {{open?: number, send?: Uint8Array<ArrayBuffer>, receive?: number, pause?: number, close?: true}} Step */
/**
 * @template Result
 * @typedef {Generator<Step, Result, Uint8Array | null>} Flow
 */

/** An error of the dialogue; `code` is a problem's of the protocol, "lost", "refused" or "closed". */
export class RemoteError extends Error {
  /**
   * @param {string} text
   * @param {string} code
   */
  constructor(text, code) {
    super(text);
    this.name = "RemoteError";
    this.code = code;
  }
}

/** There is no connection, or it was lost; only connections throw it. */
export class ConnectionLostError extends Error {
  /** @param {string} reason */
  constructor(reason, closeCode = 0) {
    super(reason);
    this.closeCode = closeCode;
  }
}

export class Dialogue {
  /**
   * The world's description of the agent.
   * @type {Welcome | null}
   */
  welcome = null;
  /**
   * The latest percept; null before the first.
   * @type {Percept | null}
   */
  percept = null;

  /** @type {string} */
  #agent;
  /** @type {string} */
  #mode;
  /** @type {string} */
  #onMissing;
  /** @type {string} */
  #secret;
  /**
   * Fields that go with each answer.
   * @type {import("./messages.js").Fields}
   */
  #told = {};
  /**
   * The frame that is repeated if no answer arrives.
   * @type {Uint8Array<ArrayBuffer> | null}
   */
  #lastFrame = null;
  /** @type {Uint8Array<ArrayBuffer> | null} */
  #lastHello = null;
  /** The latest percept has an answer. */
  #isAnswered = true;
  /** Number of the percept whose answer the world may still refuse. */
  #refusableSeq = -1;
  /** Times that the answer to the latest percept was sent. */
  #copies = 0;
  /**
   * The latest refusal of an answer that was thrown.
   * @type {Problem | null}
   */
  #refusal = null;
  /** Times that it may still come, for the other copies of that answer. */
  #staleRefusals = 0;
  /**
   * The error that ended the session; every method throws it from then on.
   * @type {Error | null}
   */
  #ended = null;

  /** @param {{agent: string, mode: string, onMissing: string, secret: string}} options */
  constructor({ agent, mode, onMissing, secret }) {
    [this.#agent, this.#mode, this.#onMissing, this.#secret] = [agent, mode, onMissing, secret];
  }

  /**
   * Connect, and get the agent.
   * @returns {Flow<void>}
   */
  *begin() {
    const lost = yield* this.#connect(performance.now() + limits.connectMs);
    if (lost === null) return;
    yield { close: true };
    throw new RemoteError(t("The world does not answer ({reason}). Is it still running?", { reason: lost.message }), "lost");
  }

  /**
   * Return the percept that has no answer yet, as soon as it is there.
   * @returns {Flow<Percept>}
   */
  *sense() {
    this.#checkOpen();
    let timeout = FIRST_TIMEOUT_MS;
    while (this.percept === null || this.#isAnswered) {
      this.#checkOpen();
      try {
        const frame = yield { receive: timeout };
        if (frame === null) {
          timeout = Math.min(2 * timeout, MAX_TIMEOUT_MS);
          yield this.#repeat();
        } else {
          this.#handle(frame);
        }
      } catch (lost) {
        yield* this.#reconnect(lost);
        timeout = FIRST_TIMEOUT_MS;
      }
    }
    return this.percept;
  }

  /**
   * Let fields go with each answer from the next one on; null takes one back.
   * @param {Record<string, string | number | (string | number)[] | null>} fields by name
   * @returns {string} a sentence about fields that no sensor reads; empty if there are none
   */
  tell(fields) {
    for (const [name, value] of Object.entries(fields)) {
      delete this.#told[name];
      if (value !== null) this.#told[name] = [value].flat().map(String);
    }
    const readable = this.welcome?.fields || [];
    const unread = Object.keys(this.#told).filter((name) => !readable.includes(name));
    return unread.length ? t("No sensor reads {names}: expected an AgentArraySensor of that name.", { names: unread.join(", ") }) : "";
  }

  /**
   * Answer the latest percept with an action; if it has an answer, wait for the next one.
   * @param {Record<string, number[]>} values by actuator
   * @returns {Flow<void>}
   */
  *act(values) {
    const percept = yield* this.sense();
    if (percept.terminated || percept.truncated) {
      throw new RemoteError(t("The episode is over; reset begins another."), "episode_over");
    }
    yield* this.#answer(actionFrame(percept, values, this.#told), percept.seq);
  }

  /**
   * Begin an episode, and return its first percept.
   * @param {number | null} [seed]
   * @returns {Flow<Percept>}
   */
  *reset(seed = null) {
    const { episode, seq } = yield* this.sense();
    let next = seq;
    do {
      yield* this.#answer(resetFrame(next, seed, this.#told), next); // again if an error had stopped the world
      next = (yield* this.sense()).seq;
    } while (this.percept.episode === episode);
    return this.percept;
  }

  /**
   * Ask a world in lockstep for more time, if the latest percept has no answer yet.
   * @returns {Flow<void>}
   */
  *wait() {
    if (this.percept === null || this.#isAnswered) return;
    try {
      yield { send: frameOf("order", this.percept.seq, "wait") };
    } catch (lost) {
      yield* this.#reconnect(lost);
    }
  }

  /**
   * Say goodbye, which gives the agent back, and close the connection.
   * @param {string} reason
   * @returns {Flow<void>}
   */
  *end(reason) {
    if (this.#ended !== null) return;
    this.#ended = new RemoteError(t("The connection was closed."), "closed");
    try {
      yield { send: frameOf("bye", reason) };
    } catch {
      // it was lost already
    }
    yield { close: true };
  }

  /**
   * Connect, with a growing pause between two attempts; return null on success, else the last error.
   * @param {number} deadline (ms, performance.now)
   * @returns {Flow<Error | null>}
   */
  *#connect(deadline) {
    const isFirst = this.welcome === null;
    let backoff = FIRST_BACKOFF_MS;
    let lost = new ConnectionLostError(t("no answer"));
    while (performance.now() < deadline) {
      try {
        yield* this.#attempt(Math.min(deadline, performance.now() + ATTEMPT_TIMEOUT_MS));
        if (this.#isAnswered && !isFirst) yield this.#repeat();
        return null;
      } catch (failed) {
        this.#throwUnlessLost(failed);
        lost = failed;
      }
      yield { pause: backoff };
      backoff = Math.min(2 * backoff, MAX_BACKOFF_MS);
    }
    return lost;
  }

  /**
   * Open a connection, and send the hello until there is a welcome.
   * @param {number} deadline (ms, performance.now)
   * @returns {Flow<void>}
   */
  *#attempt(deadline) {
    yield { open: Math.max(deadline - performance.now(), MIN_OPEN_TIMEOUT_MS) };
    const session = this.welcome?.session ?? "";
    /** @type {unknown[]} */
    const hello = ["hello", VERSION, this.#agent, "", this.#mode, [], session, this.#secret];
    const frame = frameOf(...hello, ...(this.#onMissing ? [this.#onMissing] : []));
    let timeout = FIRST_TIMEOUT_MS;
    while (performance.now() < deadline) {
      yield { send: frame };
      if (this.#lastFrame === this.#lastHello) this.#lastFrame = frame; // there was no percept to answer yet
      this.#lastHello = frame;
      const repeatAt = performance.now() + timeout;
      timeout = Math.min(2 * timeout, MAX_TIMEOUT_MS);
      for (let left = repeatAt - performance.now(); left > 0; left = repeatAt - performance.now()) {
        const heard = yield { receive: left };
        if (heard !== null && this.#handleWelcome(heard)) return;
      }
    }
    throw new ConnectionLostError(t("no answer"));
  }

  /**
   * Resume the session over a new connection, within the world's grace time.
   * @param {unknown} lost what was thrown
   * @returns {Flow<void>}
   */
  *#reconnect(lost) {
    this.#throwUnlessLost(lost);
    this.#checkOpen();
    const { grace } = this.welcome;
    const final = yield* this.#connect(performance.now() + 1000 * grace);
    if (final === null) return;
    this.#ended = new RemoteError(t("The connection to the world is lost ({reason}). Press Run again.", { reason: final.message }), "lost");
    yield { close: true };
    throw this.#ended;
  }

  /**
   * @param {Uint8Array<ArrayBuffer>} frame
   * @param {number} seq number of the percept that it answers
   * @returns {Flow<void>}
   */
  *#answer(frame, seq) {
    [this.#lastFrame, this.#isAnswered, this.#refusableSeq, this.#copies] = [frame, true, seq, 1];
    try {
      yield { send: frame };
    } catch (lost) {
      yield* this.#reconnect(lost);
    }
  }

  /** Return the step that sends the last frame once more. */
  #repeat() {
    this.#copies += 1;
    return { send: this.#lastFrame };
  }

  /**
   * Handle a frame that may be the welcome; return true if it is.
   * @param {Uint8Array} frame
   */
  #handleWelcome(frame) {
    const message = messageIn(frame);
    if (message.type === "problem") this.#end(new RemoteError(message.text, message.code));
    if (message.type !== "welcome") return false;
    this.welcome = message;
    return true;
  }

  /**
   * Handle a frame of the session; old percepts and repeated problems are ignored.
   * @param {Uint8Array} frame
   */
  #handle(frame) {
    const message = messageIn(frame);
    const latest = this.percept?.seq ?? 0;
    if (message.type === "percept" && message.seq > latest) {
      const { type, data, texts, ...rest } = message;
      this.percept = { values: valuesOf(this.welcome.readings, { data, texts }), ...rest };
      this.#isAnswered = false;
    } else if (message.type === "bye") {
      this.#end(new RemoteError(t("The world has ended the session: {reason}", { reason: message.reason }), "ended"));
    } else if (message.type === "problem") {
      this.#handleProblem(message, latest);
    }
  }

  /**
   * @param {Problem} problem
   * @param {number} latest number of the latest percept
   */
  #handleProblem(problem, latest) {
    const { code, text, seq } = problem;
    const error = new RemoteError(text, code);
    if ([...PROBLEMS.values()].includes(code)) this.#end(error);
    if (seq === 0) {
      this.#isAnswered = this.percept === null; // the last frame was no answer
      throw error;
    }
    const refused = this.#refusal;
    if (this.#staleRefusals && code === refused.code && text === refused.text && seq === refused.seq) {
      this.#staleRefusals -= 1; // the world refuses each copy of an answer; this one is not about the present answer
      return;
    }
    if (seq !== this.#refusableSeq) return;
    [this.#refusal, this.#staleRefusals, this.#refusableSeq] = [problem, this.#copies - 1, -1];
    this.#isAnswered &&= seq !== latest;
    throw error;
  }

  #checkOpen() {
    if (this.#ended !== null) throw this.#ended;
  }

  /**
   * Throw what is no lost connection, or one that the world closed on purpose.
   * @param {unknown} lost what was thrown
   */
  #throwUnlessLost(lost) {
    if (!(lost instanceof ConnectionLostError)) throw lost;
    const code = PROBLEMS.get(lost.closeCode) ?? (lost.closeCode === CLOSE_REFUSED && "refused");
    if (code) this.#end(new RemoteError(lost.message, code)); // the frame that said why may have been lost
  }

  /** @param {Error} error */
  #end(error) {
    this.#ended = error;
    throw error;
  }
}
