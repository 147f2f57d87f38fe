import assert from "node:assert/strict";
import { mock, test } from "node:test";

import { limits } from "../../../web/shared/limits.js";
import { retried } from "../../../web/shared/retry.js";
import { settle } from "../browser.mjs";

test("it tries again after pauses that double, and then gives up", async () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  limits.retryMs = 10;
  let tries = 0;
  const end = assert.rejects(retried(() => Promise.reject(new Error(`try ${(tries += 1)}`))), /try 5/);
  const seen = [];
  for (const pause of [9, 1, 19, 1, 39, 1, 79, 1]) {
    await settle();
    mock.timers.tick(pause);
    await settle();
    seen.push(tries);
  }
  await end;
  assert.deepEqual(seen, [1, 2, 2, 3, 3, 4, 4, 5]);
  mock.timers.reset();
});

test("the first success counts", async () => {
  assert.equal(await retried(async () => "module"), "module");
});
