/** The panel's WebSocket: commands with answers, and the parts of the world's state that the page looks at. */

/**
 * @import { Show } from "../generated/messages.js"
 * @import { Answer, DoneMessage, FailedMessage, PanelMessage } from "../types/panel.js"
 */
import { JsonSocket } from "../shared/socket.js";
import { t } from "../shared/text.js";

/** Size of the parts in which a file is sent. */
const PART_BYTES = 2 ** 18;
const NOT_CONNECTED = t("Not connected to the world. The page reconnects by itself.");

export class PanelSocket {
  /**
   * Called with each message that is not an answer.
   * @type {(message: PanelMessage) => void}
   */
  onmessage = () => {};
  /**
   * Called with true when it connects, and with false when the connection is lost.
   * @type {(isConnected: boolean) => void}
   */
  onconnected = () => {};

  #socket;
  #lastId = 0;
  /**
   * Functions that take an answer, by the id of the command.
   * @type {Map<number, (answer: Answer) => void>}
   */
  #waiting = new Map();

  /** @param {string} path relative to the page */
  constructor(path) {
    this.#socket = new JsonSocket(path);
    this.#socket.onopen = () => this.onconnected(true);
    this.#socket.onclose = () => {
      for (const answer of this.#waiting.values()) answer({ ok: false, text: NOT_CONNECTED, problems: [] });
      this.#waiting.clear();
      this.onconnected(false);
    };
    this.#socket.onmessage = (message) => this.#receive(message);
  }

  open() {
    this.#socket.open();
  }

  /**
   * Send what the page looks at; dropped while there is no connection.
   * @param {Omit<Show, "type">} shown
   */
  show(shown) {
    this.#socket.send({ type: "show", ...shown });
  }

  /**
   * Send a command. The promise never rejects: {ok: true, text, ...} or {ok: false, text, problems, ...}.
   * @param {string} command
   * @param {object} [args]
   * @returns {Promise<Answer>}
   */
  command(command, args) {
    if (!this.#socket.isOpen) return Promise.resolve({ ok: false, text: NOT_CONNECTED, problems: [] });
    const id = (this.#lastId += 1);
    return new Promise((resolve) => {
      this.#waiting.set(id, resolve);
      this.#socket.send({ type: "do", id, command, ...args });
    });
  }

  /**
   * Send a file in parts; the next command says what to do with it.
   * @param {Uint8Array<ArrayBuffer>} bytes
   */
  upload(bytes) {
    for (let start = 0; start < bytes.length; start += PART_BYTES) {
      this.#socket.sendBytes(bytes.subarray(start, start + PART_BYTES));
    }
  }

  /** @param {PanelMessage | DoneMessage | FailedMessage} message */
  #receive(message) {
    if (message.type !== "done" && message.type !== "failed") return this.onmessage(message);
    const { type, id, ...rest } = message;
    this.#waiting.get(id)?.({ text: "", problems: [], ...rest, ok: type === "done" });
    this.#waiting.delete(id);
  }
}
