import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { openWindow } from "../browser.mjs";

openWindow();
const { openMission, progressOf, reach, setOpenMission } = await import("../../../web/missions/progress.js");
const { forget } = await import("../../../web/shared/storage.js");

/** Progress that the browser keeps. */
let kept;
beforeEach(() => {
  ({ kept } = openWindow());
  for (const key of ["missions-", "mission-"]) forget(key);
});

test("progress is never lost", () => {
  assert.deepEqual(progressOf("drive-1"), { steps: 0, stars: 0 });
  assert.equal(reach("drive-1", { steps: 4, stars: 1 }), true);
  assert.equal(reach("drive-1", { steps: 2, stars: 0 }), false);
  assert.equal(reach("drive-1", { steps: 1, stars: 3 }), true);
  assert.deepEqual(progressOf("drive-1"), { steps: 4, stars: 3 });
});

test("two pages keep what both have reached", () => {
  reach("drive-1", { steps: 2, stars: 0 });
  const other = JSON.parse(kept.get("ai4u-missions-"));
  kept.set("ai4u-missions-", JSON.stringify({ ...other, "sense-1": { steps: 1, stars: 0 } }));
  reach("drive-1", { steps: 3, stars: 0 });
  assert.deepEqual(progressOf("sense-1"), { steps: 1, stars: 0 });
});

test("storage may hold anything", () => {
  for (const text of ["[]", "null", '"x"', '{"drive-1": 7}', '{"drive-1": {"steps": "4", "stars": -1}}']) {
    kept.set("ai4u-missions-", text);
    assert.deepEqual(progressOf("drive-1"), { steps: 0, stars: 0 });
    assert.deepEqual(progressOf("toString"), { steps: 0, stars: 0 });
  }
  for (const text of ["[]", "7", '{"mission": 1}']) {
    kept.set("ai4u-mission-", text);
    assert.equal(openMission(), null);
  }
});

test("the open mission is kept, and students of a class have their own", () => {
  setOpenMission({ mission: "drive-1", step: 2 });
  assert.deepEqual(openMission(), { mission: "drive-1", step: 2, isHidden: false });
  ({ kept } = openWindow("http://world.example/r/seat-1/"));
  assert.equal(openMission(), null);
  setOpenMission({ mission: "drive-2", step: 0 });
  assert.equal(openMission().mission, "drive-2");
  setOpenMission(null);
  assert.equal(openMission(), null);
});
