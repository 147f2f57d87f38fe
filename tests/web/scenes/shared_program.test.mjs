import assert from "node:assert/strict";
import { test } from "node:test";

import { openWindow } from "../browser.mjs";

openWindow();
const { forgetShared, keepShared, sharedFor, sharedPrograms } = await import("../../../web/scenes/shared_program.js");
const { remember } = await import("../../../web/shared/storage.js");

test("a program is for one agent in one scene, until it is forgotten; each change is told", () => {
  let changes = 0;
  sharedPrograms.addEventListener("change", () => (changes += 1));
  keepShared({ scene: "sumo", agent: "0", source: "pass" });
  assert.deepEqual([sharedFor("sumo", "0"), sharedFor("sumo", "1"), sharedFor("soccer", "0")], ["pass", null, null]);
  forgetShared();
  assert.deepEqual([sharedFor("sumo", "0"), changes], [null, 2]);
});

test("what is no text is no program", () => {
  remember("shared-program-", { scene: "sumo", agent: "0", source: 5 });
  assert.equal(sharedFor("sumo", "0"), null);
});
