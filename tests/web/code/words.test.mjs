import assert from "node:assert/strict";
import { test } from "node:test";

import { runWords } from "../../../web/code/words.js";

const OFF = { phase: "off", decision: 0, start: 0, success: "touch", isPerson: false, isPaused: false, python: "ready", end: null };
const words = (changes) => Object.values(runWords({ ...OFF, ...changes })).join("|");
const ended = (end, changes = {}) => words({ end: { reason: "over", percept: { terms: {} }, line: null, summary: "", ...end }, decision: 9, ...changes });

test("a run is told by its phase", () => {
  assert.equal(words({}), "off|Ready|");
  assert.equal(words({ phase: "loading" }), "busy|Getting Python ready (first time only) …|");
  assert.equal(words({ phase: "joining" }), "busy|The program gets the robot …|");
  assert.equal(words({ phase: "running", decision: 4 }), "on|Runs|decision 4");
  assert.equal(words({ phase: "waiting", waitsAt: 7, decision: 4 }), "on|Waits at line 7|decision 4");
  assert.equal(words({ phase: "running", isPaused: true, decision: 4 }), "busy|The world is paused|decision 4");
  assert.equal(words({ phase: "running", isPerson: true, isPaused: true }), "busy|You're driving. Press Let go to give the robot back to your program.|");
  assert.equal(words({ phase: "stepping", decision: 4 }), "on|Waits for the next step|decision 4");
});

test("a test is told with its start", () => {
  assert.equal(words({ phase: "testing", start: 3 }), "on|Tests the program|start 3");
  assert.equal(words({ phase: "testing" }), "on|Tests the program|");
  assert.equal(words({ phase: "testing", start: 3, isPaused: true }), "busy|The world is paused|start 3");
});

test("Python that loads or is missing is told before the first run only", () => {
  assert.equal(words({ python: "loading" }), "off|Getting Python ready (first time only) …|");
  assert.equal(words({ python: "No network." }), "bad|No network.|");
  assert.equal(ended({}, { python: "loading" }), "off|The episode ended, after 9 decisions.|");
});

test("the end is told with its reason", () => {
  assert.equal(ended({ percept: { terms: { touch: 1 } } }), "done|Goal reached! Your program decided 9 times.|");
  assert.equal(ended({ percept: { terms: { touch: 1 } } }, { decision: 1 }), "done|Goal reached! Your program decided 1 time.|");
  assert.equal(ended({ percept: { terms: { touch: 0 } } }), "off|The episode ended, after 9 decisions.|");
  assert.equal(ended({ percept: { terms: { touch: 1 } } }, { success: "" }), "off|The episode ended, after 9 decisions.|");
  assert.equal(ended({ outcome: "fell" }), "off|The robot fell, after 9 decisions.|");
  assert.equal(ended({ percept: { terms: {}, truncated: true } }, { decision: 1 }), "off|Time is up, after 1 decision.|");
  assert.equal(ended({ reason: "stopped" }, { decision: 0 }), "off|Stopped; the robot is yours|");
  assert.equal(ended({ reason: "mistake", line: 3 }), "bad|Stopped: there's a mistake in line 3.|");
  assert.equal(ended({ reason: "mistake" }, { isPaused: true }), "bad|Stopped: there's a mistake in your program. The world waits.|");
  assert.equal(ended({ reason: "lost" }), "bad|The run ended at decision 9|");
  assert.equal(ended({ reason: "tested", summary: "8 of 10 starts" }), "done|8 of 10 starts|");
});
