import assert from "node:assert/strict";
import { test } from "node:test";

import { namesOf, startProgram } from "../../../web/code/start.js";

const SENSORS = [
  { key: "box", title: "Box", shape: [2], values: [{ name: "left_edge" }, { name: "right" }] },
  { key: "rays", title: "Rays.", shape: [8, 2], stack: 3, values: [{ name: "0" }, { name: "1" }] },
  { key: "many", title: "Many", shape: [7], values: Array.from({ length: 7 }, (_, index) => ({ name: `v${index}` })) },
  { key: "speed", title: "Speed", shape: [] },
  { key: "done", class: "DoneSensor", title: "Done", shape: [] },
  { key: "word", title: "Word", shape: [], text: "go", help: "What is said." },
];
const ACTUATORS = [
  { name: "move", is_choice: false, components: [{ name: "forward", low: -1, high: 1, has_effect: true }, { name: "turn_rate", low: -1, high: 0.2, has_effect: true }] },
  { name: "pick", is_choice: true, components: [{ name: "", low: 1, high: 3, has_effect: true }] },
  { name: "arm", is_choice: false, components: [{ name: "", low: 0, high: 1, has_effect: false }] },
];

test("readings are told by names, by size, or in words", () => {
  assert.deepEqual(namesOf(SENSORS, []).readings.map(({ words }) => words), [
    "left edge, right",
    "rays, 8 x 2 numbers, now and 2 times before",
    "many, 7 numbers",
    "speed, 1 number",
    "what is said",
  ]);
});

test("actions are told with their ranges, and begin with a curve within their range", () => {
  assert.deepEqual(namesOf([], ACTUATORS).outputs, [
    { name: "move", words: "forward -1 to 1, turn rate -1 to 0.2", values: [{ name: "forward", value: 0.4 }, { name: "turn_rate", value: 0.2 }] },
    { name: "pick", words: "choice 1 to 3", values: [{ name: "", value: 1 }] },
    { name: "arm", words: "always 0", values: [{ name: "", value: 0 }] },
  ]);
});

test("the first program drives in a circle, with a name for each number that does something", () => {
  const wheels = { name: "drive", is_choice: false, components: [{ name: "left", low: -1, high: 1, has_effect: true }, { name: "right", low: -1, high: 1, has_effect: true }] };
  const names = namesOf(SENSORS.slice(3, 4), [ACTUATORS[0], wheels, ACTUATORS[1], ACTUATORS[2]]);
  assert.equal(
    startProgram(names),
    "def decide(percept):\n    forward = 0.4\n    turn_rate = 0.2\n    left = 0.4\n    right = 0.3\n" +
      '    return {"move": [forward, turn_rate], "drive": [left, right], "pick": [1], "arm": [0]}\n',
  );
});

test("the first program does not jump", () => {
  const legs = { name: "move", is_choice: false, components: [{ name: "forward", low: -1, high: 1, has_effect: true }, { name: "forward_jump", low: 0, high: 1, has_effect: true }] };
  assert.match(startProgram(namesOf([], [legs])), /"move": \[forward, 0\]/);
});
