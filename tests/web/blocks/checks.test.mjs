import assert from "node:assert/strict";
import { test } from "node:test";

import { CHECKS, seen } from "../../../web/blocks/checks.js";

const [reachesWall, stopsInTime, turnsAway, followsWall, findsExit] = CHECKS;
const FAR = { around: 2, ahead: 2, right: 2, forward: 1, turn: 0 };

function after(check, ...decisions) {
  const made = check();
  for (const decision of decisions) made.see({ ...FAR, ...decision });
  return made;
}

test("distances and actions are read from the rays and the actuator that has forward", () => {
  const part = {
    sensors: [{ key: "rays", stack: 1, rays: { angles_deg: [-60, 0, 60], has_code: true, has_distance: true, reach: 1, reach_m: 4 } }],
    actuators: [{ name: "move", components: [{ name: "turn" }, { name: "forward" }] }],
  };
  const percept = { rays: [9, 0.5, 9, 0, 9, 0.25] };
  assert.deepEqual(seen(part, { percept, action: { move: [0.1, 0.9] } }), { around: 1, ahead: 4, right: 2, forward: 0.9, turn: 0.1 });
  assert.equal(seen(part, { percept, action: {} }), null);
  assert.equal(seen({ ...part, sensors: [{ ...part.sensors[0], stack: 2 }] }, { percept, action: { move: [0, 0] } }), null);
});

test("the wall is reached by driving there", () => {
  assert.equal(after(reachesWall, {}, { around: 0.44 }).isDone, true);
  assert.equal(after(reachesWall, {}, { around: 0.45 }).isDone, false);
  assert.equal(after(reachesWall, { forward: 0 }, { around: 0.4 }).isDone, false);
  assert.equal(after(reachesWall, { around: 0.6 }, { around: 0.4 }).isDone, false);
});

test("the robot stands still for ten decisions, without a touch", () => {
  const still = Array.from({ length: 10 }, () => ({ forward: 0 }));
  assert.equal(after(stopsInTime, {}, ...still).isDone, true);
  assert.equal(after(stopsInTime, {}, ...still.slice(1)).isDone, false);
  assert.equal(after(stopsInTime, ...still).isDone, false);
  assert.equal(after(stopsInTime, {}, ...still.map((each) => ({ ...each, around: 0.4 }))).isDone, false);
  assert.equal(after(stopsInTime, {}, ...still.slice(5), { forward: 0, turn: 1 }, ...still.slice(5)).isDone, false);
});

test("three walls are turned away from", () => {
  const wall = [{ ahead: 0.8 }, { ahead: 1.3 }];
  const two = after(turnsAway, ...wall, ...wall);
  assert.deepEqual([two.isDone, two.words], [false, "2 of 3 walls"]);
  assert.equal(after(turnsAway, ...wall, ...wall, ...wall).isDone, true);
  assert.equal(after(turnsAway, ...wall, ...wall, { ahead: 0.8 }, { ahead: 1.1 }).isDone, false);
  assert.equal(after(turnsAway, ...wall, ...wall, { ahead: 0.8 }, { ahead: 1.3, forward: 0 }).isDone, false);
});

test("a wall is followed for three quarters of the latest decisions", () => {
  const decisions = (near, length) => Array.from({ length }, (_, index) => ({ right: index < near ? 1 : 2 }));
  assert.equal(after(followsWall, ...decisions(225, 300)).isDone, true);
  assert.equal(after(followsWall, ...decisions(224, 300)).isDone, false);
  assert.equal(after(followsWall, ...decisions(299, 299)).isDone, false);
  assert.equal(after(followsWall, ...decisions(300, 300).map((each) => ({ ...each, forward: 0 }))).isDone, false);
  assert.equal(after(followsWall, ...decisions(0, 300), ...decisions(300, 225)).words, "beside a wall in 75% of 300 decisions");
});

test("eight of the starts of a test reach the exit", () => {
  const check = findsExit();
  const rows = (goals) => Array.from({ length: 10 }, (_, index) => ({ outcome: index < goals ? "goal" : "time" }));
  check.test(rows(7));
  assert.deepEqual([check.isDone, check.words], [false, "7 of 10 starts"]);
  check.test(rows(8));
  assert.equal(check.isDone, true);
});
