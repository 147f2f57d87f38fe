import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";

import { answerWith, openWindow, settle } from "../browser.mjs";

const ROOM = "http://class.example/r/a1/";
mock.timers.enable({ apis: ["setTimeout"] });
openWindow(ROOM);
const progress = await import("../../../web/missions/progress.js");
const { forget } = await import("../../../web/shared/storage.js");

let count = 0;
/** Return the module as a new page has it. */
async function opened(address = ROOM) {
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
  openWindow(address);
  count += 1;
  return import(`../../../web/classroom/student/missions.js?${count}`);
}

beforeEach(() => {
  openWindow(ROOM);
  for (const key of ["missions-a1/", "mission-a1/"]) forget(key);
});

// the module of each test would hear of the next one's progress
afterEach(async () => {
  answerWith({ status: 403 });
  progress.reach(`end-${count}`, { steps: 1, stars: 0 });
  await settle();
});

const sent = (asked) => asked.map(({ body }) => (body ? JSON.parse(body) : null));
const has = (missions) => ({ body: { missions } });

test("what the class has comes here, and what it has not is sent", async () => {
  const { syncMissions } = await opened();
  progress.reach("drive-1", { steps: 2, stars: 0 });
  const both = { "drive-1": { steps: 2, stars: 1 }, "drive-2": { steps: 3, stars: 1 } };
  const asked = answerWith(has({ "drive-1": { steps: 1, stars: 1 }, "drive-2": { steps: 3, stars: 1 } }), has(both));
  await syncMissions();
  assert.deepEqual(progress.allProgress(), both);
  assert.deepEqual(sent(asked), [null, { missions: { "drive-1": { steps: 2, stars: 1 } } }]);
});

test("more that is reached is sent at once, with the place", async () => {
  const { syncMissions, tellPlace } = await opened();
  const asked = answerWith(has({}));
  await syncMissions();
  progress.reach("drive-1", { steps: 1, stars: 0 });
  await settle();
  tellPlace({ mission: "drive-1", step: 1 });
  tellPlace({ mission: "drive-1", step: 1 });
  await settle();
  assert.deepEqual(sent(asked).slice(1), [
    { missions: { "drive-1": { steps: 1, stars: 0 } } },
    { missions: {}, place: { mission: "drive-1", step: 1 } },
  ]);
});

test("while the class is away, everything is kept here and sent later", async () => {
  const { syncMissions, tellPlace } = await opened();
  const asked = answerWith(new Error("no network"), { status: 507 }, has({}), has({ "drive-1": { steps: 2, stars: 0 } }));
  await syncMissions();
  progress.reach("drive-1", { steps: 1, stars: 0 });
  tellPlace({ mission: "drive-1", step: 1 });
  progress.reach("drive-1", { steps: 2, stars: 0 });
  tellPlace({ mission: "drive-1", step: 2 });
  await settle();
  mock.timers.tick(10_000);
  await settle();
  mock.timers.tick(10_000);
  await settle();
  const report = { missions: { "drive-1": { steps: 2, stars: 0 } }, place: { mission: "drive-1", step: 2 } };
  assert.deepEqual(sent(asked).at(-1), report);
  const before = asked.length;
  mock.timers.tick(60_000);
  await settle();
  assert.equal(asked.length, before);
});

test("a mission that the class does not have, or has with fewer steps, is not sent again and again", async () => {
  const { syncMissions } = await opened();
  progress.reach("gone", { steps: 4, stars: 1 });
  progress.reach("shorter", { steps: 4, stars: 1 });
  const asked = answerWith(has({}), has({ shorter: { steps: 2, stars: 1 } }));
  await syncMissions();
  progress.reach("drive-1", { steps: 1, stars: 0 });
  await settle();
  assert.equal(asked.length, 3);
  assert.deepEqual(Object.keys(sent(asked)[2].missions), ["drive-1"]);
});

test("what the class refuses is not sent again", async () => {
  const { syncMissions } = await opened();
  progress.reach("drive-1", { steps: 1, stars: 0 });
  const asked = answerWith(has({}), { status: 422, body: { problem: "no" } });
  await syncMissions();
  mock.timers.tick(60_000);
  await settle();
  assert.equal(asked.length, 2);
});

test("a page without a class, or that the class does not know, tells nothing", async () => {
  for (const [address, expected] of [["http://world.example/", 0], [ROOM, 1]]) {
    const { syncMissions, tellPlace } = await opened(address);
    const asked = answerWith({ status: 403 });
    await syncMissions();
    tellPlace({ mission: "drive-1", step: 1 });
    mock.timers.tick(60_000);
    await settle();
    assert.equal(asked.length, expected);
  }
});
