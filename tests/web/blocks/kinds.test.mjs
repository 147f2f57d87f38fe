import assert from "node:assert/strict";
import { test } from "node:test";

import { blockOf, KINDS } from "../../../web/blocks/kinds.js";

test("only blocks of an agent are its own", () => {
  assert.deepEqual(["if", "number", "act:move:0", "sense:box"].map((type) => blockOf(type).isOwn), [false, false, true, true]);
});

test("each block has a place for each of its inputs, in their order", () => {
  for (const { type, message0, args0 } of KINDS) {
    const places = [...message0.matchAll(/%(\d)/g)].map(([, place]) => Number(place));
    assert.deepEqual(places, args0.map((_, index) => index + 1), type);
  }
});

test("a statement joins others, a value has an output, and a hat begins", () => {
  const kinds = Object.fromEntries(KINDS.map((kind) => [kind.type, kind]));
  assert.equal("previousStatement" in kinds.if && "nextStatement" in kinds.if, true);
  assert.deepEqual([kinds.compare.output, kinds.number.output, "nextStatement" in kinds.number], ["Boolean", "Number", false]);
  assert.deepEqual(["nextStatement" in kinds.on_begin, "previousStatement" in kinds.on_begin], [true, false]);
});

test("inputs stand in one line, and what can be chosen differs in words and value", () => {
  for (const { type, style, inputsInline, args0 } of KINDS) {
    assert.equal(inputsInline, style === "events" ? undefined : true, type);
    for (const { options = [] } of args0) {
      for (const column of [0, 1]) assert.equal(new Set(options.map((option) => option[column])).size, options.length, type);
    }
  }
});

test("a repetition is a whole number, three at first", () => {
  const [times] = KINDS.find(({ type }) => type === "repeat").args0;
  assert.deepEqual([times.value, times.min, times.max, times.precision], [3, 0, 1000, 1]);
});
