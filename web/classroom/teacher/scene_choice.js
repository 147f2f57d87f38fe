/** Choice of a scene for the class: the library, a student's room, or a file of the teacher. */

/** @import { ClassState } from "../../types/class.js" */

import { choices, chosenIn, field, select } from "../../shared/form_dialog.js";
import { element } from "../../shared/dom.js";
import { islandTitle } from "../../missions/islands.js";
import { t } from "../../shared/text.js";
import { roomName } from "../room_words.js";
import { scenePicture } from "../../scenes/picture.js";

/**
 * Return {nodes, value}: elements for a form, and a function that resolves to the command's `scene`.
 *
 * @param {ClassState} state
 * @param {{withLessons?: boolean}} [options] true if a lesson of the course, or a mission, may be chosen too
 */
export function sceneChoice(state, { withLessons = false } = {}) {
  const scenes = state.scenes.map(({ name, title }) => [name, title]);
  const rooms = state.rooms.map((room) => [room.id, `${roomName(room, state)}: ${room.scene}`]);
  const lessons = withLessons ? state.lessons.map(({ number, title }) => [number, `${number} ${title}`]) : [];
  const missions = withLessons ? (state.missions ?? []).map(({ name, title, island }) => [name, `${islandTitle(island)}: ${title}`]) : [];
  const sources = { library: t("From the library"), lesson: t("A lesson"), mission: t("A mission"), room: t("A student’s present scene"), file: t("My own file") };
  if (!withLessons) delete sources.lesson;
  if (missions.length === 0) delete sources.mission;
  if (rooms.length === 0) delete sources.room;
  const source = choices(t("Scene"), "scene-source", sources, "library");
  const inLibrary = select(scenes);
  const ofLesson = select(lessons);
  const ofMission = select(missions);
  const ofRoom = select(rooms);
  const file = element("input", { type: "file", accept: ".yaml,.yml" });
  const fields = {
    library: field(t("Which scene"), inLibrary),
    lesson: field(t("Which lesson"), ofLesson, t("Worlds open the scene that it begins with. Notebooks show its title and keep their world.")),
    mission: field(t("Which mission"), ofMission, t("Worlds open its scene, and pages its card. Who has finished some steps goes on there.")),
    room: field(t("Whose"), ofRoom),
    file: field(t("Scene file (YAML)"), file),
  };
  const place = element("div");
  const update = () => {
    const from = chosenIn(source);
    for (const [name, each] of Object.entries(fields)) each.hidden = name !== from;
    const lesson = state.lessons.find(({ number }) => number === ofLesson.value);
    const chosen = from === "library" ? inLibrary.value : from === "lesson" ? lesson?.scene : "";
    const shown = state.scenes.filter(({ name }) => name === chosen);
    place.replaceChildren(...shown.map(({ picture, title }) => scenePicture(picture, title)));
  };
  for (const each of [source, inLibrary, ofLesson]) each.addEventListener("change", update);
  update();

  async function value() {
    const from = chosenIn(source);
    if (from === "library") return inLibrary.value;
    if (from === "lesson") return { lesson: ofLesson.value };
    if (from === "mission") return { mission: ofMission.value };
    if (from === "room") return { room: ofRoom.value };
    if (!file.files[0]) throw new Error(t("Choose a scene file first."));
    const yaml = await file.files[0].text();
    const most = state.max_scene_chars;
    if (yaml.length > most) throw new Error(t("This file has {length} characters; a scene has at most {most}.", { length: yaml.length, most }));
    return { yaml };
  }
  return { nodes: [source, ...Object.values(fields), place], value };
}

/**
 * Return {node, value}: a field for a seed, and a function that returns it, or null if it is left empty.
 * @param {string} hint
 */
export function seedField(hint) {
  const input = element("input", { type: "number", min: 0, max: 2 ** 32 - 1, step: 1 });
  return { node: field(t("Seed (optional)"), input, hint), value: () => (input.value === "" ? null : Number(input.value)) };
}
