import assert from "node:assert/strict";
import { deflateSync } from "node:zlib";
import { test } from "node:test";

import { MAX_PROGRAM_CHARS, programIn, withoutProgram, withProgram } from "../../../web/scenes/program_link.js";

const SOURCE = "def decide(percept):\n    return {'move': [1, 0]}  # ↑ ä\n";

test("a program comes out of a link as it went in", async () => {
  const fragment = await withProgram("scene=abc&seed=1", { agent: "robot 1", source: SOURCE });
  assert.match(fragment, /^scene=abc&seed=1&program=[\w-]+&agent=robot%201$/);
  assert.deepEqual(await programIn(`http://world.example/#${fragment}`), { agent: "robot 1", source: SOURCE });
  assert.equal(withoutProgram(fragment), "scene=abc&seed=1");
});

test("a link may be broken over lines", async () => {
  const fragment = await withProgram("scene=abc", { agent: "", source: SOURCE });
  const broken = fragment.replace(/(.{20})/g, "$1\n  ");
  assert.equal((await programIn(broken)).source, SOURCE);
});

test("a link without a program has none", async () => {
  assert.equal(await programIn("#scene=abc&seed=1"), null);
});

test("damaged data is refused with a sentence", async () => {
  const data = deflateSync(SOURCE).toString("base64url");
  for (const bad of [data.slice(0, -8), `${data.slice(0, 10)}AAAA${data.slice(14)}`, "%3Cb%3E", "", "A".repeat(60_004)]) {
    await assert.rejects(programIn(`scene=a&program=${bad}`), /damaged/);
  }
  await assert.rejects(programIn(`scene=a&program=${data}&agent=${"a".repeat(101)}`), /damaged/);
});

test("text that is no UTF-8, or too long when it is unpacked, is refused", async () => {
  const data = (bytes) => deflateSync(bytes).toString("base64url");
  await assert.rejects(programIn(`program=${data(Buffer.from([0xff, 0xfe]))}`), /damaged/);
  await assert.rejects(programIn(`program=${data("a".repeat(MAX_PROGRAM_CHARS + 1))}`), /damaged/);
  assert.equal((await programIn(`program=${data("a".repeat(MAX_PROGRAM_CHARS))}`)).source.length, MAX_PROGRAM_CHARS);
});

test("a program that is too large for a link is refused", async () => {
  const source = "a".repeat(MAX_PROGRAM_CHARS + 1);
  await assert.rejects(withProgram("scene=a", { agent: "", source }), /too large/);
  await assert.rejects(withProgram("x".repeat(100_000), { agent: "", source: SOURCE }), /too large/);
});
