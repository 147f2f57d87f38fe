import assert from "node:assert/strict";
import { test } from "node:test";

import { agentBlocks, sideOf } from "../../../web/blocks/agent.js";
import { ATOM, COMPARISON, PRODUCT } from "../../../web/blocks/words.js";

const RAYS = { angles_deg: [-60, -10, 10, 60], codes: [["ball", 0.25]], has_code: true, has_distance: true, reach: 1, reach_m: 5 };

function sensed(sensor) {
  return agentBlocks({ sensors: [{ class: "Some", kind: "number", key: "box", shape: [], unit: "", ...sensor }] }).senses;
}

test("a number is read as it is, the latest of several moments", () => {
  const [{ type, message, output, python }] = sensed({ unit: "m" });
  assert.deepEqual([type, message, output, python({}).code], ["sense:box", "box (m)", "Number", 'percept["box"]']);
  assert.equal(sensed({ shape: [3], stack: 3 })[0].python({}).code, 'percept["box"][-1]');
  assert.equal(sensed({ kind: "bool" })[0].output, "Boolean");
});

test("a touch is a condition", () => {
  const [{ message, python }] = sensed({ class: "TouchSensor", shape: [1] });
  assert.deepEqual([message, python({})], ["box is touched", { code: 'percept["box"][0] > 0', order: COMPARISON, functions: [] }]);
});

test("an event is a condition", () => {
  const [{ message, python }] = sensed({ class: "EventSensor", shape: [1] });
  assert.deepEqual([message, python({}).code], ["box has just happened", 'percept["box"][0] > 0']);
});

test("named numbers are chosen by name, others by a statistic", () => {
  const slots = [{ name: "left", unit: "m", low: 0, high: 1 }, { name: "right", unit: "", low: null, high: null }];
  const [several] = sensed({ shape: [2], slots });
  assert.deepEqual(several.fields[0].options, [["left (m)", "0"], ["right", "1"]]);
  assert.deepEqual([several.python({ SLOT: "1" }).code, several.tooltip], ['percept["box"][1]', "left: 0 to 1; right"]);
  assert.equal(sensed({ shape: [1], slots: slots.slice(0, 1) })[0].python({}).code, 'percept["box"][0]');
  const [many] = sensed({ shape: [9] });
  assert.equal(many.python({ STAT: "max" }).code, 'percept["box"].max()');
});

test("a fan of rays tells distances, groups and directions", () => {
  const [near, sees, angle] = sensed({ shape: [8], rays: RAYS });
  assert.deepEqual(near.fields[0].options.map(([, name]) => name), ["around", "ahead", "left", "right"]);
  const distance = near.python({ SIDE: "ahead" });
  assert.deepEqual([distance.code, distance.order], ['5 * nearest(percept["box"][3:6:2], 1)', PRODUCT]);
  assert.equal(near.python({ SIDE: "left" }).code, '5 * nearest(percept["box"][7::2], 1)');
  assert.equal(sees.python({ GROUP: "ball", SIDE: "around" }).code, 'sees(percept["box"][::2], 0.25)');
  assert.equal(sees.python({ GROUP: "gone", SIDE: "right" }).code, 'sees(percept["box"][:2:2], -1)');
  assert.equal(angle.python({ GROUP: "ball" }).code, 'direction(percept["box"][::2], 0.25, [60, 10, -10, -60])');
});

test("rays with distances alone need no slices, and rays in metres no factor", () => {
  const [near, ...others] = sensed({ shape: [4], rays: { ...RAYS, has_code: false, reach: 5 } });
  assert.deepEqual([others.length, near.python({ SIDE: "around" }).code], [0, 'nearest(percept["box"], 5)']);
  assert.equal(near.python({ SIDE: "around" }).order, ATOM);
  assert.equal(near.python({ SIDE: "ahead" }).code, 'nearest(percept["box"][1:3], 5)');
});

test("texts and constants have no block", () => {
  assert.deepEqual(sensed({ kind: "text" }), []);
  assert.deepEqual(sensed({ class: "DoneSensor" }), []);
});

test("each number with effect is an action with a variable of its own, and rests as near to 0 as it can", () => {
  const component = (name, low, high, has_effect = true) => ({ name, low, high, has_effect });
  const { actions, outputs } = agentBlocks({
    actuators: [
      { name: "move", is_choice: false, components: [component("forward", -1, 1), component("turn", -2, 2), component("up", 0, 1, false)] },
      { name: "pick", is_choice: true, components: [component("", 1, 4)] },
    ],
  });
  assert.deepEqual(actions.map(({ message, start, variable }) => [message, start, variable]), [
    ["move: forward (-1 to 1) %1", 1, "move_forward"],
    ["move: turn (-2 left, 2 right) %1", 1, "move_turn"],
    ["pick (1 to 4) %1", 1, "pick"],
  ]);
  assert.deepEqual(outputs[0].parts[2], { rest: "0" });
  assert.equal(outputs[1].parts[0].rest, "1");
  const alone = agentBlocks({ actuators: [{ name: "move", components: [component("direction", -1, 1)] }] });
  assert.deepEqual([alone.actions[0].variable, alone.outputs[0].parts[0].title], ["direction_", "direction"]);
});

test("sides are parted 20 degrees from the heading", () => {
  const angles = [-21, -20, 0, 20, 21];
  assert.deepEqual(["right", "ahead", "left", "around"].map((side) => sideOf(side, angles)), [
    { first: 0, count: 1 },
    { first: 1, count: 3 },
    { first: 4, count: 1 },
    { first: 0, count: 5 },
  ]);
});
