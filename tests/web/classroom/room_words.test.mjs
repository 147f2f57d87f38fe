import assert from "node:assert/strict";
import { test } from "node:test";

import { needsHelp, roomName, seatsOf, statusOf } from "../../../web/classroom/room_words.js";

const SEATS = ["Red Fox", "Calm Owl", "Blue Jay", "Old Elk"].map((name, index) => ({ number: index, name, state: index === 3 ? "out" : "in" }));
const room = (...seats) => ({ seats });

test("a room is named after those who are in the class", () => {
  const named = (...seats) => roomName(room(...seats), { seats: SEATS });
  assert.deepEqual([named(), named(3), named(0, 3), named(0, 1), named(0, 1, 2)], [
    "Empty room", "Empty room", "Red Fox", "Red Fox and Calm Owl", "Red Fox and 2 others",
  ]);
  assert.deepEqual(seatsOf(room(1, 3), { seats: SEATS }), [SEATS[1]]);
});

test("a status has a word and a sign, an unknown one its own", () => {
  assert.deepEqual(statusOf({ status: "mistake" }), { text: "program stopped", sign: "!" });
  assert.deepEqual(statusOf({ status: "new" }), { text: "new", sign: "" });
});

test("a card is marked from a need of 30 on", () => {
  assert.deepEqual([{ help: 30 }, { help: 29 }, {}].map(needsHelp), [true, false, false]);
});
