import assert from "node:assert/strict";
import { test } from "node:test";

import { openWindow } from "../browser.mjs";

openWindow();
const { score } = await import("../../../web/classroom/tournament/tables.js");

test("points are written as in chess", () => {
  assert.deepEqual([[0, 0], [0, 1], [1, 0], [2, 1], [1, 2]].map(score), ["0", "½", "1", "2½", "2"]);
});
