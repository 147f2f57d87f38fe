/** An agent of the page's own world, driven from the page over the protocol for scripts. */

/** @import { Percept } from "../types/remote.js" */
/** @import { Flow, Step } from "./dialogue.js" */

import { randomId } from "../shared/ids.js";
import { t } from "../shared/text.js";
import { ConnectionLostError, Dialogue, RemoteError } from "./dialogue.js";
import { SUBPROTOCOL } from "./messages.js";

const PATH = "../../ws/remote";

export { RemoteError };

/**
 * A session with a world. Methods may be called one after another or all at once; each waits for the one before.
 * They reject with a RemoteError, whose message is a sentence for a person.
 */
export class RemoteClient {
  #dialogue;
  #connection = new Connection();
  /**
   * The end of the method that was called last.
   * @type {Promise<unknown>}
   */
  #last = Promise.resolve();

  /** @param {{agent: string, mode: string, onMissing: string}} options */
  constructor(options) {
    this.#dialogue = new Dialogue({ ...options, secret: randomId() });
  }

  /**
   * Connect to the page's world, and get an agent.
   *
   * @param {object} [options]
   * @param {string} [options.agent] its id; may be left out where there is only one
   * @param {"realtime"|"lockstep"} [options.mode] in lockstep, the world waits for each action
   * @param {""|"hold"|"coast"|"stop"} [options.onMissing] in place of an action that is late; empty: the world's setting
   * @returns {Promise<RemoteClient>}
   */
  static async connect({ agent = "", mode = "realtime", onMissing = "" } = {}) {
    const client = new RemoteClient({ agent, mode, onMissing });
    await client.#run(client.#dialogue.begin());
    return client;
  }

  /** The world's description of the agent. */
  get welcome() {
    return this.#dialogue.welcome;
  }

  /** Lowest and highest values by actuator. */
  get outputs() {
    return Object.fromEntries(this.welcome.outputs.map(({ name, low, high }) => [name, [low, high]]));
  }

  /**
   * Return the current percept; after an action, wait until its decision is over.
   *
   * @returns {Promise<Percept>}
   */
  sense() {
    return this.#run(this.#dialogue.sense());
  }

  /**
   * Answer the latest percept; sense() waits for the result.
   *
   * @param {Object<string, number[]>} values by actuator; those that are left out do nothing
   */
  act(values) {
    return this.#run(this.#dialogue.act(values));
  }

  /**
   * Tell the agent something besides actions, from the next action or reset on: a sensor of that name reads it.
   *
   * @param {Record<string, string | number | (string | number)[] | null>} fields by name; null takes one back
   * @returns {string} a sentence about fields that no sensor reads; empty if there are none
   */
  tell(fields) {
    return this.#dialogue.tell(fields);
  }

  /**
   * Begin an episode, and return its first percept.
   *
   * @param {number} [seed] resets the whole world; default: the agent alone if there are others
   */
  reset(seed) {
    return this.#run(this.#dialogue.reset(seed));
  }

  /** Ask a world in lockstep for more time to decide. */
  wait() {
    return this.#run(this.#dialogue.wait());
  }

  /** Give the agent back to the brain that it had before; what waits is rejected. It may be called twice. */
  async close(reason = "the page has stopped its program") {
    this.#connection.interrupt(new RemoteError(t("The connection was closed."), "closed"));
    await this.#run(this.#dialogue.end(reason));
  }

  /**
   * Carry out a dialogue's steps, after those of the method before, and return the result.
   * @template Result
   * @param {Flow<Result>} flow
   * @returns {Promise<Result>}
   */
  #run(flow) {
    const result = this.#last.then(() => this.#carryOut(flow));
    this.#last = result.catch(() => {}); // the caller is told
    return result;
  }

  /**
   * @template Result
   * @param {Flow<Result>} flow
   * @returns {Promise<Result>}
   */
  async #carryOut(flow) {
    let step = flow.next();
    while (!step.done) {
      let result;
      try {
        result = await this.#connection.carryOut(step.value);
      } catch (error) {
        step = flow.throw(error);
        continue;
      }
      step = flow.next(result);
    }
    return step.value;
  }
}

/** A WebSocket to the world that carries out the steps of a dialogue. */
class Connection {
  /** @type {WebSocket | null} */
  #socket = null;
  /**
   * Frames that came and were not asked for yet.
   * @type {Uint8Array[]}
   */
  #frames = [];
  /** The reason why the socket closed. */
  #lost = new ConnectionLostError(t("there is no connection"));
  /** @type {Error | null} */
  #interruption = null;
  /** Called when anything has happened. */
  #wake = () => {};

  /**
   * @param {Step} step
   * @returns {Promise<Uint8Array | null>}
   */
  async carryOut({ open, send, receive, pause, close }) {
    if (receive) return this.#receive(receive);
    if (send) this.#send(send);
    else if (close) this.#close();
    else if (open) await this.#open(open);
    else await this.#happened(() => false, pause);
    return null;
  }

  /**
   * Reject the step that waits, and all that would wait later.
   * @param {Error} error
   */
  interrupt(error) {
    this.#interruption = error;
    this.#wake();
  }

  /** @param {number} timeout (ms) */
  async #open(timeout) {
    this.#close();
    const url = new URL(PATH, import.meta.url);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    const socket = (this.#socket = new WebSocket(url, SUBPROTOCOL));
    socket.binaryType = "arraybuffer";
    [this.#frames, this.#lost] = [[], null];
    socket.onopen = () => this.#wake();
    socket.onmessage = ({ data }) => {
      this.#frames.push(new Uint8Array(data));
      this.#wake();
    };
    socket.onclose = ({ code, reason }) => {
      if (this.#socket !== socket) return;
      this.#lost = new ConnectionLostError(reason || t("no answer"), code);
      this.#wake();
    };
    await this.#happened(() => socket.readyState === WebSocket.OPEN || this.#lost, timeout);
    if (this.#lost) throw this.#lost;
    if (socket.readyState !== WebSocket.OPEN) throw new ConnectionLostError(t("no answer"));
  }

  /** @param {Uint8Array<ArrayBuffer>} frame */
  #send(frame) {
    if (this.#socket?.readyState !== WebSocket.OPEN) {
      throw this.#lost ?? new ConnectionLostError(t("the connection is closing"));
    }
    this.#socket.send(frame);
  }

  /** @param {number} timeout (ms) */
  async #receive(timeout) {
    await this.#happened(() => this.#frames.length || this.#lost, timeout);
    if (this.#frames.length) return this.#frames.shift();
    if (this.#lost) throw this.#lost;
    return null;
  }

  #close() {
    this.#socket?.close();
    this.#socket = null;
    this.#lost ??= new ConnectionLostError(t("there is no connection"));
  }

  /**
   * Wait until something has happened, or for a time; reject if interrupted.
   * @param {() => unknown} has returns something if it has happened
   * @param {number} timeout (ms)
   * @returns {Promise<void>}
   */
  #happened(has, timeout) {
    return new Promise((resolve, reject) => {
      let timer = 0;
      const check = () => {
        if (!this.#interruption && !has()) return;
        clearTimeout(timer);
        this.#wake = () => {};
        if (this.#interruption) reject(this.#interruption);
        else resolve();
      };
      this.#wake = check;
      timer = setTimeout(() => {
        this.#wake = () => {};
        resolve();
      }, timeout);
      check();
    });
  }
}
