import assert from "node:assert/strict";
import { mock, test } from "node:test";

import { answerWith, openWindow, settle } from "../browser.mjs";

mock.timers.enable({ apis: ["setTimeout"] });
openWindow("http://class.example/r/a1/");
const { syncStars } = await import("../../../web/classroom/student/stars.js");
const { earn } = await import("../../../web/scenes/stars.js");

test("stars that were earned while the class was away are sent once it is back", async () => {
  earn("maze", 2);
  const asked = answerWith(new Error("no network"), { body: { stars: {} } }, { body: { stars: { maze: 2 } } });
  await syncStars();
  mock.timers.tick(10_000);
  await settle();
  assert.deepEqual(asked.map(({ body }) => body), [undefined, undefined, '{"scene":"maze","stars":2}']);
});
