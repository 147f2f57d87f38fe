import assert from "node:assert/strict";
import { mock, test } from "node:test";

import { CodeRun } from "../../../web/code/run.js";
import { settle } from "../browser.mjs";
import { endOf, fakeWorld, percept } from "./world.mjs";

function running(world, parts = {}) {
  const run = new CodeRun({ makeEngine: async () => world.engine, connect: world.connect, prepare: async () => {}, ...parts });
  run.decisions = [];
  run.addEventListener("decision", ({ detail }) => run.decisions.push(detail));
  return run;
}

test("a run senses, decides and acts until the episode is over", async () => {
  const world = fakeWorld([percept(), percept({ step: 1 }), percept({ step: 2, terminated: true, terms: { touch: 1 } })]);
  const run = running(world);
  const end = endOf(run);
  await run.run("pass", "0");
  assert.equal((await end).reason, "over");
  assert.deepEqual(world.calls.slice(0, 8), [
    "warm", "connect realtime", 'load pass {"move":[[-1],[1]]}', "begin", "decide 1", "act 1", "decide 2", "act 2",
  ]);
  assert.deepEqual(world.calls.slice(8, 10), ["close", "finish"].filter((call) => world.calls.includes(call)));
  assert.deepEqual(run.decisions.map(({ number, action, source }) => [number, action.move, source]), [[1, [1], "pass"], [2, [2], "pass"]]);
  assert.deepEqual([run.phase, run.isOn, run.success, run.decision], ["off", false, "touch", 2]);
});

test("a mistake ends the run with its line, and what was printed is told", async () => {
  const answers = { 1: { ok: false, text: "no such name", line: 2, kind: "name", printed: "hi" } };
  const run = running(fakeWorld([percept()], { answers }));
  const printed = [];
  run.addEventListener("printed", ({ detail }) => printed.push(detail));
  const end = endOf(run);
  await run.run("pass", "0");
  const { reason, text, line, kind } = await end;
  assert.deepEqual([reason, text, line, kind], ["mistake", "no such name", 2, "name"]);
  assert.deepEqual(printed, [{ number: 1, text: "hi" }]);
});

test("a seed begins an episode, and so does an episode that is over", async () => {
  const seeded = fakeWorld([percept(), percept(), percept({ terminated: true })]);
  await running(seeded).run("pass", "0", { seed: 7 });
  assert.equal(seeded.calls.includes("reset 7"), true);
  const over = fakeWorld([percept({ truncated: true }), percept({ truncated: true }), percept(), percept({ terminated: true })]);
  const again = [];
  await running(over, { beginAgain: async () => again.push("again") > 0 }).run("pass", "0", { isHere: true });
  assert.deepEqual([again.length, over.calls.includes("reset")], [1, true]);
});

test("a fresh run begins another episode first, one from here does not", async () => {
  for (const [isHere, count] of [[false, 1], [true, 0]]) {
    let begun = 0;
    const world = fakeWorld([percept(), percept({ terminated: true })]);
    await running(world, { beginAgain: async () => (begun += 1) > 0 }).run("pass", "0", { isHere });
    assert.equal(begun, count);
  }
});

test("another episode of the world begins the program again", async () => {
  const world = fakeWorld([percept(), percept({ episode: 2 }), percept({ episode: 2, terminated: true })]);
  await running(world).run("pass", "0");
  assert.equal(world.calls.filter((call) => call === "begin").length, 2);
});

test("a step makes one decision, and asks the world to wait", async () => {
  mock.timers.enable({ apis: ["setInterval"] });
  const world = fakeWorld([percept(), percept({ step: 1 }), percept({ step: 2 })]);
  const run = running(world);
  await run.step("pass", "0");
  assert.deepEqual([run.phase, run.decision, world.calls.includes("connect lockstep")], ["stepping", 1, true]);
  mock.timers.tick(400);
  assert.equal(world.calls.at(-1), "wait");
  await run.step("pass", "0");
  assert.deepEqual([run.decision, world.calls.filter((call) => call.startsWith("load")).length], [2, 1]);
  const end = endOf(run);
  run.stop();
  assert.equal((await end).reason, "stopped");
  const count = world.calls.filter((call) => call === "wait").length;
  mock.timers.tick(4000);
  assert.equal(world.calls.filter((call) => call === "wait").length, count);
  mock.timers.reset();
});

