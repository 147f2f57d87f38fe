import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { openWindow } from "../browser.mjs";

openWindow();
const { KeptPrograms } = await import("../../../web/code/keep.js");
const { forget, remember } = await import("../../../web/shared/storage.js");
let kept;

beforeEach(() => {
  openWindow();
  for (const key of ["code-sumo-0", "code-runs-sumo-0", "code-programs-sumo-0"]) forget(key);
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

test("a program that was kept before there were names is the first one", () => {
  remember("code-sumo-0", "pass");
  assert.deepEqual([kept.name, kept.names, kept.source], ["Program 1", ["Program 1"], "pass"]);
});

test("programs are added, chosen, renamed and removed, and each keeps its text", () => {
  kept.source = "a";
  kept.add(kept.freeName("Program 1"), null);
  assert.deepEqual([kept.name, kept.names, kept.source], ["Program 2", ["Program 1", "Program 2"], null]);
  kept.source = "b";
  kept.add("Wall", "c");
  kept.choose("Program 1");
  assert.equal(kept.source, "a");
  kept.rename("Box");
  kept.choose("Program 2");
  assert.deepEqual([kept.source, kept.names], ["b", ["Box", "Program 2", "Wall"]]);
  kept.remove();
  assert.deepEqual([kept.name, kept.source, kept.names], ["Box", "a", ["Box", "Wall"]]);
  kept.choose("nothing has this name");
  assert.equal(kept.name, "Box");
  kept.remove();
  kept.remove();
  assert.deepEqual([kept.name, kept.source], ["Program 1", null]);
});

test("programs that are elsewhere are listed once, and the present one stays", () => {
  kept.source = "a";
  kept.learn(["Wall", "Program 1"]);
  kept.learn(["Wall"]);
  assert.deepEqual([kept.names, kept.name, kept.source], [["Program 1", "Wall"], "Program 1", "a"]);
  kept.choose("Wall");
  assert.equal(kept.source, null);
});

test("a name that is taken gets a number, and one that is too long is cut", () => {
  kept.add("Wall", "");
  assert.deepEqual([kept.freeName(" Wall "), kept.freeName("Box 9"), kept.freeName(""), kept.freeName("x".repeat(50)).length], ["Wall 2", "Box 9", "Program 2", 40]);
  kept.add("Wall 2", "");
  assert.equal(kept.freeName("Wall 2"), "Wall 3");
});

test("a list of programs from elsewhere can hold anything", () => {
  for (const list of ["no", [], [{ name: 3 }, null, { name: "a", source: 7 }]]) {
    remember("code-programs-sumo-0", { at: "x", list });
    assert.deepEqual([kept.name, kept.names], ["Program 1", ["Program 1"]]);
  }
  remember("code-programs-sumo-0", { at: 99, list: [{ name: "a", source: null }, { name: "b", source: "c" }] });
  assert.equal(kept.name, "b");
});
