/** A WebSocket for JSON messages that reconnects with backoff: of the keys and of the panel. */

import { limits } from "./limits.js";

const MIN_RECONNECT_MS = 250;
const MAX_RECONNECT_MS = 4000;
/** Last part of a silence (ms), which begins again after a page stood still: it hears first what has come meanwhile. */
const HEAR_MS = 500;
/** Close code of a refusal: the server would refuse again, so the page doesn't reconnect. */
const CLOSE_REFUSED = 1008;
/** Close code when another world has replaced this one. */
const CLOSE_WORLD_REPLACED = 1012;

export class JsonSocket {
  onopen = () => {};
  /** @type {(reason: string) => void} */
  onclose = () => {};
  /** @type {(message: any) => void} */
  onmessage = () => {};
  /** Called before it reconnects to another world. */
  onworldreplaced = () => {};

  /** Relative to the page, so it works behind any path prefix. */
  path;
  /** @type {WebSocket | null} */
  #socket = null;
  #reconnectMs = MIN_RECONNECT_MS;
  #timer = 0;
  /** Fires when nothing has been heard for too long. */
  #silence = 0;
  #hasKeepalives = false;

  /** @param {string} path relative to the page */
  constructor(path) {
    this.path = path;
    addEventListener("online", () => this.#reconnect());
    addEventListener("pageshow", (event) => event.persisted && this.#reconnect());
  }

  open() {
    const url = new URL(this.path, document.baseURI);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    const socket = (this.#socket = new WebSocket(url));
    this.#hasKeepalives = false;
    this.#giveUpAfter(limits.openMs);
    socket.onopen = () => {
      this.#reconnectMs = MIN_RECONNECT_MS;
      clearTimeout(this.#silence);
      this.onopen();
    };
    socket.onmessage = (event) => this.#receive(JSON.parse(event.data));
    socket.onclose = ({ code, reason }) => this.#closed(code, reason);
  }

  get isOpen() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /**
   * Send a message if connected, else drop it.
   * @param {object} message
   */
  send(message) {
    if (this.isOpen) this.#socket.send(JSON.stringify(message));
  }

  /**
   * Send bytes if connected, else drop them.
   * @param {Uint8Array<ArrayBuffer>} bytes
   */
  sendBytes(bytes) {
    if (this.isOpen) this.#socket.send(bytes);
  }

  /** @param {{type: string}} message */
  #receive(message) {
    const isKeepalive = message.type === "keepalive";
    this.#hasKeepalives ||= isKeepalive;
    if (this.#hasKeepalives) this.#giveUpAfter(limits.silenceMs);
    if (!isKeepalive) this.onmessage(message);
  }

  /**
   * @param {number} code
   * @param {string} reason
   */
  #closed(code, reason) {
    clearTimeout(this.#silence);
    this.#socket = null;
    this.onclose(code === CLOSE_REFUSED ? reason : "");
    if (code === CLOSE_REFUSED) return;
    if (code === CLOSE_WORLD_REPLACED) this.onworldreplaced();
    const jitter = 0.75 + Math.random() / 2;
    this.#timer = setTimeout(() => this.#reconnect(), this.#reconnectMs * jitter);
    this.#reconnectMs = Math.min(2 * this.#reconnectMs, MAX_RECONNECT_MS);
  }

  /**
   * Take the connection for lost after some time (ms). Without an answer the browser's own close would wait too.
   * @param {number} time
   */
  #giveUpAfter(time) {
    const socket = this.#socket;
    clearTimeout(this.#silence);
    const giveUp = () => {
      socket.onopen = socket.onmessage = socket.onclose = null;
      socket.close();
      this.#closed(0, "");
    };
    // two timers: in a page that stood still the first is late, and goes before the messages that have come
    const wait = () => (this.#silence = setTimeout(giveUp, HEAR_MS));
    this.#silence = setTimeout(wait, Math.max(time - HEAR_MS, 0));
  }

  #reconnect() {
    clearTimeout(this.#timer);
    if (this.#socket === null) this.open();
  }
}
