import assert from "node:assert/strict";
import { test } from "node:test";

import { clock, number, percent, seconds } from "../../../web/shared/numbers.js";

test("a number has three digits that matter, and a real minus", () => {
  assert.deepEqual([0, 1.234, -12.34, 99.96, 100.4, -1234.5].map(number), ["0.00", "1.23", "−12.3", "100.0", "100", "−1235"]);
});

test("a number that is rounded to zero has no sign", () => {
  assert.equal(number(-0.001), "0.00");
});

test("what is no number is shown as it is, and nothing as a dash", () => {
  assert.deepEqual([null, undefined, Infinity, "far"].map(number), ["–", "–", "Infinity", "far"]);
});

test("a duration is in seconds, from a minute on in minutes", () => {
  assert.deepEqual([null, 0, 59.94, 60, 125.9, 600].map(seconds), ["–", "0.0 s", "59.9 s", "1:00 min", "2:05 min", "10:00 min"]);
});

test("a clock rounds up, and never runs below zero", () => {
  assert.deepEqual([-1, 0, 0.1, 59, 59.5, 125].map(clock), ["0:00", "0:00", "0:01", "0:59", "1:00", "2:05"]);
});

test("a share is rounded as Python does, halves to the even number", () => {
  assert.deepEqual([0, 0.346, 0.625, 0.635, 0.875, 1].map(percent), ["0%", "35%", "62%", "64%", "88%", "100%"]);
});
