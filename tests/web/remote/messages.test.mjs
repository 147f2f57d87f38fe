import assert from "node:assert/strict";
import { test } from "node:test";

import { actionFrame, FIELDS, frameOf, messageIn, resetFrame, valuesOf } from "../../../web/remote/messages.js";
import { decode, Encoder } from "../../../web/vendor/msgpack.js";

const packed = (...fields) => new Encoder().encode(fields);
const bytes = (list) => new Uint8Array(list.buffer);

test("a frame is one array: the kind, then the fields", () => {
  assert.deepEqual(decode(frameOf("order", 3, "wait")), ["order", 3, "wait"]);
});

test("an action's numbers are floats, its counts are not", () => {
  const frame = actionFrame({ episode: 1, step: 2, seq: 3 }, { move: [1, -0] });
  assert.deepEqual(decode(frame), ["action", 1, 2, 3, { move: [1, -0] }]);
  assert.deepEqual([...frame.slice(0, 11)], [0x95, 0xa6, ...Buffer.from("action"), 1, 2, 3]);
  assert.equal(frame.filter((byte) => byte === 0xcb).length, 2);
});

test("what is told goes behind an action and a reset", () => {
  const told = { goal: ["1", "2.5"] };
  assert.deepEqual(decode(actionFrame({ episode: 1, step: 2, seq: 3 }, {}, told)), ["action", 1, 2, 3, {}, told]);
  assert.deepEqual(decode(resetFrame(3, null, told)), ["reset", 3, null, told]);
  assert.deepEqual(decode(resetFrame(3, 7)), ["reset", 3, 7]);
});

test("fields are named, and what is missing is undefined", () => {
  assert.deepEqual(messageIn(packed("problem", "malformed", "oh", 4)), { type: "problem", code: "malformed", text: "oh", seq: 4 });
  assert.equal(messageIn(packed("bye")).reason, undefined);
});

test("a message of an unknown type is refused", () => {
  assert.throws(() => messageIn(packed("toString", 1)), /unknown type, toString/);
});

test("a welcome describes readings and outputs; bounds are numbers", () => {
  const reading = ["near", "box", 0, "<f4", [2], 0, bytes(new Float32Array([0])), bytes(new Float32Array([1, 2])), "m", true];
  const text = ["word", "text", 5, "", [], 0, null, null, "", true];
  const fields = FIELDS.welcome.map((name) => ({ readings: [reading, text], outputs: [["move", "box", -1, 1, true]] })[name] ?? 0);
  const welcome = messageIn(packed("welcome", ...fields));
  assert.deepEqual([welcome.readings[0].low, welcome.readings[0].high, welcome.readings[0].unit], [[0], [1, 2], "m"]);
  assert.deepEqual([welcome.readings[1].low, welcome.outputs[0].name], [[], "move"]);
});

test("readings come out of a percept's bytes by type, shape and place", () => {
  const reading = (key, dtype, shape, offset) => ({ key, kind: "box", dtype, shape, offset });
  const data = new Uint8Array([0, ...bytes(new Float32Array([0.5, 1.5, 2.5, 3.5])), ...bytes(new Int32Array([-7])), 200, 1]);
  const readings = [reading("grid", "<f4", [2, 2], 1), reading("count", "<i4", [], 17), reading("level", "|u1", [], 21), reading("is_on", "|b1", [1], 22)];
  assert.deepEqual(valuesOf(readings, { data, texts: [] }), { grid: [[0.5, 1.5], [2.5, 3.5]], count: -7, level: 200, is_on: [true] });
  assert.throws(() => valuesOf([reading("far", "<f4", [], 21)], { data, texts: [] }), /shorter/);
});

test("texts are given as they are, several as a list", () => {
  const text = (key, sensorType, offset) => ({ key, kind: "text", sensorType, offset });
  const values = valuesOf([text("word", 5, 1), text("words", "sstrings", 0)], { data: null, texts: ['["x", "y"]', "b"] });
  assert.deepEqual(values, { word: "b", words: ["x", "y"] });
});
