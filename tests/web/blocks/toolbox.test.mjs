import assert from "node:assert/strict";
import { test } from "node:test";

import { agentBlocks } from "../../../web/blocks/agent.js";
import { KINDS } from "../../../web/blocks/kinds.js";
import { definitions, memoryBlocks, toolbox } from "../../../web/blocks/toolbox.js";

const AGENT = agentBlocks({
  sensors: [{ class: "TouchSensor", kind: "number", key: "bump", shape: [1], unit: "" }],
  actuators: [{ name: "move", is_choice: false, components: [{ name: "forward", low: -1, high: 0.5, has_effect: true }] }],
});
const EMPTY = agentBlocks({});

function group(agent, name) {
  return toolbox(agent).contents.find((each) => each.name === name).contents;
}

test("each block of the toolbox is defined", () => {
  const known = new Set(definitions(AGENT).map(({ type }) => type));
  for (const { contents = [] } of toolbox(AGENT).contents) {
    for (const { type } of contents) assert.equal(known.has(type), true, type);
  }
});

test("an agent's own blocks come with the values that they begin with", () => {
  assert.deepEqual(group(AGENT, "Actions").map(({ type }) => type), ["act:move:0", "rest"]);
  assert.equal(group(AGENT, "Actions")[0].inputs.VALUE.shadow.fields.NUM, 0.5);
  assert.deepEqual(group(AGENT, "Senses").map(({ type }) => type), ["sense:bump"]);
  assert.equal(group(AGENT, "Events")[0].type, "on_touch");
  const own = definitions(AGENT).slice(KINDS.length);
  assert.deepEqual(own.map(({ type, style }) => `${type} ${style}`), ["sense:bump senses", "act:move:0 actions", "rest actions", "on_touch events"]);
});

test("a robot that can do nothing cannot rest, and one that touches nothing has no such event", () => {
  assert.deepEqual([group(EMPTY, "Actions"), group(EMPTY, "Events").map(({ type }) => type)], [[], ["on_becomes", "on_begin"]]);
  assert.equal(definitions(EMPTY).length, KINDS.length);
});

test("blocks that change a variable appear with the first one, for the latest", () => {
  const workspace = (...names) => ({
    getVariableMap: () => ({ getAllVariables: () => names.map((name) => ({ getId: () => `id ${name}`, getName: () => name })) }),
  });
  assert.deepEqual(memoryBlocks(workspace()).map(({ kind, type }) => type ?? kind), ["button", "print"]);
  const blocks = memoryBlocks(workspace("a", "b"));
  assert.deepEqual(blocks.map(({ type }) => type), [undefined, "variables_set", "math_change", "variables_get", "variables_get", "print"]);
  assert.deepEqual(blocks[1].fields.VAR, { id: "id b", name: "b" });
});

test("blocks of numbers hold values to begin with", () => {
  const held = Object.fromEntries(group(AGENT, "Numbers").map(({ type, inputs }) => [type, Object.values(inputs).map(({ shadow }) => shadow.fields.NUM)]));
  assert.deepEqual([held.compare, held.arithmetic, held.of_two, held.absolute, held.random], [[0, 0], [1, 1], [1, 2], [0], [-1, 1]]);
});

test("a group has the blocks of its style alone", () => {
  assert.deepEqual(group(AGENT, "Control").map(({ type }) => type), ["if", "if_else", "repeat"]);
});
