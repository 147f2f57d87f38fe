/** The checks of the five steps: they look at what the robot senses and does, not at its blocks. */

/** @import { PythonPart, RayLayout } from "../generated/messages.js" */

import { sideOf } from "./agent.js";

/** Distances (m) of the robot's centre to a wall; its radius is 0.4. */
const [REACHED_M, FREE_M, TOUCHING_M] = [0.45, 0.6, 0.41];
/** Decisions in a row in which it has to stand still. */
const STILL_DECISIONS = 10;
const WALLS = 3;
/** A wall ahead, and no wall ahead any more (m). */
const [WALL_M, CLEAR_M] = [0.9, 1.2];
/** Range of distances to the wall at the right (m). */
const [RIGHT_MIN_M, RIGHT_MAX_M] = [0.45, 1.3];
const FOLLOWED_DECISIONS = 300;
/** Shares of the latest decisions in which the wall is that near, and in which the robot drives on. */
const [MIN_NEAR_SHARE, MIN_DRIVING_SHARE] = [0.75, 0.55];
const GOALS = 8;

/** @typedef {{around: number, ahead: number, right: number, forward: number, turn: number}} Seen distances in metres */
/** @typedef {{outcome: string}[]} Starts */
/** @typedef {{isDone: boolean, words: string, see: (seen: Seen) => void, test: (starts: Starts) => void}} Check */

/**
 * Return what a check looks at, of a decision; null if the robot has no such senses or actions.
 * @param {Pick<PythonPart, "sensors" | "actuators">} part
 * @param {{percept: Record<string, unknown>, action: Record<string, number[]> | null}} decision
 * @returns {Seen | null}
 */
export function seen(part, { percept, action }) {
  const sensor = part.sensors.find(({ rays, stack }) => rays?.has_distance && stack === 1);
  const actuator = part.actuators.find(({ components }) => components.some(({ name }) => name === "forward"));
  const values = /** @type {number[]} */ (percept?.[sensor?.key]);
  const numbers = action?.[actuator?.name];
  if (!values || !numbers) return null;
  const number = (/** @type {string} */ name) => numbers[actuator.components.findIndex((component) => component.name === name)] ?? 0;
  const [around, ahead, right] = ["around", "ahead", "right"].map((side) => nearest(sensor.rays, values, side));
  return { around, ahead, right, forward: number("forward"), turn: number("turn") };
}

/**
 * @param {RayLayout} rays
 * @param {number[]} values
 * @param {string} side
 */
function nearest(rays, values, side) {
  const width = Number(rays.has_code) + Number(rays.has_distance);
  const { first, count } = sideOf(side, rays.angles_deg);
  const found = Array.from({ length: count }, (_, index) => values[(first + index) * width + width - 1] || rays.reach);
  return (Math.min(...found) * rays.reach_m) / rays.reach;
}

/** Each check is made again for a run: `see` takes a decision, and `isDone` and `words` tell how far it is. */
export const CHECKS = [reachesWall, stopsInTime, turnsAway, followsWall, findsExit];

function reachesWall() {
  let wasFree = false;
  return check((its, { around, forward }) => {
    wasFree ||= around > FREE_M && forward > 0;
    its.isDone ||= wasFree && around < REACHED_M;
  });
}

function stopsInTime() {
  let [hasDriven, still] = [false, 0];
  return check((its, { around, forward, turn }) => {
    hasDriven ||= forward > 0;
    still = forward || turn || around < TOUCHING_M ? 0 : still + 1;
    its.isDone ||= hasDriven && still >= STILL_DECISIONS;
  });
}

function turnsAway() {
  let [isAtWall, walls] = [false, 0];
  return check((its, { ahead, forward }) => {
    if (ahead < WALL_M) isAtWall = true;
    else if (isAtWall && ahead > CLEAR_M && forward > 0) [isAtWall, walls] = [false, walls + 1];
    its.isDone ||= walls >= WALLS;
    its.words = `${Math.min(walls, WALLS)} of ${WALLS} walls`;
  });
}

function followsWall() {
  /** @type {{isNear: boolean, drives: boolean}[]} */
  const latest = [];
  return check((its, { right, forward }) => {
    latest.push({ isNear: right > RIGHT_MIN_M && right < RIGHT_MAX_M, drives: forward > 0 });
    if (latest.length > FOLLOWED_DECISIONS) latest.shift();
    const share = (/** @type {"isNear" | "drives"} */ name) => latest.filter((decision) => decision[name]).length / latest.length;
    const isFull = latest.length === FOLLOWED_DECISIONS;
    its.isDone ||= isFull && share("isNear") >= MIN_NEAR_SHARE && share("drives") >= MIN_DRIVING_SHARE;
    its.words = `beside a wall in ${Math.round(100 * share("isNear"))}% of ${latest.length} decisions`;
  });
}

function findsExit() {
  const its = check(() => {});
  its.test = (rows) => {
    const goals = rows.filter(({ outcome }) => outcome === "goal").length;
    its.isDone ||= goals >= GOALS;
    its.words = `${goals} of ${rows.length} starts`;
  };
  return its;
}

/** @param {(its: Check, seen: Seen) => void} see */
function check(see) {
  /** @type {Check} */
  const its = { isDone: false, words: "", see: (seen) => see(its, seen), test: () => {} };
  return its;
}
