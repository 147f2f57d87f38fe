import assert from "node:assert/strict";
import { test } from "node:test";

import { agentBlocks } from "../../../web/blocks/agent.js";
import { pythonOf } from "../../../web/blocks/python.js";

const AGENT = agentBlocks({
  sensors: [{ class: "Some", kind: "number", key: "near", shape: [], unit: "" }],
  actuators: [{ name: "move", is_choice: false, components: [{ name: "forward", low: -1, high: 1, has_effect: true }] }],
});
const num = (NUM) => ({ block: { type: "number", fields: { NUM } } });
const drive = (value, next) => ({ type: "act:move:0", id: "d", inputs: { VALUE: value }, ...(next && { next: { block: next } }) });
const near = { block: { type: "sense:near" } };

function lines(...stacks) {
  return pythonOf({ blocks: { blocks: stacks }, variables: [{ id: "v", name: "my count" }] }, AGENT);
}

function decided(block) {
  const { text } = lines({ type: "on_decision", id: "h", next: { block } });
  return text.split("\n").slice(2, -2).map((line) => line.slice(4));
}

function value(block) {
  return decided(drive({ block }))[0].replace("forward = ", "");
}

test("a program rests, does its blocks and returns the actions; each line knows its block", () => {
  const { text, blocks } = lines({ type: "on_decision", id: "h", next: { block: drive(num(0.5)) } });
  assert.equal(text, 'def decide(percept):\n    forward = 0\n    forward = 0.5\n    return {"move": [forward]}\n');
  assert.deepEqual(blocks, ["h", "h", "d", "h"]);
});

test("no blocks are a program, too", () => {
  assert.equal(pythonOf({}, AGENT).text, 'def decide(percept):\n    forward = 0\n    return {"move": [forward]}\n');
});

test("conditions, with an else that holds just an if as an elif", () => {
  const inner = { type: "if", inputs: { IF: { block: { type: "true_false", fields: { BOOL: "FALSE" } } } } };
  const outer = { type: "if_else", inputs: { IF: { block: { type: "compare", fields: { OP: "LT" }, inputs: { A: near, B: num(1) } } }, DO: { block: drive(num(-1)) }, ELSE: { block: inner } } };
  assert.deepEqual(decided(outer), ['if percept["near"] < 1:', "    forward = -1", "elif False:", "    pass"]);
  const two = { ...outer, inputs: { ...outer.inputs, ELSE: { block: { ...inner, next: { block: drive(num(0)) } } } } };
  assert.deepEqual(decided(two).slice(2), ["else:", "    if False:", "        pass", "    forward = 0"]);
});

test("repetition, output, rest, and a block that the robot has not", () => {
  assert.deepEqual(decided({ type: "repeat", fields: { TIMES: 2.6 }, inputs: { DO: { block: { type: "rest" } } } }), ["for _ in range(3):", "    forward = 0"]);
  assert.deepEqual(decided({ type: "print", fields: { TEXT: 'a "b"' }, inputs: { VALUE: near } }), ['print("a \\"b\\"", percept["near"])']);
  assert.deepEqual(decided({ type: "act:arm:0" }), ["pass  # this robot has no arm:0"]);
});

test("brackets stand where operators need them, and nowhere else", () => {
  const sum = { block: { type: "arithmetic", fields: { OP: "ADD" }, inputs: { A: num(1), B: num(2) } } };
  const times = (A, B, OP = "MULTIPLY") => ({ type: "arithmetic", fields: { OP }, inputs: { A, B } });
  assert.equal(value(times(sum, sum)), "(1 + 2) * (1 + 2)");
  assert.equal(value(times({ block: times(num(1), num(2), "MINUS") }, sum, "MINUS")), "1 - 2 - (1 + 2)");
  assert.equal(value(times(num(-2), num(-3))), "-2 * -3");
  assert.equal(value({ type: "not", inputs: { A: { block: { type: "and_or", fields: { OP: "or" } } } } }), "not (False or False)");
  assert.equal(value({ type: "and_or", fields: { OP: "and" }, inputs: { A: { block: { type: "not" } } } }), "not False and False");
  assert.equal(value({ type: "of_two", fields: { OP: "max" }, inputs: { A: sum } }), "max(1 + 2, 0)");
  assert.equal(value({ type: "absolute", inputs: { A: { shadow: { type: "number", fields: { NUM: -3 } } } } }), "abs(-3)");
});

test("a random number imports its module", () => {
  const { text } = lines({ type: "on_decision", next: { block: drive({ block: { type: "random" } }) } });
  assert.match(text, /^import random\n\n\ndef decide/);
  assert.match(text, /random\.uniform\(0, 1\)/);
});

test("functions that senses need stand below the program, each once", () => {
  const rays = { angles_deg: [0], codes: [], has_code: false, has_distance: true, reach: 1, reach_m: 1 };
  const agent = agentBlocks({ sensors: [{ class: "Rays", kind: "number", key: "r", shape: [1], unit: "", rays }], actuators: [] });
  const sense = { block: { type: "near:r", fields: { SIDE: "ahead" } } };
  const print = (next) => ({ type: "print", inputs: { VALUE: sense }, ...(next && { next: { block: next } }) });
  const { text } = pythonOf({ blocks: { blocks: [{ type: "on_decision", next: { block: print(print()) } }] } }, agent);
  assert.equal(text.split("def nearest").length, 2);
  assert.ok(text.indexOf("def decide") < text.indexOf("def nearest"));
});

test("memory makes a class that forgets at a reset", () => {
  const VAR = { id: "v" };
  const set = { type: "variables_set", fields: { VAR }, inputs: { VALUE: { block: { type: "variables_get", fields: { VAR } } } } };
  const { text } = lines({ type: "on_decision", next: { block: { ...set, next: { block: { type: "math_change", fields: { VAR }, inputs: { DELTA: num(2) } } } } } });
  assert.equal(
    text,
    "class Program:\n    def reset(self):\n        self.my_count = 0\n\n    def get_action(self, percept):\n        forward = 0\n" +
      '        self.my_count = self.my_count\n        self.my_count = self.my_count + 2\n        return {"move": [forward]}\n',
  );
});

test("what begins an episode is done at the reset, or with the first decision if it senses or acts", () => {
  const set = { type: "variables_set", fields: { VAR: { id: "v" } }, inputs: { VALUE: num(1) } };
  const begins = (block) => lines({ type: "on_begin", next: { block } }).text;
  assert.match(begins(set), /reset\(self\):\n {8}self.my_count = 0\n {8}self.my_count = 1\n\n/);
  assert.match(begins(drive(num(1))), /self.begins = True\n[^]*if self.begins:\n {12}self.begins = False\n {12}forward = 1\n/);
});

test("an event is done once, when its condition becomes true", () => {
  const touch = { type: "on_touch", id: "t", fields: { KEY: "bump" }, next: { block: drive(num(-1)) } };
  const becomes = { type: "on_becomes", id: "b" };
  const { text } = lines(touch, becomes);
  assert.match(text, /self.was_1 = False\n {8}self.was_2 = False\n/);
  assert.match(text, /is_1 = percept\["bump"\]\[0\] > 0\n {8}if is_1 and not self.was_1:\n {12}forward = -1\n {8}self.was_1 = is_1\n/);
  assert.match(text, /is_2 = False\n {8}if is_2 and not self.was_2:\n {12}pass\n/);
});
