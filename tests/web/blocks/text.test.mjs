import assert from "node:assert/strict";
import { test } from "node:test";

import { joinProgram, splitProgram } from "../../../web/blocks/text.js";

const PYTHON = "def decide(percept):\n    return {}\n";
const BLOCKS = { blocks: [{ type: "on_decision" }] };

test("a program of blocks comes apart as it was put together", () => {
  const text = joinProgram(PYTHON, BLOCKS, true);
  assert.equal(text.startsWith(PYTHON), true);
  assert.deepEqual(splitProgram(text), { python: PYTHON, blocks: BLOCKS, isOfBlocks: true });
});

test("a program that went on in Python keeps its blocks, but is not theirs", () => {
  const changed = joinProgram(PYTHON, BLOCKS, true).replace("{}", "{'a': 1}");
  assert.equal(splitProgram(changed).isOfBlocks, false);
  assert.deepEqual(splitProgram(joinProgram(PYTHON, BLOCKS, false)), { python: PYTHON, blocks: BLOCKS, isOfBlocks: false });
});

test("a program without blocks is its Python", () => {
  assert.equal(joinProgram(PYTHON, null, true), PYTHON);
  assert.deepEqual(splitProgram(PYTHON), { python: PYTHON, blocks: null, isOfBlocks: false });
});

test("a line that somebody has changed, or that is not the last one, is Python", () => {
  const text = joinProgram(PYTHON, BLOCKS, true);
  for (const other of [text.replace('"version":1', '"version":2'), text.replace("{", "").trim().slice(0, -1), `${text}pass\n`, `${PYTHON}\n# blocks: {"version":1,"of":"","blocks":null}\n`]) {
    assert.deepEqual(splitProgram(other), { python: other, blocks: null, isOfBlocks: false });
  }
});

test("the text's number is FNV-1a's", () => {
  assert.match(joinProgram("foobar", BLOCKS, true), /"of":"bf9cf968"/);
});
