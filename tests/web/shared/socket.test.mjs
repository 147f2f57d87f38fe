import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import { openWindow, send } from "../browser.mjs";

mock.timers.enable({ apis: ["setTimeout"] });
mock.method(Math, "random", () => 0.5); // no jitter
let sockets = [];
globalThis.WebSocket = class {
  static OPEN = 1;
  readyState = 0;
  sent = [];
  constructor(url) {
    this.url = String(url);
    sockets.push(this);
  }
  send(text) {
    this.sent.push(text);
  }
  close() {}
  connect() {
    this.readyState = 1;
    this.onopen();
  }
  lose(code = 1006, reason = "") {
    this.readyState = 3;
    this.onclose({ code, reason });
  }
};
const { JsonSocket } = await import("../../../web/shared/socket.js");
const { limits } = await import("../../../web/shared/limits.js");
/** The last part of a silence, see HEAR_MS: a timer of its own, which this clock begins at the end of a tick. */
const HEAR_MS = 500;
let socket;
let log;

beforeEach(() => {
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
  openWindow("https://class.example/r/a1/");
  [sockets, log] = [[], []];
  socket = new JsonSocket("ws/panel");
  socket.onopen = () => log.push("open");
  socket.onclose = (reason) => log.push(`close ${reason}`.trim());
  socket.onmessage = (message) => log.push(message);
  socket.onworldreplaced = () => log.push("replaced");
  socket.open();
});

test("the address is relative to the page, and as safe", () => {
  assert.equal(sockets[0].url, "wss://class.example/r/a1/ws/panel");
});

test("messages are JSON, and dropped while there is no connection", () => {
  socket.send({ lost: 1 });
  sockets[0].connect();
  socket.send({ held: [] });
  sockets[0].onmessage({ data: '{"type":"state"}' });
  assert.deepEqual(sockets[0].sent, ['{"held":[]}']);
  assert.deepEqual(log, ["open", { type: "state" }]);
  assert.equal(socket.isOpen, true);
});

test("it reconnects with growing pauses, which begin again after a success", () => {
  const pauses = [250, 500, 1000, 2000, 4000, 4000];
  for (const pause of pauses) {
    const count = sockets.length;
    sockets.at(-1).lose();
    mock.timers.tick(pause - 1);
    assert.equal(sockets.length, count);
    mock.timers.tick(1);
    assert.equal(sockets.length, count + 1);
  }
  sockets.at(-1).connect();
  sockets.at(-1).lose();
  mock.timers.tick(250);
  assert.equal(sockets.length, pauses.length + 2);
});

test("a refusal is told, and it does not reconnect", () => {
  sockets[0].lose(1008, "the class is full");
  mock.timers.tick(60_000);
  assert.deepEqual([log, sockets.length], [["close the class is full"], 1]);
});

test("another world is told before it reconnects", () => {
  sockets[0].connect();
  sockets[0].lose(1012, "not told");
  assert.deepEqual(log, ["open", "close", "replaced"]);
});

test("a network that comes back is tried at once, and only once", () => {
  sockets[0].lose();
  send("pageshow", { persisted: false });
  assert.equal(sockets.length, 1);
  send("online");
  assert.equal(sockets.length, 2);
  send("pageshow", { persisted: true });
  mock.timers.tick(300);
  assert.equal(sockets.length, 2);
});

test("a connection that does not open is given up", () => {
  mock.timers.tick(limits.openMs - HEAR_MS);
  mock.timers.tick(HEAR_MS - 1);
  assert.deepEqual(log, []);
  mock.timers.tick(1);
  assert.deepEqual(log, ["close"]);
});

test("silence counts only after a keepalive, which is no message", () => {
  sockets[0].connect();
  sockets[0].onmessage({ data: '{"type":"state"}' });
  mock.timers.tick(10 * limits.silenceMs);
  sockets[0].onmessage({ data: '{"type":"keepalive"}' });
  mock.timers.tick(limits.silenceMs - 1);
  sockets[0].onmessage({ data: '{"type":"state"}' });
  mock.timers.tick(limits.silenceMs - HEAR_MS);
  mock.timers.tick(HEAR_MS - 1);
  assert.deepEqual(log, ["open", { type: "state" }, { type: "state" }]);
  mock.timers.tick(1);
  assert.deepEqual(log.at(-1), "close");
});

test("a page that stood still hears first what has come meanwhile", (t) => {
  sockets[0].connect();
  let now = 0;
  const timers = [];
  t.mock.method(globalThis, "setTimeout", (run, delay) => {
    const timer = { run, due: now + delay };
    timers.push(timer);
    return timer;
  });
  t.mock.method(globalThis, "clearTimeout", (timer) => (timer.run = () => {}));
  sockets[0].onmessage({ data: '{"type":"keepalive"}' });
  timers.push({ run: () => sockets[0].onmessage?.({ data: '{"type":"state"}' }), due: limits.silenceMs + 1 });
  now = 60_000;
  const due = timers.filter((timer) => timer.due <= now);
  for (const timer of due.sort((one, other) => one.due - other.due)) timer.run();
  assert.deepEqual(log, ["open", { type: "state" }]);
});
