/** The start page: play a scene of the library, build one, or learn. */

import { syncStars } from "../classroom/student/stars.js";
import { element, find } from "../shared/dom.js";
import { ask, tell } from "../shared/dialog.js";
import { request, unsavedSentence } from "../scenes/api.js";
import { scenePicture } from "../scenes/picture.js";
import { timesText } from "../page/results.js";
import { watchSharedScene } from "../scenes/share.js";
import { starRow, starsOf } from "../scenes/stars.js";

/** Name of the empty plate with a robot. */
const EMPTY_SCENE = "my_scene";
const goToWorld = () => location.assign("./");
/** Sections by the card that shows them; one of them is open at a time. */
const sections = new Map([
  [find("#play"), find("#scenes")],
  [find("#learn"), find("#lessons")],
]);
let isOpening = false;
let cards = 0;

for (const [card, section] of sections) {
  card.addEventListener("click", () => {
    for (const [each, its] of sections) {
      its.hidden = its !== section;
      each.setAttribute("aria-expanded", String(its === section));
    }
    section.scrollIntoView({ block: "nearest" });
  });
}
find("#build").addEventListener("click", () => open({ name: EMPTY_SCENE }, "My scene"));
watchSharedScene(goToWorld);
showPresent();
showScenes();
showLessons();

/**
 * @typedef {object} Card a scene of the library, or one that somebody saved
 * @property {string} name
 * @property {string} title
 * @property {string} goal
 * @property {string} level
 * @property {number | null} minutes to reach the goal for the first time
 * @property {number} stars
 * @property {string} key of its task, for best times; empty for a saved one
 * @property {string} picture its address
 */

/**
 * Open a scene in the world, after a question if the present one has unsaved changes.
 * @param {{name: string} | {saved: string}} wanted one of the library, or a saved one
 * @param {string} title
 */
async function open(wanted, title) {
  if (isOpening) return;
  isOpening = true;
  try {
    const text = await unsavedSentence();
    if (text && !(await ask({ title: `Open ${title}?`, text, yes: "Open" }))) return;
    find("main").setAttribute("aria-busy", "true");
    await request("api/scene", wanted);
    goToWorld();
  } catch (error) {
    await tell("The scene can't be opened", error.message);
  } finally {
    find("main").removeAttribute("aria-busy");
    isOpening = false;
  }
}

async function showPresent() {
  const { title } = await request("api/scene");
  find("#present").textContent = `Back to “${title}”`;
}

async function showScenes() {
  const list = find("#library");
  try {
    /** @type {[{scenes: Card[], saved: Card[]}, void]} */
    const [{ scenes, saved }] = await Promise.all([request("api/scenes"), syncStars()]);
    list.replaceChildren(...scenes.map((scene) => sceneCard(scene, { name: scene.name })));
    find("#saved ul").replaceChildren(...saved.map((scene) => sceneCard(scene, { saved: scene.name })));
    find("#saved").hidden = saved.length === 0;
  } catch (error) {
    find("#scenes [role=status]").textContent = error.message;
  }
  list.removeAttribute("aria-busy");
}

/**
 * @param {Card} card
 * @param {{name: string} | {saved: string}} wanted
 */
function sceneCard({ name, title, goal, level, minutes, stars, key, picture }, wanted) {
  cards += 1;
  const id = cards;
  const facts = [level, minutes && `${minutes} min`].filter(Boolean).join(" · ");
  const row = stars > 0 && starRow(starsOf(name), stars).element;
  const times = timesText(key);
  const button = element(
    "button",
    { type: "button" },
    scenePicture(picture, title),
    element("span", { className: "ai4u-name", id: `title-${id}`, textContent: title }),
    element("span", { className: "ai4u-facts", id: `facts-${id}`, hidden: !facts && !row }, facts, row),
    element("span", { className: "ai4u-times", id: `times-${id}`, hidden: !times, textContent: times }),
    element("span", { id: `goal-${id}`, textContent: goal }),
  );
  button.setAttribute("aria-labelledby", `title-${id}`);
  button.setAttribute("aria-describedby", `facts-${id} times-${id} goal-${id}`);
  button.addEventListener("click", () => open(wanted, title));
  return element("li", {}, button);
}

async function showLessons() {
  /** @type {{lessons: {number: string, title: string, duration: string}[]}} */
  const { lessons } = await request("api/lessons");
  const items = lessons.map(({ number, title, duration }) =>
    element(
      "li",
      {},
      element("span", { className: "ai4u-number", textContent: number }),
      element("span", { textContent: title }),
      element("span", { className: "ai4u-facts", textContent: duration }),
    ),
  );
  find("#lessons ol").replaceChildren(...items);
}
