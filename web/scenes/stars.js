/** Stars that a person's programs have earned in the scenes of the library; this browser keeps them. */

import { element, setAttributes, setText } from "../shared/dom.js";
import { roomOfPage } from "../shared/room.js";
import { recall, remember } from "../shared/storage.js";
import { t } from "../shared/text.js";

const MAX_STARS = 3;
/** Most scenes whose stars are kept. */
const MAX_SCENES = 200;

/** Tells with the event "change" that a scene has more stars. */
export const stars = new EventTarget();

/** Return the stars of all scenes: {name: 1 to 3}. */
export function allStars() {
  const kept = recall(key(), {});
  const isMap = kept !== null && typeof kept === "object" && !Array.isArray(kept);
  return isMap ? Object.fromEntries(Object.entries(kept).filter(([, count]) => isCount(count))) : {};
}

/**
 * Return the stars of a scene, from 0.
 * @param {string} scene
 */
export function starsOf(scene) {
  const all = allStars();
  return Object.hasOwn(all, scene) ? all[scene] : 0;
}

/**
 * Note that a program has earned stars in a scene; returns true if these are more than before.
 * @param {string} scene
 * @param {number} count
 */
export function earn(scene, count) {
  if (!isCount(count) || count <= starsOf(scene)) return false;
  const all = { ...allStars(), [scene]: count };
  if (Object.keys(all).length > MAX_SCENES) return false;
  remember(key(), all);
  stars.dispatchEvent(new CustomEvent("change", { detail: count }));
  return true;
}

/** Stars in a row, those that are earned filled. `set` shows other numbers; it is hidden where there is none to earn. */
export function starRow(earned = 0, total = 0) {
  const made = element("span", { className: "ai4u-stars", role: "img" });
  const set = (/** @type {number} */ count, /** @type {number} */ of) => {
    const filled = Math.min(count, of);
    setText(made, "★".repeat(filled) + "☆".repeat(of - filled));
    setAttributes(made, { "aria-label": t("{filled} of {all} stars", { filled, all: of }), "data-earned": filled > 0 });
    made.title = of ? t("Stars for your program") : "";
    made.hidden = of === 0;
  };
  set(earned, total);
  return { element: made, set };
}

/** @param {unknown} value */
function isCount(value) {
  return typeof value === "number" && Number.isInteger(value) && value >= 1 && value <= MAX_STARS;
}

/** Students of a class may use one device in turn. */
function key() {
  const room = roomOfPage();
  return `stars-${room && `${room}/`}`;
}
