import assert from "node:assert/strict";
import { test } from "node:test";

import { dpadActions } from "../../../web/page/dpad.js";

test("the first known action of each direction is on the pad, in the pad's order", () => {
  const pad = dpadActions({ right: [], up: [], forward: [], turn_left: [], jump: [] });
  assert.deepEqual([...pad], [["up", "forward"], ["left", "turn_left"], ["right", "right"]]);
});

test("an agent without such actions has no pad", () => {
  assert.equal(dpadActions({ jump: ["Space"] }).size, 0);
});
