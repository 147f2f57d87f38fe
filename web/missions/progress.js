/** A person's progress in missions; this browser keeps it, and the mission that is open. */

import { roomOfPage } from "../shared/room.js";
import { forget, recall, remember, storageKey } from "../shared/storage.js";

/** Most missions whose progress is kept, and the largest count of steps and stars. */
const [MAX_MISSIONS, MAX_COUNT] = [300, 100];

/** @typedef {{steps: number, stars: number}} Progress of one mission: finished steps, earned stars */

/** Tells with the event "change" that more was reached in a mission, and with "assigned" that the teacher has given one. */
export const missions = new EventTarget();
/** The mission that the teacher has given and that was not opened yet. */
let wanted = "";

/**
 * Return the progress in all missions that were begun.
 * @returns {Record<string, Progress>}
 */
export function allProgress() {
  const begun = Object.keys(kept()).map((mission) => /** @type {const} */ ([mission, progressOf(mission)]));
  return Object.fromEntries(begun.filter(([, { steps, stars }]) => steps || stars));
}

/**
 * Return the progress in a mission.
 * @param {string} mission
 * @returns {Progress}
 */
export function progressOf(mission) {
  const all = kept();
  const { steps, stars } = (Object.hasOwn(all, mission) && all[mission]) || {};
  return { steps: count(steps), stars: count(stars) };
}

/**
 * Keep progress in a mission: what was reached before is never lost. Returns true if it is more than before.
 * @param {string} mission
 * @param {Progress} reached
 */
export function reach(mission, { steps, stars }) {
  const before = progressOf(mission);
  const now = { steps: Math.max(before.steps, count(steps)), stars: Math.max(before.stars, count(stars)) };
  if (now.steps === before.steps && now.stars === before.stars) return false;
  const all = { ...kept(), [mission]: now };
  if (Object.keys(all).length > MAX_MISSIONS) return false;
  remember(key("missions"), all);
  missions.dispatchEvent(new Event("change"));
  return true;
}

/**
 * Return the mission that is open, and its step; null if none is.
 * @returns {{mission: string, step: number, isHidden: boolean} | null}
 */
export function openMission() {
  const open = recall(key("mission"), null);
  if (typeof open?.mission !== "string" || !open.mission) return null;
  return { mission: open.mission, step: count(open.step), isHidden: Boolean(open.isHidden) };
}

/**
 * Keep the mission that is open; null for none.
 * @param {{mission: string, step: number, isHidden?: boolean} | null} open
 */
export function setOpenMission(open) {
  if (open === null) forget(key("mission"));
  else remember(key("mission"), open);
}

/**
 * Return the mission that the teacher has given; empty if there is none.
 * @returns {string}
 */
export function assignedMission() {
  const { mission } = recall(key("assigned-mission"), null) ?? {};
  return typeof mission === "string" ? mission : "";
}

/**
 * Note the mission that the teacher has given. This browser opens it once for each assignment.
 * @param {{mission: string, assignment: string}} given an empty mission for none
 */
export function noteAssigned({ mission, assignment }) {
  const before = recall(key("assigned-mission"), null) ?? {};
  if (before.assignment === assignment && before.mission === mission) return;
  remember(key("assigned-mission"), { mission, assignment });
  wanted = mission;
  if (mission) missions.dispatchEvent(new Event("assigned"));
}

/** Return the mission that the teacher has given and that was not opened yet, once; empty if there is none. */
export function takeAssigned() {
  const taken = wanted;
  wanted = "";
  return taken;
}

/** Return the key under which the open mission is stored: another window of this browser may change it. */
export function storedKey() {
  return storageKey(key("mission"));
}

/** @returns {Record<string, Partial<Progress> | undefined>} */
function kept() {
  const all = recall(key("missions"), {});
  return all !== null && typeof all === "object" && !Array.isArray(all) ? all : {};
}

/** @param {unknown} value from storage, which may hold anything */
function count(value) {
  return Number.isInteger(value) ? Math.min(Math.max(Number(value), 0), MAX_COUNT) : 0;
}

/**
 * Students of a class may use one device in turn.
 * @param {string} name
 */
function key(name) {
  const room = roomOfPage();
  return `${name}-${room && `${room}/`}`;
}
