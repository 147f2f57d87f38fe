import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import { ConnectionLostError, Dialogue, RemoteError } from "../../../web/remote/dialogue.js";
import { FIELDS } from "../../../web/remote/messages.js";
import { decode, Encoder } from "../../../web/vendor/msgpack.js";

let now = 0;
mock.method(performance, "now", () => now);
beforeEach(() => (now = 0));

function frame(type, fields) {
  return new Encoder().encode([type, ...FIELDS[type].map((name) => fields[name] ?? 0)]);
}
const WELCOME = frame("welcome", { session: "s1", grace: 2, readings: [], outputs: [] });
const percept = (seq, fields = {}) => frame("percept", { seq, episode: 1, terminated: false, truncated: false, ...fields });
const problem = (code, seq) => frame("problem", { code, text: `no: ${code}`, seq });
const LOST = new ConnectionLostError("gone");

/** Run a method with what its connection answers to each step; time passes while it waits. Return steps and result. */
function play(method, ...answers) {
  const steps = [];
  let next = method.next();
  while (!next.done) {
    const step = next.value;
    steps.push(step.send ? decode(step.send) : step);
    const answer = "receive" in step ? answers.shift() ?? null : step.open && answers[0] === LOST ? answers.shift() : undefined;
    if (answer === null) now += step.receive;
    if (step.pause) now += step.pause;
    next = answer instanceof Error ? method.throw(answer) : method.next(answer);
  }
  return { steps, result: next.value };
}

function begun() {
  const dialogue = new Dialogue({ agent: "robot", mode: "realtime", onMissing: "stop", secret: "secret" });
  play(dialogue.begin(), WELCOME);
  return dialogue;
}

const sent = ({ steps }) => steps.filter(Array.isArray);

test("it opens, says hello, and has the welcome", () => {
  const dialogue = new Dialogue({ agent: "robot", mode: "lockstep", onMissing: "", secret: "secret" });
  const { steps } = play(dialogue.begin(), WELCOME);
  assert.deepEqual(steps, [{ open: 3000 }, ["hello", 1, "robot", "", "lockstep", [], "", "secret"], { receive: 200 }]);
  assert.equal(dialogue.welcome.session, "s1");
});

test("the hello is repeated, after times that double", () => {
  const dialogue = new Dialogue({ agent: "", mode: "realtime", onMissing: "", secret: "" });
  const { steps } = play(dialogue.begin(), null, null, null, WELCOME);
  assert.deepEqual(steps.filter(({ receive }) => receive).map(({ receive }) => receive), [200, 400, 800, 1000]);
  assert.equal(sent({ steps }).length, 4);
});

test("a world that does not answer is given up", () => {
  const dialogue = new Dialogue({ agent: "", mode: "realtime", onMissing: "", secret: "" });
  assert.throws(() => play(dialogue.begin()), (error) => error instanceof RemoteError && error.code === "lost" && /no answer/.test(error.message));
  assert.ok(now >= 3000);
});

test("an answer is an action for the latest percept, and old percepts are ignored", () => {
  const dialogue = begun();
  const { result } = play(dialogue.sense(), percept(5, { step: 4 }));
  assert.deepEqual([result.seq, result.step, "type" in result, "data" in result], [5, 4, false, false]);
  assert.deepEqual(sent(play(dialogue.act({ move: [1] }))), [["action", 1, 4, 5, { move: [1] }]]);
  assert.equal(play(dialogue.sense(), percept(5), percept(4), percept(6)).result.seq, 6);
});

test("without a next percept the answer is repeated", () => {
  const dialogue = begun();
  play(dialogue.sense(), percept(5));
  play(dialogue.act({}));
  const { steps } = play(dialogue.sense(), null, null, percept(6));
  assert.deepEqual(sent({ steps }).map(([kind]) => kind), ["action", "action"]);
  assert.deepEqual(steps.filter(({ receive }) => receive).map(({ receive }) => receive), [200, 400, 800]);
});

test("after the end of an episode only a reset goes on, until another episode is there", () => {
  const dialogue = begun();
  play(dialogue.sense(), percept(5, { terminated: true }));
  assert.throws(() => play(dialogue.act({})), { code: "episode_over" });
  const { steps, result } = play(dialogue.reset(7), percept(6), percept(7, { episode: 2 }));
  assert.deepEqual(sent({ steps }), [["reset", 5, 7], ["reset", 6, 7]]);
  assert.equal(result.episode, 2);
});

