import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { openWindow } from "../browser.mjs";

openWindow();
const { KeptPrograms } = await import("../../../web/code/keep.js");
const { forget, remember } = await import("../../../web/shared/storage.js");
let kept;

beforeEach(() => {
  openWindow();
  for (const key of ["code-sumo-0", "code-runs-sumo-0"]) forget(key);
  kept = new KeptPrograms();
  kept.open("sumo", "0");
});

test("each agent, scene and student has a program of its own", () => {
  kept.source = "pass";
  const other = new KeptPrograms();
  other.open("sumo", "1");
  assert.deepEqual([kept.source, other.source], ["pass", null]);
  location.pathname = "/r/room-1/";
  other.open("sumo", "0");
  assert.equal(other.source, null);
  kept.source = null;
  assert.equal(kept.source, null);
});

test("runs are kept newest first, each program once in a row", () => {
  for (const source of ["a", "a", "b", "a"]) kept.addRun(source);
  assert.deepEqual(kept.runs.map(({ source }) => source), ["a", "b", "a"]);
  assert.equal(typeof kept.runs[0].at, "number");
});

test("the oldest runs go, by their number and by their size", () => {
  for (let count = 0; count < 60; count += 1) kept.addRun(`run ${count}`);
  assert.deepEqual([kept.runs.length, kept.runs[0].source, kept.runs.at(-1).source], [50, "run 59", "run 10"]);
  kept.addRun("x".repeat(199_990));
  assert.deepEqual(kept.runs.map(({ source }) => source.length), [199_990, 6]);
});

test("what is no run is left out", () => {
  remember("code-runs-sumo-0", [{ at: 1, source: 5 }, { at: 2, source: "a" }]);
  assert.deepEqual(kept.runs, [{ at: 2, source: "a" }]);
  remember("code-runs-sumo-0", "runs");
  assert.deepEqual(kept.runs, []);
});
