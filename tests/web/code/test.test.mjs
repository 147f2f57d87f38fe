import assert from "node:assert/strict";
import { test } from "node:test";

import { averageDecisions, CodeTest } from "../../../web/code/test.js";
import { endOf, fakeWorld, percept } from "./world.mjs";

function testing(world, { seeds = [5], ...parts } = {}) {
  const speeds = [];
  const speed = { max: async () => speeds.push("max"), restore: () => speeds.push("restore") };
  const made = new CodeTest({ warm: async () => world.engine, connect: world.connect, speed, draw: () => seeds, ...parts });
  return Object.assign(made, { speeds });
}

async function outcome(percepts, options = {}) {
  const made = testing(fakeWorld(percepts, options), options);
  const end = endOf(made);
  await made.run("pass", "0");
  return { ...(await end), row: made.rows[0], made };
}

test("each start loads the program, begins with its seed, and is driven to its end", async () => {
  const goal = percept({ step: 1, tick: 90, terminated: true, terms: { touch: 1 } });
  const world = fakeWorld([percept(), goal, percept(), goal]);
  const made = testing(world, { seeds: [5, 6] });
  const end = endOf(made);
  await made.run("pass", "0");
  assert.equal((await end).reason, "tested");
  assert.deepEqual(made.rows, [
    { number: 1, seed: 5, outcome: "goal", decisions: 1, seconds: 1.5, reward: 0 },
    { number: 2, seed: 6, outcome: "goal", decisions: 1, seconds: 1.5, reward: 0 },
  ]);
  assert.deepEqual(world.calls.filter((call) => /^(reset|load|connect)/.test(call)).map((call) => call.split(" ").slice(0, 2).join(" ")), [
    "connect lockstep", "load pass", "reset 5", "load pass", "reset 6",
  ]);
  assert.deepEqual([made.speeds, made.phase, made.failure, averageDecisions(made.rows)], [["max", "restore"], "off", null, 1]);
});

test("an episode is a goal by the scene's term, or by an end that pays", async () => {
  const paid = [percept(), percept({ terms: { touch: 1 } }), percept({ terminated: true })];
  assert.equal((await outcome([...paid])).row.outcome, "goal");
  const ends = (reward) => [percept(), percept({ terminated: true, reward })];
  assert.equal((await outcome(ends(1), { welcome: { success: "" } })).row.outcome, "goal");
  assert.equal((await outcome(ends(-1), { welcome: { success: "" } })).row.outcome, "over");
});

test("an end without the goal has the world's word, and one by time is its own", async () => {
  const fell = await outcome([percept(), percept({ terminated: true })], { outcome: async (_, seed) => `fell ${seed}` });
  assert.deepEqual([fell.row.outcome, fell.made.failure], ["fell 5", 5]);
  assert.equal((await outcome([percept(), percept({ truncated: true })])).row.outcome, "time");
});

test("an episode without a limit of its own ends after a minute of the world's time", async () => {
  const long = [percept(), percept({ tick: 3599 }), percept({ tick: 3600 })];
  const { row } = await outcome([...long]);
  assert.deepEqual([row.outcome, row.decisions, row.seconds], ["time", 1, 60]);
  const limited = await outcome([...long, percept({ tick: 9000, truncated: true })], { welcome: { maxSteps: 100 } });
  assert.equal(limited.row.seconds, 150);
});

test("a mistake ends the test, with its line", async () => {
  const { reason, line, row } = await outcome([percept()], { answers: { 1: { ok: false, text: "oh", line: 4 } } });
  assert.deepEqual([reason, line, row.outcome], ["mistake", 4, "mistake"]);
});

test("another episode in the middle, or a refusal, ends the test with a sentence", async () => {
  assert.match((await outcome([percept(), percept({ episode: 2 })])).text, /Another episode/);
  for (const code of ["lockstep_refused", "seed_refused"]) {
    const connect = () => Promise.reject(Object.assign(new Error("no"), { code }));
    assert.match((await outcome([percept()], { connect })).text, /--lockstep --seeded-resets/);
  }
});

test("a test that is stopped gives the agent and the speed back, and can be forgotten", async () => {
  const world = fakeWorld([percept()]);
  const made = testing(world);
  made.addEventListener("decision", () => made.stop());
  const end = endOf(made);
  await made.run("pass", "0");
  assert.equal((await end).reason, "stopped");
  assert.deepEqual(["close", "finish"].filter((call) => world.calls.includes(call)), ["close", "finish"]);
  assert.deepEqual(made.speeds, ["max", "restore"]);
  made.clear();
  assert.deepEqual([made.rows, made.start, made.decision], [[], 0, 0]);
});

test("ten different seeds are drawn", async () => {
  const made = testing(fakeWorld([percept({ truncated: true })]), { draw: undefined });
  const drawn = new CodeTest({ warm: async () => Promise.reject(new Error("no")), speed: { max: () => {}, restore: () => {} } });
  await drawn.run("pass", "0");
  assert.equal(new Set(drawn.rows.map(({ seed }) => seed)).size, 10);
  assert.equal(drawn.rows.every(({ seed }) => seed < 1_000_000), true);
  assert.equal(made.isOn, false);
});
