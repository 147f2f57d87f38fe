import assert from "node:assert/strict";
import { test } from "node:test";

import { AND, ANY, ATOM, COMPARISON, identifier, NOT, OR, PRODUCT, SIGN, SUM } from "../../../web/blocks/words.js";

const named = (words, taken = []) => identifier(words, new Set(taken));

test("words become a name of Python", () => {
  assert.deepEqual(["my count", " near-by! ", "größe", "2nd", "", "__a__"].map((words) => named(words)), ["my_count", "near_by", "größe", "x_2nd", "x_", "a"]);
});

test("Python's own words get a mark", () => {
  assert.deepEqual(["for", "sum", "self", "forward"].map((words) => named(words)), ["for_", "sum_", "self_", "forward"]);
});

test("a name that is taken gets a number, and takes it", () => {
  const taken = new Set(["count", "count_2"]);
  assert.deepEqual([identifier("count", taken), identifier("count", taken)], ["count_3", "count_4"]);
});

test("operators bind in Python's order", () => {
  const orders = [ATOM, SIGN, PRODUCT, SUM, COMPARISON, NOT, AND, OR, ANY];
  assert.deepEqual(orders.map((order, index) => order > (orders[index - 1] ?? -1)), orders.map(() => true));
});
