/** The input socket: says what is held, hears who drives and how the world is; comes back by itself. */

const SOONEST = 250;
const LATEST = 4000;
/** The server's way of saying that it would say no again. */
const REFUSED = 1008;
/** The server's way of saying that another world has taken this one's place. */
const ANOTHER = 1012;

export class InputSocket {
  onopen = () => {};
  onclose = (_reason) => {};
  onmessage = (_message) => {};
  /** Called before it comes back to another world. */
  onanother = () => {};

  /** Relative to the page, so that it holds under any prefix. */
  path;
  #socket = null;
  #wait = SOONEST;
  #timer = 0;

  /** @param {string} path relative to the page */
  constructor(path) {
    this.path = path;
    addEventListener("online", () => this.#again());
    addEventListener("pageshow", (event) => event.persisted && this.#again());
  }

  open() {
    const url = new URL(this.path, document.baseURI);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    const socket = (this.#socket = new WebSocket(url));
    socket.onopen = () => {
      this.#wait = SOONEST;
      this.onopen();
    };
    socket.onmessage = (event) => this.onmessage(JSON.parse(event.data));
    socket.onclose = ({ code, reason }) => {
      this.#socket = null;
      this.onclose(code === REFUSED ? reason : "");
      if (code === REFUSED) return;
      if (code === ANOTHER) this.onanother();
      this.#timer = setTimeout(() => this.#again(), this.#wait * (0.75 + Math.random() / 2));
      this.#wait = Math.min(2 * this.#wait, LATEST);
    };
  }

  /** Says something, if somebody listens; what is said to nobody is not kept. */
  send(message) {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(message));
  }

  #again() {
    clearTimeout(this.#timer);
    if (this.#socket === null) this.open();
  }
}