test("a lost connection is opened again with the session, and the answer is sent again", () => {
  const dialogue = begun();
  play(dialogue.sense(), percept(5));
  play(dialogue.act({}));
  const { steps, result } = play(dialogue.sense(), LOST, WELCOME, percept(6));
  assert.deepEqual(sent({ steps }).map(([kind]) => kind), ["hello", "action"]);
  assert.equal(sent({ steps })[0][6], "s1");
  assert.equal(result.seq, 6);
});

test("a connection that stays lost ends the session after the world's grace time", () => {
  const dialogue = begun();
  assert.throws(() => play(dialogue.sense(), ...Array.from({ length: 60 }, () => LOST)), { code: "lost" });
  assert.ok(now >= 2000 && now < 3000);
  assert.throws(() => play(dialogue.sense()), { code: "lost" });
});

test("a close code of the protocol ends the session with its word", () => {
  for (const [closeCode, code] of [[4009, "taken_over"], [1008, "refused"]]) {
    const dialogue = begun();
    assert.throws(() => play(dialogue.sense(), new ConnectionLostError("closed", closeCode)), { code });
    assert.throws(() => play(dialogue.wait()) && play(dialogue.sense()), { code });
  }
});

test("a refused action can be made again, a refusal that is repeated is not told twice", () => {
  const dialogue = begun();
  play(dialogue.sense(), percept(5));
  play(dialogue.act({}));
  assert.throws(() => play(dialogue.sense(), problem("bad_value", 5)), { code: "bad_value" });
  assert.equal(play(dialogue.sense()).result.seq, 5);
  play(dialogue.act({}));
  assert.throws(() => play(dialogue.sense(), problem("bad_value", 5)), { code: "bad_value" });
  play(dialogue.act({}));
  assert.equal(play(dialogue.sense(), problem("bad_value", 4), percept(6)).result.seq, 6);
});

test("each copy of a refused answer is refused, but one error is thrown", () => {
  const dialogue = begun();
  play(dialogue.sense(), percept(5));
  play(dialogue.act({}));
  assert.throws(() => play(dialogue.sense(), null, null, problem("bad_value", 5)), { code: "bad_value" }); // sent three times
  play(dialogue.act({}));
  const { steps, result } = play(dialogue.sense(), problem("bad_value", 5), problem("bad_value", 5), percept(6));
  assert.equal(result.seq, 6);
  assert.deepEqual(sent({ steps }), []);
});

test("another refusal is thrown while copies of the first are under way", () => {
  const dialogue = begun();
  play(dialogue.sense(), percept(5));
  play(dialogue.act({}));
  assert.throws(() => play(dialogue.sense(), null, problem("bad_value", 5)), { code: "bad_value" });
  play(dialogue.act({}));
  assert.throws(() => play(dialogue.sense(), problem("bad_name", 5)), { code: "bad_name" });
});

test("an order for more time is sent only while an answer is due", () => {
  const dialogue = begun();
  assert.deepEqual(play(dialogue.wait()).steps, []);
  play(dialogue.sense(), percept(5));
  assert.deepEqual(sent(play(dialogue.wait())), [["order", 5, "wait"]]);
});

test("goodbye is said once, and nothing goes on after it", () => {
  const dialogue = begun();
  const { steps } = play(dialogue.end("done"));
  assert.deepEqual(steps, [["bye", "done"], { close: true }]);
  assert.deepEqual(play(dialogue.end("again")).steps, []);
  assert.throws(() => play(dialogue.sense()), { code: "closed" });
});

test("a world that says goodbye ends the session", () => {
  assert.throws(() => play(begun().sense(), frame("bye", { reason: "closing" })), { code: "ended", message: /closing/ });
});

test("what is told goes with each answer until it is taken back", () => {
  const dialogue = new Dialogue({ agent: "", mode: "lockstep", onMissing: "", secret: "" });
  play(dialogue.begin(), frame("welcome", { session: "s1", grace: 2, readings: [], outputs: [], fields: ["goal"] }));
  assert.equal(dialogue.tell({ goal: [1, 2.5] }), "");
  assert.match(dialogue.tell({ gaol: "red" }), /No sensor reads gaol/);
  const told = { goal: ["1", "2.5"], gaol: ["red"] };
  assert.deepEqual(sent(play(dialogue.act({}), percept(1, { step: 0 })))[0].at(-1), told);
  dialogue.tell({ gaol: null, goal: 3 });
  const reset = play(dialogue.reset(), percept(2), percept(3, { episode: 2 }));
  assert.deepEqual(sent(reset)[0], ["reset", 2, null, { goal: ["3"] }]);
});
