import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import { outcomeOf, WorldSpeed } from "../../../web/code/speed.js";
import { limits } from "../../../web/shared/limits.js";
import { settle } from "../browser.mjs";

class FakePanel extends EventTarget {
  sent = [];
  run = { speed: 2 };
  part() {
    return this.run;
  }
  async send(_, { speed }) {
    this.sent.push(speed);
  }
  tell(type, detail = null) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}
let panel;

beforeEach(() => (panel = new FakePanel()));

test("the world comes back to its speed, once", async () => {
  const speed = new WorldSpeed(panel);
  await speed.restore();
  panel.tell("connected");
  await speed.max();
  await speed.max();
  await speed.restore();
  await speed.restore();
  assert.deepEqual(panel.sent, ["max", "max", 2]);
});

test("a world that says no speed runs at its own pace", async () => {
  panel.run = undefined;
  const speed = new WorldSpeed(panel);
  await speed.max();
  await speed.restore();
  assert.deepEqual(panel.sent, ["max", 1]);
});

test("the old speed is sent again after a lost connection, until the world has it", async () => {
  const speed = new WorldSpeed(panel);
  await speed.max();
  panel.tell("connected");
  assert.deepEqual(panel.sent, ["max"]);
  await speed.restore();
  panel.tell("part:run", { speed: "max" });
  panel.tell("connected");
  panel.tell("part:run", { speed: 2 });
  panel.tell("connected");
  assert.deepEqual(panel.sent, ["max", 2, 2]);
});

test("the outcome is the panel's word for that decision of that start", async () => {
  let word = null;
  outcomeOf(panel, { step: 7 }, 3).then((outcome) => (word = outcome));
  for (const run of [{ result: "fell", decision: 6, seed: "3" }, { result: "fell", decision: 7, seed: "4" }, { result: "", decision: 7, seed: "3" }]) {
    panel.run = run;
    panel.tell("part:run");
    await settle();
    assert.equal(word, null);
  }
  panel.run = { result: "lost", decision: 7, seed: "3" };
  panel.tell("part:run");
  await settle();
  assert.equal(word, "lost");
});

test("without a word in time the episode is just over", async () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  let word = null;
  outcomeOf(panel, { step: 7 }, 3).then((outcome) => (word = outcome));
  mock.timers.tick(limits.outcomeMs - 1);
  await settle();
  assert.equal(word, null);
  mock.timers.tick(1);
  await settle();
  assert.equal(word, "over");
  mock.timers.reset();
});
