import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import { answerWith, openWindow, settle } from "../browser.mjs";

mock.timers.enable({ apis: ["setTimeout"] });
openWindow("http://class.example/r/a1/");
const { ProgramReports } = await import("../../../web/classroom/student/program_reports.js");

const MISTAKE = { reason: "mistake", text: "x is not known", line: 3, kind: "name" };
let run;
let reports;

function start() {
  run = Object.assign(new EventTarget(), { phase: "off" });
  reports = new ProgramReports(run);
}

beforeEach(() => {
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
  openWindow("http://class.example/r/a1/");
  start();
});

async function change(phase) {
  run.phase = phase;
  run.dispatchEvent(new Event("change"));
  await settle();
}

async function end(detail) {
  run.dispatchEvent(new CustomEvent("end", { detail }));
  await settle();
}

const sent = (asked) => asked.map(({ body }) => JSON.parse(body));

test("a program that runs is told once, one that is loaded is not", async () => {
  const asked = answerWith({});
  for (const phase of ["loading", "joining", "running", "stepping"]) await change(phase);
  assert.deepEqual(sent(asked), [{ state: "running" }]);
  assert.equal(asked[0].method, "PUT");
});

test("a mistake is told with its line, and its end when it is of the past", async () => {
  const asked = answerWith({});
  await end(MISTAKE);
  reports.end();
  await settle();
  reports.end();
  await settle();
  assert.deepEqual(sent(asked), [{ state: "mistake", kind: "name", text: "x is not known", line: 3 }, { state: "ended" }]);
});

test("a mistake outside of Python has the class's kind, and a long sentence is cut", async () => {
  const asked = answerWith({});
  await end({ ...MISTAKE, kind: "too_large", text: "a".repeat(700), line: null });
  const [{ kind, text, line }] = sent(asked);
  assert.deepEqual([kind, text.length, line], ["memory", 600, 0]);
});

test("any other end is told as one", async () => {
  const asked = answerWith({});
  await end({ reason: "over", text: "", line: null });
  assert.deepEqual(sent(asked), [{ state: "ended" }]);
});

test("a class that is busy, or can't be reached, is told the latest after a while", async () => {
  const asked = answerWith({ status: 503 }, new Error("no network"), {});
  await change("running");
  await end(MISTAKE);
  assert.deepEqual(sent(asked).map(({ state }) => state), ["running", "mistake"]);
  mock.timers.tick(10_000);
  await settle();
  assert.deepEqual(sent(asked).map(({ state }) => state), ["running", "mistake", "mistake"]);
  mock.timers.tick(10_000);
  await settle();
  assert.equal(asked.length, 3);
});

test("a page that the class does not know tells nothing more", async () => {
  const asked = answerWith({ status: 403 });
  await change("running");
  await end(MISTAKE);
  mock.timers.tick(60_000);
  await settle();
  assert.equal(asked.length, 1);
});

test("without a class nothing is told", async () => {
  openWindow("http://world.example/");
  const asked = answerWith({});
  start();
  await change("running");
  await end(MISTAKE);
  reports.end();
  await settle();
  assert.equal(asked.length, 0);
});
