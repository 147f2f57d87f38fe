import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { CodeTimeline } from "../../../web/code/timeline.js";

let timeline;

beforeEach(() => (timeline = new CodeTimeline()));

function add(episode, number, { source = "a", printed = "", lines = [1], variables = {} } = {}) {
  timeline.add(episode, number, source, { lines, variables, printed });
}

test("a decision is found by episode and number, each line of it once", () => {
  add(3, 1, { lines: [2, 2, 5], variables: { near: "0.9" }, printed: "hi" });
  assert.deepEqual(timeline.at(3, 1), { source: "a", lines: [2, 5], variables: { near: "0.9" }, printed: "hi" });
  assert.deepEqual([timeline.at(3, 2), timeline.at(4, 1)], [null, null]);
});

test("another program, or a count that begins again, drops what was known of the episode", () => {
  add(3, 1);
  add(3, 2);
  add(3, 2, { printed: "again" });
  assert.deepEqual([timeline.at(3, 1), timeline.at(3, 2).printed], [null, "again"]);
  add(3, 3, { source: "b" });
  assert.deepEqual([timeline.at(3, 2), timeline.at(3, 3).source], [null, "b"]);
});

test("the oldest decisions are dropped, by their number", () => {
  for (let number = 1; number <= 20_001; number += 1) add(number <= 2 ? 1 : 2, number);
  assert.equal(timeline.at(1, 1), null);
  assert.notEqual(timeline.at(1, 2), null);
  add(2, 20_002);
  assert.equal(timeline.at(1, 2), null);
  assert.notEqual(timeline.at(2, 3), null);
});

test("the oldest decisions are dropped, by their size", () => {
  const large = { printed: "x".repeat(1_000_000), variables: { name: "y".repeat(999_000) } };
  add(1, 1, large);
  add(1, 2, large);
  assert.notEqual(timeline.at(1, 1), null);
  add(1, 3, { printed: "x".repeat(3000) });
  assert.deepEqual([timeline.at(1, 1), timeline.at(1, 2) === null], [null, false]);
});

test("what was dropped or cleared leaves room", () => {
  const large = { printed: "x".repeat(3_000_000) };
  add(1, 1, large);
  add(1, 1, large);
  assert.notEqual(timeline.at(1, 1), null);
  timeline.clear();
  assert.equal(timeline.at(1, 1), null);
  add(2, 1, large);
  assert.notEqual(timeline.at(2, 1), null);
});
