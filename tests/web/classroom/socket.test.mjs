import assert from "node:assert/strict";
import { test } from "node:test";

import { answerWith, openWindow, send, settle } from "../browser.mjs";

openWindow("http://class.example/teacher");
let socket;
globalThis.WebSocket = class {
  static OPEN = 1;
  readyState = 1;
  constructor() {
    socket = this;
  }
};
const { openClassSocket } = await import("../../../web/classroom/socket.js");

test("messages go to what takes their type, and a lost connection is told until it is back", async () => {
  const [heard, said] = [[], []];
  let reloads = 0;
  location.reload = () => (reloads += 1);
  openClassSocket("teacher/socket", { class: ({ id }) => heard.push(id) }, (problem) => said.push(problem));
  socket.onopen();
  for (const message of [{ type: "class", id: 1 }, { type: "unknown" }]) socket.onmessage({ data: JSON.stringify(message) });
  send("offline");
  send("online");
  answerWith({ status: 200 });
  socket.onclose({ code: 1008, reason: "The class is over." });
  await settle();
  assert.deepEqual([heard, reloads], [[1], 0]);
  assert.deepEqual(said, ["", said[1], "", "The class is over."]);
  assert.match(said[1], /can't be reached/);
  answerWith({ status: 401 });
  socket.onclose({ code: 1008, reason: "" });
  await settle();
  assert.equal(reloads, 1);
});
