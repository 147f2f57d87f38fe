import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import { answerWith as answerAll, openWindow, send, settle } from "../browser.mjs";

mock.timers.enable({ apis: ["setTimeout"] });
openWindow("http://class.example/r/a1/");
const { ClassPrograms } = await import("../../../web/classroom/student/programs.js");
const { handoutFor, handouts, noteHandout } = await import("../../../web/classroom/student/handout.js");
const { roomOfPage } = await import("../../../web/shared/room.js");
const { forget } = await import("../../../web/shared/storage.js");
const NONE = { body: { source: null, version: 0, is_of_device: false } };
const ofClass = (source, version, isOfDevice = false) => ({ body: { source, version, is_of_device: isOfDevice } });
let own;
let log;
let programs;
let names;

/** Let the class answer with these, one after another, and with `names` to a question for the programs. */
function answerWith(...answers) {
  const asked = answerAll(...answers);
  const { fetch: answer } = globalThis;
  globalThis.fetch = async (url, options) => {
    const asksForNames = options.method === undefined && !new URL(url, location.href).searchParams.has("agent");
    return asksForNames ? { ok: true, status: 200, json: async () => ({ agents: names }) } : answer(url, options);
  };
  return asked;
}

beforeEach(() => {
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
  openWindow("http://class.example/r/a1/");
  for (const key of ["code-version-a1/sumo-0", "code-device-a1"]) forget(key);
  [own, log, names] = [null, [], []];
  programs = new ClassPrograms({
    source: () => own,
    take: (source) => log.push(`take ${source}`),
    keep: (source) => log.push(`keep ${source}`),
    learn: (agents) => agents.length && log.push(`learn ${agents}`),
  });
});

const puts = (asked) => asked.filter(({ method }) => method === "PUT").map(({ body }) => JSON.parse(body));
const words = () => programs.element.textContent;

test("a room is in the page's address", () => {
  assert.equal(roomOfPage(), "a1");
  openWindow("http://world.example/lab/");
  assert.equal(roomOfPage(), "");
});

test("without a class nothing is sent", async () => {
  openWindow("http://world.example/");
  const asked = answerWith(NONE);
  const alone = new ClassPrograms({ source: () => "a", take: () => {}, keep: () => {}, learn: () => {} });
  alone.open("sumo", "0");
  alone.ran("a");
  mock.timers.tick(60_000);
  await settle();
  assert.deepEqual(asked, []);
});

test("the class's program is taken by a browser that has none or has not seen it", async () => {
  answerWith(ofClass("theirs", 4));
  programs.open("sumo", "0");
  await settle();
  assert.deepEqual([log, words()], [["take theirs"], "This is your program from the class."]);
});

test("a program that was seen before does not replace the own one, which is saved", async () => {
  own = "mine";
  const asked = answerWith(ofClass("theirs", 4, true), { body: { version: 5 } });
  programs.open("sumo", "0");
  await settle();
  mock.timers.tick(0);
  await settle();
  assert.deepEqual(log, ["keep theirs"]);
  assert.deepEqual(puts(asked).map(({ source, base }) => [source, base]), [["mine", 4]]);
  assert.equal(words(), "Kept in the class.");
});

test("a program is saved after a pause in typing, at once when it runs, and only if it differs", async () => {
  const asked = answerWith(NONE, { body: { version: 1 } });
  programs.open("sumo", "0");
  await settle();
  programs.changed("a");
  mock.timers.tick(1999);
  programs.changed("ab");
  mock.timers.tick(1999);
  await settle();
  assert.equal(puts(asked).length, 0);
  mock.timers.tick(1);
  await settle();
  assert.deepEqual(puts(asked).map(({ source }) => source), ["ab"]);
  programs.ran("ab");
  programs.ran("abc");
  mock.timers.tick(0);
  await settle();
  assert.deepEqual(puts(asked).map(({ source, base }) => [source, base]), [["ab", 0], ["abc", 1]]);
});