test("a run that is stopped while it connects gives the agent back", async () => {
  const world = fakeWorld([percept()]);
  let give;
  const run = running(world, { connect: () => new Promise((resolve) => (give = () => resolve(world.client))) });
  const over = run.run("pass", "0");
  while (!give) await settle();
  run.stop("The page sleeps.");
  give();
  await over;
  await settle();
  assert.deepEqual([run.phase, world.calls.includes("close"), world.calls.includes("decide 1")], ["off", true, false]);
});

test("an error of the connection is told, lockstep that is refused with advice", async () => {
  for (const [code, expected] of [["lost", /gone/], ["lockstep_refused", /--lockstep/]]) {
    const run = running(fakeWorld([percept()]), { connect: () => Promise.reject(Object.assign(new Error("gone"), { code })) });
    const end = endOf(run);
    await run.run("pass", "0");
    assert.equal((await end).reason, "lost");
    assert.match((await end).text, expected);
  }
});

test("Python that could not be loaded is tried again", async () => {
  let tries = 0;
  const world = fakeWorld([percept()]);
  const makeEngine = async () => {
    tries += 1;
    if (tries === 1) throw new Error("no network");
    return world.engine;
  };
  const run = running(world, { makeEngine });
  await assert.rejects(run.warm(), /no network/);
  assert.equal(await run.warm(), world.engine);
});

test("a program waits at a breakpoint, and so does the world, until it goes on", async () => {
  const moments = [{ line: 2, variables: { near: "1" } }, { line: 3, variables: { near: "2" } }, { line: 4, variables: {} }];
  const world = fakeWorld([percept(), percept({ step: 1 }), percept({ step: 2, terminated: true })], { answers: { 1: { moments } } });
  const held = [];
  const run = running(world, { hold: async (on) => void held.push(on) });
  run.stops = [2, 4];
  const end = endOf(run);
  const whole = run.run("pass", "0");
  await settle();
  assert.deepEqual([run.phase, run.moment, run.decisions.length, held], ["waiting", moments[0], 0, [true]]);
  assert.equal(world.calls.includes("act 1"), false);
  run.goOn(true); // one line
  await settle();
  assert.equal(run.moment, moments[1]);
  run.goOn(false); // to the next breakpoint
  await settle();
  assert.equal(run.moment, moments[2]);
  run.goOn(false);
  await whole;
  assert.equal((await end).reason, "over");
  assert.deepEqual([held, run.moment], [[true, false], null]);
  assert.deepEqual(world.calls.filter((call) => /^(decide|act)/.test(call)), ["decide 1 until 2,4", "act 1", "decide 2 until 2,4", "act 2"]);
});

test("a step over the last line waits at the first one of the next decision, and Stop ends a wait", async () => {
  const moments = [{ line: 2, variables: {} }];
  const world = fakeWorld([percept(), percept({ step: 1 }), percept({ step: 2 })], { answers: { 1: { moments }, 2: { moments } } });
  const held = [];
  const run = running(world, { hold: async (on) => void held.push(on) });
  run.stops = [2];
  const end = endOf(run);
  const whole = run.run("pass", "0");
  await settle();
  run.goOn(true);
  await settle();
  assert.deepEqual(world.calls.filter((call) => /^(decide|act)/.test(call)), ["decide 1 until 2", "act 1", "decide 2 until 0"]);
  assert.equal(run.phase, "waiting");
  run.stop();
  await whole;
  assert.equal((await end).reason, "stopped");
  await settle();
  assert.deepEqual([held, run.moment, run.phase], [[true, false, true, false], null, "off"]);
});
