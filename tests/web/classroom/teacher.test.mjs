import assert from "node:assert/strict";
import { test } from "node:test";

import { answerWith, openWindow } from "../browser.mjs";

const { kept } = openWindow();
const { parseNames, RealNames } = await import("../../../web/classroom/teacher/real_names.js");
const { command } = await import("../../../web/classroom/teacher/command.js");
const { ago, programFacts, programsOf } = await import("../../../web/classroom/teacher/room_programs.js");

test("a table of names may have commas, semicolons, tabs and quotes", () => {
  const text = '\ufeff3,Ada Lovelace\r\nRed  Fox;"Hopper, Grace ""Amazing"""\n Calm Owl \t Alan\n\nOnly a seat,\n,Only a name';
  assert.deepEqual(parseNames(text), { 3: "Ada Lovelace", "red fox": 'Hopper, Grace "Amazing"', "calm owl": "Alan" });
  assert.equal(parseNames(`1,${"x".repeat(99)}`)[1].length, 60);
});

test("names are found by number, then by the seat's name, and stay in this browser until they are forgotten", () => {
  const names = new RealNames();
  let changes = 0;
  names.onchange = () => (changes += 1);
  names.load("3,Ada\nRed Fox,Grace");
  assert.deepEqual([{ number: 3, name: "Red Fox" }, { number: 4, name: "RED FOX" }, { number: 5, name: "Elk" }].map((seat) => names.of(seat)), ["Ada", "Grace", ""]);
  assert.deepEqual([names.count, new RealNames().count, kept.has("ai4u-real-names")], [2, 2, true]);
  names.forget();
  assert.deepEqual([names.count, new RealNames().count, changes], [0, 0, 2]);
});

test("a file without names is refused, and changes nothing", () => {
  const names = new RealNames();
  names.load("3,Ada");
  assert.throws(() => names.load("nothing"), /Expected lines/);
  assert.equal(names.count, 1);
});

test("a command is posted, and gives its answer", async () => {
  const asked = answerWith({ body: { code: "1234" } });
  assert.deepEqual(await command({ do: "move code", seat: 3 }), { code: "1234" });
  assert.deepEqual([asked[0].url, asked[0].method, asked[0].body], ["./teacher/command", "POST", '{"do":"move code","seat":3}']);
});

test("a command that fails has a sentence: the class's own, else one about the status or the network", async () => {
  answerWith({ status: 409, body: { problem: "The race is over." } });
  await assert.rejects(command({ do: "race" }), { message: "The race is over." });
  answerWith({ status: 502, body: "<html>" });
  await assert.rejects(command({ do: "race" }), /status 502/);
  answerWith(new TypeError("offline"));
  await assert.rejects(command({ do: "race" }), /can't be reached/);
});

test("the age of a program is in the largest unit that fits", () => {
  assert.deepEqual([0, 59, 60, 119, 7200, 86_400].map(ago), [
    "changed just now", "changed just now", "changed 1 minute ago", "changed 1 minute ago", "changed 2 hours ago", "changed 1 day ago",
  ]);
});

test("a program is told with its scene, with its robot where there are several, and with its age", () => {
  const scenes = [{ name: "soccer", title: "Soccer" }, { name: "sumo", title: "Sumo" }];
  assert.equal(programFacts({ scene: "sumo", agent: "0", age: 0 }, { scenes }), "Sumo · changed just now");
  assert.equal(programFacts({ scene: "mine", agent: "2", age: 60 }, {}), "mine · robot 2 · changed 1 minute ago");
});

test("programs are asked for by room, and a failure has a sentence", async () => {
  const asked = answerWith({ body: [{ seat: 1 }] });
  assert.deepEqual(await programsOf("a b"), [{ seat: 1 }]);
  assert.equal(asked[0].url, "./teacher/programs?room=a%20b");
  answerWith({ status: 404, body: { problem: "There is no such room." } });
  await assert.rejects(programsOf("a"), { message: "There is no such room." });
  await assert.rejects(programsOf(""), (error) => !/no such room/.test(error.message));
  answerWith(new TypeError("offline"));
  await assert.rejects(programsOf("a"), /can't be reached/);
});
