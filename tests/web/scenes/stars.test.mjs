import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { openWindow } from "../browser.mjs";

openWindow();
const { allStars, earn, stars, starsOf } = await import("../../../web/scenes/stars.js");
const { forget, remember } = await import("../../../web/shared/storage.js");

beforeEach(() => {
  openWindow();
  forget("stars-");
});

test("more stars count, fewer don't, and a change is told", () => {
  let changes = 0;
  stars.addEventListener("change", () => (changes += 1));
  assert.deepEqual([earn("sumo", 2), earn("sumo", 1), earn("sumo", 2), earn("sumo", 3)], [true, false, false, true]);
  assert.deepEqual([starsOf("sumo"), starsOf("soccer"), changes], [3, 0, 2]);
});

test("what is no count of stars is neither earned nor believed", () => {
  for (const count of [0, 4, 1.5, "2"]) assert.equal(earn("sumo", count), false);
  remember("stars-", { sumo: 9, soccer: 1, forage: "2" });
  assert.deepEqual(allStars(), { soccer: 1 });
  for (const kept of [null, [1], "x"]) {
    remember("stars-", kept);
    assert.deepEqual(allStars(), {});
  }
});

test("a name of every object is no scene", () => {
  assert.equal(starsOf("toString"), 0);
});

test("students on one device have stars of their own", () => {
  earn("sumo", 2);
  location.pathname = "/r/room-1/";
  assert.equal(starsOf("sumo"), 0);
});

test("stars are kept of at most 200 scenes", () => {
  for (let count = 0; count < 200; count += 1) assert.equal(earn(`scene ${count}`, 1), true);
  assert.equal(earn("one more", 1), false);
  assert.equal(earn("scene 7", 2), true);
});
