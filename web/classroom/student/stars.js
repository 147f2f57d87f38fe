/**
 * The class's copy of a student's stars: the teacher sees them, and they are there on another device.
 *
 * Only a page of a class does this; elsewhere nothing is sent. Where the two differ, the larger number counts.
 */

import { allStars, earn, stars } from "../../scenes/stars.js";
import { roomOfPage } from "../../shared/room.js";

const ADDRESS = "../../api/stars";
/** Delay before the class is asked again if it can't be reached (ms). */
const RETRY_MS = 10_000;

/**
 * Stars that the class has, by scene; null before its first answer.
 * @type {Record<string, number> | null}
 */
let known = null;
let isInClass = roomOfPage() !== "";
let isBusy = false;
let isWatching = false;
let timer = 0;

/** Fetch the stars of the class, and send those that it has not, now and whenever a program earns some. */
export async function syncStars() {
  if (!isInClass) return;
  if (!isWatching) stars.addEventListener("change", () => exchange());
  isWatching = true;
  await exchange();
}

async function exchange() {
  if (isBusy || !isInClass) return;
  isBusy = true;
  clearTimeout(timer);
  let isReached = known !== null || (await send());
  for (let next = missing(); isReached && next !== null; next = missing()) isReached = await send(next);
  isBusy = false;
  if (!isReached && isInClass) timer = setTimeout(exchange, RETRY_MS);
}

/** Return stars that the class has not, as the body of a request; null if there are none. */
function missing() {
  if (known === null) return null; // the class was not reached yet
  const found = Object.entries(allStars()).find(([scene, count]) => count > (known[scene] ?? 0));
  return found ? { scene: found[0], stars: found[1] } : null;
}

/**
 * Send stars, or nothing, and take those that the class has; returns false if it can't be reached.
 * @param {{scene: string, stars: number} | null} [body]
 */
async function send(body = null) {
  const method = body ? "PUT" : "GET";
  const options = body && { headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
  try {
    const answer = await fetch(ADDRESS, { method, cache: "no-store", ...options });
    if (answer.status === 403) isInClass = false; // a teacher who looks in, or a student who was sent out
    if (answer.status === 422) known = { ...known, [body.scene]: body.stars }; // another edition of the library: not again
    if (!answer.ok) return answer.status === 422;
    known = (await answer.json()).stars;
  } catch {
    return false;
  }
  for (const [scene, count] of Object.entries(known)) earn(scene, count);
  return true;
}
