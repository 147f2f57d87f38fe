import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { openWindow } from "../browser.mjs";

let socket;
globalThis.WebSocket = class {
  static OPEN = 1;
  readyState = 1;
  sent = [];
  constructor() {
    socket = this;
  }
  send(data) {
    this.sent.push(typeof data === "string" ? JSON.parse(data) : data.length);
  }
  hear(message) {
    this.onmessage({ data: JSON.stringify(message) });
  }
};
openWindow();
const { PanelSocket } = await import("../../../web/panel/socket.js");
let panel;

beforeEach(() => {
  panel = new PanelSocket("ws/panel");
  panel.open();
  socket.onopen();
});

test("answers find their commands, in any order", async () => {
  const answers = [panel.command("pause", {}), panel.command("speed", { speed: 2 })];
  assert.deepEqual(socket.sent, [{ type: "do", id: 1, command: "pause" }, { type: "do", id: 2, command: "speed", speed: 2 }]);
  socket.hear({ type: "failed", id: 2, text: "No", problems: ["speed"] });
  socket.hear({ type: "done", id: 1 });
  assert.deepEqual(await Promise.all(answers), [
    { ok: true, text: "", problems: [] },
    { ok: false, text: "No", problems: ["speed"] },
  ]);
});

test("a command without a connection, or whose connection is lost, fails with a sentence", async () => {
  const waiting = panel.command("pause", {});
  const states = [];
  panel.onconnected = (isConnected) => states.push(isConnected);
  socket.onopen();
  socket.readyState = 3;
  socket.onclose({ code: 1008, reason: "" });
  for (const answer of [await waiting, await panel.command("pause", {})]) {
    assert.equal(answer.ok, false);
    assert.match(answer.text, /Not connected/);
  }
  assert.deepEqual(states, [true, false]);
});

test("other messages are the panel's", () => {
  const heard = [];
  panel.onmessage = (message) => heard.push(message.type);
  socket.hear({ type: "part" });
  socket.hear({ type: "done", id: 99 });
  assert.deepEqual(heard, ["part"]);
});

test("a file is sent in parts, and what is looked at as one message", () => {
  panel.upload(new Uint8Array(2 ** 19 + 5));
  panel.show({ tabs: ["run"] });
  assert.deepEqual(socket.sent, [2 ** 18, 2 ** 18, 5, { type: "show", tabs: ["run"] }]);
});
