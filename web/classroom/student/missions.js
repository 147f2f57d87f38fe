/**
 * The class's copy of a student's progress in missions: it is there on another device, and the teacher sees who is where.
 *
 * Only a page of a class does this; elsewhere nothing is sent. Where the two differ, the larger number counts. While the class can't be
 * reached, this browser keeps everything, and sends it later.
 */

/** @import { Progress } from "../../missions/progress.js" */

import { allProgress, missions, reach } from "../../missions/progress.js";
import { roomOfPage } from "../../shared/room.js";

const ADDRESS = "../../api/mission-progress";
/** Delay before the class is asked again if it can't be reached (ms). */
const RETRY_MS = 10_000;
const NOTHING = { steps: 0, stars: 0 };

/**
 * The step that a page shows; an empty mission for none.
 * @typedef {{mission: string, step?: number, is_done?: boolean, hint?: string, hints?: number}} Place
 */
/** @typedef {{missions: Record<string, Progress>, place?: Place}} Report */

/**
 * Progress that the class has, or has refused, by mission; null before its first answer.
 * @type {Record<string, Progress> | null}
 */
let known = null;
/**
 * The place to tell; null if the class knows it.
 * @type {Place | null}
 */
let untold = null;
let latest = "";
let isInClass = roomOfPage() !== "";
let isBusy = false;
let isWatching = false;
let timer = 0;

/** Fetch the progress that the class has, and send what it has not, now and whenever more is reached. */
export async function syncMissions() {
  if (!isInClass) return;
  if (!isWatching) missions.addEventListener("change", () => exchange());
  isWatching = true;
  await exchange();
}

/**
 * Tell where this page is.
 * @param {Place} place
 */
export function tellPlace(place) {
  const text = JSON.stringify(place);
  if (!isInClass || text === latest) return;
  latest = text;
  untold = place;
  exchange();
}

async function exchange() {
  if (isBusy || !isInClass) return;
  isBusy = true;
  clearTimeout(timer);
  let isReached = known !== null || (await send());
  for (let next = report(); isReached && next !== null; next = report()) isReached = await send(next);
  isBusy = false;
  if (!isReached && isInClass) timer = setTimeout(exchange, RETRY_MS);
}

/**
 * Return what the class has to be told; null if that is nothing.
 * @returns {Report | null}
 */
function report() {
  if (known === null) return null; // what it has is asked first
  const more = Object.entries(allProgress()).filter(([mission, { steps, stars }]) => {
    const has = (Object.hasOwn(known, mission) && known[mission]) || NOTHING;
    return steps > has.steps || stars > has.stars;
  });
  if (more.length === 0 && untold === null) return null;
  return { missions: Object.fromEntries(more), ...(untold && { place: untold }) };
}

/**
 * Send a report, or nothing, and take what the class has; returns false if it can't be reached.
 * @param {Report | null} [body]
 */
async function send(body = null) {
  const method = body ? "PUT" : "GET";
  const options = body && { headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
  try {
    const answer = await fetch(ADDRESS, { method, cache: "no-store", ...options });
    if (answer.status === 403) isInClass = false; // a teacher who looks in, or a student who was sent out
    const isRefused = answer.status === 422; // another edition: not again
    if (!answer.ok && !isRefused) return false;
    /** @type {Record<string, Progress>} */
    const has = isRefused ? {} : (await answer.json()).missions;
    // what was sent is not sent again, also if the class has not kept it: a teacher may have changed or removed the mission
    known ??= {};
    for (const [mission, some] of [...Object.entries(has), ...Object.entries(body?.missions ?? {})]) {
      known[mission] = larger(some, Object.hasOwn(known, mission) ? known[mission] : NOTHING);
    }
    if (body?.place === untold) untold = null;
    for (const [mission, progress] of Object.entries(has)) reach(mission, progress);
    return true;
  } catch {
    return false;
  }
}

/**
 * @param {Progress} one
 * @param {Progress} other
 */
function larger(one, other) {
  return { steps: Math.max(one.steps, other.steps), stars: Math.max(one.stars, other.stars) };
}
