import assert from "node:assert/strict";
import { test } from "node:test";

import { openWindow } from "../browser.mjs";

const { kept } = openWindow();
const { forget, recall, remember } = await import("../../../web/shared/storage.js");

test("a value comes back, under a name of ours, until it is forgotten", () => {
  remember("size", { width: 3 });
  assert.equal(kept.get("ai4u-size"), '{"width":3}');
  assert.deepEqual(recall("size", null), { width: 3 });
  forget("size");
  assert.deepEqual([recall("size", "none"), kept.size], ["none", 0]);
});

test("a value that another page has kept is found", () => {
  kept.set("ai4u-theirs", "5");
  assert.equal(recall("theirs", 0), 5);
});

test("a false value is a value", () => {
  remember("tone", false);
  assert.equal(recall("tone", true), false);
});

test("what is no JSON counts as absent", () => {
  kept.set("ai4u-theirs", "{");
  assert.equal(recall("theirs", 7), 7);
});

test("without storage a value lasts as long as the page", () => {
  const blocked = () => {
    throw new Error("blocked");
  };
  globalThis.localStorage = { getItem: blocked, setItem: blocked, removeItem: blocked };
  remember("size", 5);
  assert.equal(recall("size", 0), 5);
  forget("size");
  assert.equal(recall("size", 0), 0);
});
