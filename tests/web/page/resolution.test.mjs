import assert from "node:assert/strict";
import { test } from "node:test";

import { nextResolution } from "../../../web/page/resolution.js";

test("a slow picture gets as few pixels as its rate asks for, within limits", () => {
  assert.equal(nextResolution(14, 1, 1), 0.7);
  assert.equal(nextResolution(3, 1, 1), 0.65);
  assert.equal(nextResolution(14, 2, 2), 1.35);
});

test("a picture that is neither slow nor fast stays as it is", () => {
  assert.equal(nextResolution(30, 0.7, 1), 0.7);
  assert.equal(nextResolution(30, 1, 1), null);
});

test("a fast picture gets more pixels, at last viser's own resolution", () => {
  assert.equal(nextResolution(59, 0.7, 1), 0.8);
  assert.equal(nextResolution(59, 0.9, 1), null);
  assert.equal(nextResolution(59, 2, 2), null);
});
