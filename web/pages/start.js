/** The start page: a map of missions, the scenes of the library to play, and an empty one to build. */

import { syncMissions } from "../classroom/student/missions.js";
import { syncStars } from "../classroom/student/stars.js";
import { element, find } from "../shared/dom.js";
import { ask, tell } from "../shared/dialog.js";
import { remember } from "../shared/storage.js";
import { t } from "../shared/text.js";
import { islandTitle } from "../missions/islands.js";
import { assignedMission, progressOf, setOpenMission } from "../missions/progress.js";
import { request, unsavedSentence } from "../scenes/api.js";
import { scenePicture } from "../scenes/picture.js";
import { timesText } from "../page/results.js";
import { watchSharedScene } from "../scenes/share.js";
import { starRow, starsOf } from "../scenes/stars.js";

/** Name of the empty plate with a robot. */
const EMPTY_SCENE = "my_scene";
/** Names of scenes that are there to compare with, more than to be played. */
const FOR_TEACHERS = ["box_chase_ai4u"];
const goToWorld = () => location.assign("./");
/** Sections by the card that shows them; one of them is open at a time. */
const sections = new Map([
  [find("#learn"), find("#missions")],
  [find("#play"), find("#scenes")],
]);
let isOpening = false;
let cards = 0;

for (const [card, section] of sections) {
  card.addEventListener("click", () => {
    show(section);
    section.scrollIntoView({ block: "nearest" });
  });
}
if (location.hash === "#play") show(find("#scenes"));
find("#build").addEventListener("click", async () => {
  if (!(await open({ name: EMPTY_SCENE }, t("My scene")))) return;
  // whoever begins to build sees what there is to build with, on a phone, too
  remember("panel-tab", "build");
  for (const key of ["panel-folded", "panel-folded-small"]) remember(key, false);
});
watchSharedScene(goToWorld);
showPresent();
showScenes();
showMissions();

/** @param {HTMLElement} shown the section that is open from now on */
function show(shown) {
  for (const [card, section] of sections) {
    section.hidden = section !== shown;
    card.setAttribute("aria-expanded", String(section === shown));
  }
}

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
 * @returns {Promise<boolean>} true if it was opened
 */
async function open(wanted, title) {
  if (isOpening) return false;
  isOpening = true;
  try {
    const text = await unsavedSentence();
    if (text && !(await ask({ title: t("Open “{title}”?", { title }), text, yes: t("Open") }))) return false;
    find("main").setAttribute("aria-busy", "true");
    await request("api/scene", wanted);
    goToWorld();
    return true;
  } catch (error) {
    await tell(t("The scene can't be opened"), error.message);
    return false;
  } finally {
    find("main").removeAttribute("aria-busy");
    isOpening = false;
  }
}

async function showPresent() {
  const { title } = await request("api/scene");
  find("#present").textContent = t("Back to “{title}”", { title });
}

async function showScenes() {
  const list = find("#library");
  try {
    /** @type {[{scenes: Card[], saved: Card[]}, void]} */
    const [{ scenes, saved }] = await Promise.all([request("api/scenes"), syncStars()]);
    const isForTeachers = (/** @type {Card} */ { name }) => FOR_TEACHERS.includes(name);
    const libraryCard = (/** @type {Card} */ scene) => sceneCard(scene, { name: scene.name });
    list.replaceChildren(...scenes.filter((scene) => !isForTeachers(scene)).map(libraryCard));
    find("#teachers").replaceChildren(...scenes.filter(isForTeachers).map(libraryCard));
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
  const facts = [level, minutes && t("{minutes} min", { minutes })].filter(Boolean).join(" · ");
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

/**
 * @typedef {object} Mission
 * @property {string} name
 * @property {string} title
 * @property {string} island
 * @property {number} minutes
 * @property {number} steps
 * @property {number} stars that can be earned
 * @property {string} idea the word that it is about
 * @property {string} scene
 */

async function showMissions() {
  const map = find("#map");
  try {
    /** @type {[{missions: Mission[], problems: string[]}, void]} */
    const [{ missions, problems }] = await Promise.all([request("api/missions"), syncMissions()]);
    const islands = [...new Set(missions.map(({ island }) => island))];
    const next = missions.find(({ name, steps }) => progressOf(name).steps < steps);
    map.replaceChildren(...islands.map((island) => islandOf(island, missions.filter((mission) => mission.island === island), next)));
    find("#missions [role=status]").replaceChildren(...problems.map((problem) => element("span", { className: "ai4u-problem", textContent: problem })));
  } catch (error) {
    find("#missions [role=status]").textContent = error.message;
  }
  map.removeAttribute("aria-busy");
}

/**
 * @param {string} island
 * @param {Mission[]} missions
 * @param {Mission | undefined} next the first one on the map that is not done
 */
function islandOf(island, missions, next) {
  const done = missions.filter(({ name, steps }) => progressOf(name).steps >= steps).length;
  const heading = element("h3", {}, islandTitle(island), element("span", { className: "ai4u-facts", textContent: t("{done} of {all}", { done, all: missions.length }) }));
  const list = element("ol", {}, ...missions.map((mission) => missionCard(mission, mission === next)));
  // there are too many missions to see all at once: the island of the next one is open
  const isOpen = next !== undefined && missions.includes(next);
  const made = element("details", { className: "ai4u-island", name: "island", open: isOpen }, element("summary", {}, heading), list);
  made.toggleAttribute("data-done", done === missions.length);
  // the one above it closes, which moves this one
  made.addEventListener("toggle", () => made.open && !isOpen && made.scrollIntoView({ block: "nearest" }));
  return made;
}

/**
 * @param {Mission} mission
 * @param {boolean} isNext
 */
function missionCard(mission, isNext) {
  const { name, title, minutes, steps, stars, idea } = mission;
  const reached = progressOf(name);
  const isDone = reached.steps >= steps;
  const state = isDone ? t("done") : reached.steps ? t("{done} of {all} steps", { done: reached.steps, all: steps }) : t("{minutes} min", { minutes });
  const facts = element("span", { className: "ai4u-facts", textContent: [idea, state].filter(Boolean).join(" · ") });
  const row = starRow(reached.stars, stars).element;
  row.title = t("Stars of this mission");
  const button = element("button", { type: "button" }, element("span", { className: "ai4u-name", textContent: `${isDone ? "✓ " : ""}${title}` }), facts, row);
  button.toggleAttribute("data-done", isDone);
  button.toggleAttribute("data-next", isNext);
  const isGiven = name === assignedMission() && !isDone;
  if (isGiven) button.append(element("span", { className: "ai4u-facts", textContent: t("From your teacher") }));
  button.toggleAttribute("data-given", isGiven);
  button.setAttribute("aria-label", [title, isGiven ? t("from your teacher") : "", isDone ? t("done") : isNext ? t("the next one") : "", row.getAttribute("aria-label")].filter(Boolean).join(", "));
  button.title = mission.scene === EMPTY_SCENE ? t("My scene") : "";
  button.addEventListener("click", () => begin(mission, isDone ? 0 : reached.steps));
  return element("li", {}, button);
}

/**
 * Open a mission in the world, in its scene.
 * @param {Mission} mission
 * @param {number} step
 */
async function begin({ name, title, scene, steps }, step) {
  setOpenMission({ mission: name, step: Math.min(step, steps - 1) });
  const { name: present } = await request("api/scene");
  if (present === scene) goToWorld();
  else await open({ name: scene }, title);
}
