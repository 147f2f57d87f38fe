import assert from "node:assert/strict";
import { test } from "node:test";

import { openWindow } from "../browser.mjs";

openWindow();
const { goalWords, starsOfRun, starsOfTest } = await import("../../../web/code/stars.js");

const GOALS = { count: 3, few_decisions: 80 };
const starts = (goals, decisions = 50) => Array.from({ length: 10 }, (_, index) => ({ outcome: index < goals ? "goal" : "time", decisions }));

test("a scene has as many goals as it has stars", () => {
  assert.deepEqual([1, 2, 3].map((count) => goalWords({ ...GOALS, count }).length), [1, 2, 3]);
  assert.match(goalWords(GOALS)[2], /80 decisions or fewer/);
});

test("a run earns a star if it ended at the goal", () => {
  const earned = (reason, terms, success = "touch") => starsOfRun({ reason, percept: terms && { terms } }, success);
  assert.equal(earned("over", { touch: 1 }), 1);
  assert.equal(earned("over", { touch: 0 }), 0);
  assert.equal(earned("over", {}), 0);
  assert.equal(earned("stopped", null), 0);
  assert.equal(earned("over", { touch: 1 }, ""), 0);
});

test("a test earns two stars if all starts reached the goal, and three in few decisions", () => {
  assert.equal(starsOfTest(starts(10, 80), "tested", GOALS), 3);
  assert.equal(starsOfTest(starts(10, 81), "tested", GOALS), 2);
  assert.equal(starsOfTest(starts(10, 1), "tested", { count: 2, few_decisions: null }), 2);
});

test("a test that missed a start, or was stopped, earns one star at most", () => {
  assert.equal(starsOfTest(starts(9), "tested", GOALS), 1);
  assert.equal(starsOfTest(starts(10), "stopped", GOALS), 1);
  assert.equal(starsOfTest(starts(0), "tested", GOALS), 0);
});
