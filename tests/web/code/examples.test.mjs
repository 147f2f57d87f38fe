import assert from "node:assert/strict";
import { test } from "node:test";

import { openWindow } from "../browser.mjs";

openWindow();
const { EXAMPLES, exampleProgram } = await import("../../../web/code/examples.js");

const number = (name, low = -1) => ({ name, low, high: 1, has_effect: true });
const ROBOT = { actuators: [{ name: "move", is_choice: false, components: [number("forward"), number("turn")] }], sensors: [] };
const RAYS = { angles_deg: [-30, 0, 30], has_code: false, has_distance: true, codes: [], reach: 1, reach_m: 4 };
const VISION = { key: "vision", class: "LinearRayCastingSensor", kind: "number", unit: "", shape: [3], rays: RAYS };
const example = (name) => EXAMPLES.find((each) => each.name === name);

test("an example is written for the robot's own senses", async () => {
  const { python, blocks } = await exampleProgram(example("avoid"), { ...ROBOT, sensors: [VISION] });
  assert.match(python, /if 4 \* nearest\(percept\["vision"\]\[1:2\], 1\) < 0\.8:/);
  assert.deepEqual(blocks, example("avoid").blocks());
});

test("a robot without these senses has no such example", async () => {
  assert.equal(await exampleProgram(example("avoid"), ROBOT), null);
  assert.equal(await exampleProgram(example("square"), { ...ROBOT, actuators: [] }), null);
  assert.notEqual(await exampleProgram(example("square"), ROBOT), null);
});