test("a class that can't be reached is asked again, later and later", async () => {
  const asked = answerWith(NONE, new TypeError("offline"));
  programs.open("sumo", "0");
  await settle();
  programs.ran("a");
  const counts = [];
  for (const pause of [0, 2999, 1, 10_000, 29_999, 1, 30_000]) {
    mock.timers.tick(pause);
    await settle();
    counts.push(puts(asked).length);
  }
  assert.deepEqual(counts, [1, 1, 2, 3, 3, 4, 5]);
  assert.match(words(), /can't be reached/);
});

test("a newer program of another device is kept, and told", async () => {
  answerWith(NONE, { status: 409, body: {} }, ofClass("newer", 9));
  programs.open("sumo", "0");
  await settle();
  programs.ran("a");
  mock.timers.tick(0);
  await settle();
  assert.deepEqual(log, ["keep newer"]);
  assert.match(words(), /newer program/);
});

test("the programs that the class has in a scene are told once, when the scene is opened", async () => {
  names = ["0/Wall", "0"];
  answerWith(NONE);
  programs.open("sumo", "0");
  programs.open("sumo", "0/Wall");
  await settle();
  assert.deepEqual(log, ["learn 0/Wall,0"]);
});

test("a program that was deleted here is emptied in the class, and an empty one there replaces nothing", async () => {
  own = "mine";
  const asked = answerWith(ofClass("", 4), { body: { version: 5 } });
  programs.open("sumo", "0");
  programs.removed("sumo", "0/Wall");
  mock.timers.tick(0);
  await settle();
  assert.deepEqual(puts(asked).map(({ agent, source }) => [agent, source]), [["0/Wall", ""]]);
  mock.timers.tick(2000);
  await settle();
  assert.deepEqual(puts(asked).map(({ agent, source }) => [agent, source]), [["0/Wall", ""], ["0", "mine"]]);
  assert.deepEqual(log, []);
});

test("a teacher who looks in saves nothing", async () => {
  const asked = answerWith({ status: 403 });
  programs.open("sumo", "0");
  await settle();
  programs.ran("a");
  mock.timers.tick(60_000);
  await settle();
  assert.equal(puts(asked).length, 0);
});

test("a device has one id, which the class sees again and again", async () => {
  const asked = answerWith(NONE, { body: { version: 1 } });
  programs.open("sumo", "0");
  await settle();
  programs.ran("a");
  mock.timers.tick(0);
  await settle();
  const { device } = puts(asked)[0];
  assert.match(device, /^[0-9a-f]{24}$/);
  assert.equal(new URL(asked[0].url, "http://class.example/r/a1/").searchParams.get("device"), device);
  assert.equal(programs.element.hidden, false);
});

test("a place that was only opened takes the class's program again, one that was changed keeps its own", async () => {
  answerWith(ofClass("theirs", 4), { body: { version: 5 } });
  programs.open("sumo", "0");
  programs.changed("mine");
  await settle();
  assert.deepEqual(log, ["keep theirs"]);
});

test("a page that is closed sends what waits", async () => {
  const asked = answerWith(NONE, { body: { version: 1 } });
  programs.open("sumo", "0");
  await settle();
  programs.changed("a");
  send("pagehide");
  assert.deepEqual(asked.filter(({ keepalive }) => keepalive).map(({ body }) => JSON.parse(body).source), ["a"]);
});

test("a teacher's program is for its scene, or for all; a change is told once", () => {
  let changes = 0;
  handouts.addEventListener("change", () => (changes += 1));
  noteHandout({ scene: "sumo", source: "pass" });
  noteHandout({ scene: "sumo", source: "pass" });
  assert.deepEqual([handoutFor("sumo"), handoutFor("soccer"), changes], ["pass", null, 1]);
  noteHandout({ scene: "", source: "all" });
  assert.equal(handoutFor("soccer"), "all");
  noteHandout(null);
  assert.deepEqual([handoutFor("sumo"), changes], [null, 3]);
});
