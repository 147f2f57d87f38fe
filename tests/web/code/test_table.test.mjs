import assert from "node:assert/strict";
import { test } from "node:test";

import { openWindow } from "../browser.mjs";

openWindow();
const { testWords } = await import("../../../web/code/test_table.js");

const rows = (...outcomes) => outcomes.map((outcome, index) => ({ outcome, decisions: 10 + index }));
const TEN_GOALS = Array(10).fill("goal");

test("a test that runs is told by the starts that have ended", () => {
  assert.equal(testWords({ rows: rows("goal", "fell", ""), isOn: true }), "1 of 2 reached the goal so far.");
});

test("with all goals, the decisions are told on average", () => {
  assert.equal(testWords({ rows: rows(...TEN_GOALS), isOn: false }), "10 of 10 reached the goal, in 15 decisions on average.");
});

test("a test that ended early says so, one that missed starts does not", () => {
  assert.equal(testWords({ rows: rows("goal", "mistake", ""), isOn: false }), "1 of 2 reached the goal; the test ended before all 10.");
  assert.equal(testWords({ rows: rows(...TEN_GOALS.slice(1), "time"), isOn: false }), "9 of 10 reached the goal.");
});
