import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { openWindow } from "../browser.mjs";

const { kept } = openWindow();
const { BEST, FIRST, KEYS, NETWORK, PROGRAM, Results, SLOWER, hasWon, raceText, slowedText, timesText, timeText } = await import("../../../web/page/results.js");
const { forget } = await import("../../../web/shared/storage.js");
let results;

beforeEach(() => {
  forget("best-times");
  results = new Results();
});

function won(episode, seconds, by = KEYS, changes = {}) {
  return results.of({ title: "Chase", episode, outcome: "goal", seconds, ...changes }, "chase", by);
}

test("a time is the first, then better or slower than the best", () => {
  assert.deepEqual(won(1, 5), { seconds: 5, best: 5, kind: FIRST, by: KEYS });
  assert.deepEqual(won(2, 4), { seconds: 4, best: 4, kind: BEST, by: KEYS });
  assert.deepEqual(won(3, 4), { seconds: 4, best: 4, kind: SLOWER, by: KEYS });
  assert.deepEqual(won(4, 9).best, 4);
  assert.equal(results.best("chase", KEYS), 4);
});

test("each episode counts once, until another one runs", () => {
  won(1, 5);
  assert.equal(won(1, 5).kind, FIRST);
  results.of({ title: "Chase", episode: 1 }, "chase", KEYS);
  assert.equal(won(1, 5).kind, SLOWER);
});

test("drivers and tasks have best times of their own", () => {
  won(1, 5);
  assert.equal(won(2, 7, PROGRAM).kind, FIRST);
  assert.deepEqual([results.best("chase", PROGRAM), results.best("sumo", KEYS)], [7, null]);
  assert.equal(JSON.parse(kept.get("ai4u-best-times")).chase.keys, 5);
});

test("no time is kept of a defeat, of the past, or of others", () => {
  assert.equal(won(1, 5, KEYS, { outcome: "fell" }), null);
  assert.equal(won(2, 5, KEYS, { past: "episode 3" }), null);
  assert.equal(won(3, 5, ""), null);
  assert.equal(results.of(null, "chase", KEYS), null);
});

test("the best times of a task are told together; a network's are not a person's", () => {
  assert.equal(timesText("chase"), "");
  assert.equal(hasWon(), false);
  won(1, 5, PROGRAM);
  won(2, 3, NETWORK);
  assert.match(timesText("chase"), /^Best: your program 5[.,]0 s$/);
  assert.equal(hasWon(), false);
  won(3, 7.25);
  assert.match(timesText("chase"), /^Best: you 7[.,][23] s · your program 5[.,]0 s$/);
  assert.equal(hasWon(), true);
});

test("the words tell the time and the best one", () => {
  const about = (kind, by = KEYS) => timeText({ seconds: 2.25, best: 1, kind, by });
  assert.match(about(FIRST), /^ 2[.,][23] s$/);
  assert.match(about(BEST), /s – your best$/);
  assert.match(about(SLOWER, PROGRAM), / \(your program's best: 1[.,]0 s\)$/);
});

test("a race says by how much it was won or lost, whoever is the ghost", () => {
  const ghost = (changes = {}) => ({ ghost: "network", seed: "1", is_won: true, seconds: 8, full_speed_s: 8, score: 10, ...changes });
  const end = (seconds, outcome = "goal", reward = 5) => ({ seconds, outcome, reward });
  assert.equal(raceText(ghost(), end(6.6)), "You beat it by 1.4 s!");
  assert.equal(raceText(ghost(), end(9.5)), "The network was 1.5 s faster.");
  assert.equal(raceText(ghost(), end(8.01)), "As fast as the network!");
  assert.equal(raceText(ghost(), end(3, "fell")), "The network got there in 8.0 s.");
  assert.equal(raceText(ghost({ is_won: false }), end(9)), "You beat it: the network did not get there.");
  assert.equal(raceText(ghost({ is_won: false }), end(9, "time")), "The network did not get there either.");
  const slowed = ghost({ full_speed_s: 2 });
  assert.equal(raceText(slowed, end(6.6)), "You beat it by 1.4 s! At full speed it needs 2.0 s.");
  assert.match(slowedText(slowed), /slowed down: it takes 8.0 s in place of 2.0 s/);
  assert.equal(slowedText(ghost()), "");
  // the network drives, and the ghost is the person's drive
  const drive = (changes = {}) => ghost({ ghost: "drive", ...changes });
  assert.equal(raceText(drive(), end(9.4)), "You beat it by 1.4 s!");
  assert.equal(raceText(drive(), end(6)), "It beat your drive by 2.0 s.");
  assert.equal(raceText(drive(), end(6, "fell")), "You beat it: you got there in 8.0 s!");
  assert.equal(raceText(drive({ is_won: false }), end(6)), "It beat your drive, which did not get there.");
});

test("without a goal the points decide", () => {
  const race = { ghost: "network", seed: "1", is_won: null, seconds: 8, full_speed_s: 8, score: 10 };
  assert.equal(raceText(race, { outcome: "time", seconds: 8, reward: 12 }), "You beat it: 12.0 points, the network 10.0.");
  assert.equal(raceText(race, { outcome: "time", seconds: 8, reward: 2 }), "You: 2.0 points, the network 10.0.");
  assert.equal(raceText({ ...race, ghost: "drive" }, { outcome: "time", seconds: 8, reward: 2 }), "You beat it: 10.0 points, the network 2.0.");
});
