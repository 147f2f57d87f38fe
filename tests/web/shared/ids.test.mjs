import assert from "node:assert/strict";
import { test } from "node:test";

import { freeId, randomId } from "../../../web/shared/ids.js";

test("each id of an element is new", () => {
  const ids = [freeId(), freeId(), freeId()];
  assert.equal(new Set(ids).size, 3);
  assert.match(ids[0], /^ai4u-\d+$/);
});

test("random ids have the wanted length, and differ", () => {
  assert.match(randomId(), /^[0-9a-f]{32}$/);
  assert.match(randomId(12), /^[0-9a-f]{24}$/);
  assert.notEqual(randomId(), randomId());
});
