import assert from "node:assert/strict";
import { test } from "node:test";

import { FILTERS, fitting, ordered } from "../../../web/classroom/wall/order.js";

const ROOMS = [{ id: "a", help: 12, name: "Owl" }, { id: "b", help: 80, name: "Fox" }, { id: "c", help: 9, name: "Elk" }, { id: "d", name: "Fox" }];
const ids = (by, held = null) => ordered(ROOMS, by, ({ name }) => name, held).map(({ id }) => id).join("");

test("rooms are sorted by name, equal names by id", () => {
  assert.equal(ids("name"), "cbda");
});

test("rooms that need more help come first; small differences don't count", () => {
  assert.equal(ids("help"), "bcad");
});

test("rooms keep their places while a pointer is over them, and new ones follow", () => {
  assert.equal(ids("help", ["d", "a"]), "dabc");
});

test("filters keep rooms by their state", () => {
  const keeps = (name, ...rooms) => rooms.map(FILTERS[name].keeps);
  assert.deepEqual(keeps("help", { help: 30 }, { help: 5 }), [true, false]);
  assert.deepEqual(keeps("asleep", { status: "away" }, { status: "asleep" }, { status: "driving" }), [true, true, false]);
  assert.deepEqual(keeps("driving", { status: "driving" }, { status: "idle" }), [true, false]);
  assert.deepEqual(keeps("solved", { is_solved: true }, { is_solved: false }), [true, false]);
  assert.deepEqual(keeps("all", {}), [true]);
});

const CARD = { minWidth: 100, heightOf: (width) => width / 2, widthOf: (height) => 2 * height };

test("cards are as large as all of them can be", () => {
  assert.deepEqual(fitting(1, 1000, 400, 0, CARD), { columns: 1, cardWidth: 800 });
  assert.deepEqual(fitting(4, 1000, 400, 0, CARD), { columns: 2, cardWidth: 400 });
  assert.deepEqual(fitting(4, 1000, 410, 10, CARD), { columns: 2, cardWidth: 400 });
  assert.deepEqual(fitting(3, 920, 500, 10, CARD), { columns: 2, cardWidth: 455 });
});

test("columns are kept if cards become little smaller by that", () => {
  assert.deepEqual(fitting(4, 1000, 400, 0, CARD, 3), { columns: 3, cardWidth: 1000 / 3 });
  assert.deepEqual(fitting(4, 1000, 400, 0, CARD, 5), { columns: 2, cardWidth: 400 });
});

test("cards that can't all fit stand in as many columns as possible", () => {
  assert.deepEqual(fitting(100, 450, 100, 10, CARD), { columns: 4, cardWidth: 105 });
});
