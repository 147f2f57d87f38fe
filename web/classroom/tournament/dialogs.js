/** The dialogs that begin a tournament, and start its games. */

/** @import { ClassState } from "../../types/class.js" */

import { command } from "../teacher/command.js";
import { element, setText } from "../../shared/dom.js";
import { choice, choices, chosenIn, field, select, showForm } from "../../shared/form_dialog.js";
import { t, tn } from "../../shared/text.js";
import { scenePicture } from "../../scenes/picture.js";

const SEEDS = [1, 2, 3, 5, 10];
const DEFAULT_SEED = "2";
const SYSTEMS = { "round-robin": t("All play all"), swiss: t("Neighbours in the standings (Swiss system): fewer games") };

/**
 * Ask for the scene of a tournament.
 * @param {ClassState} state
 */
export function showBegin(state) {
  const scenes = [...state.scenes].sort((a, b) => Number(b.is_duel) - Number(a.is_duel));
  const scene = select(scenes.map(({ name, title, is_duel: isDuel }) => [name, isDuel ? t("{scene} (a duel)", { scene: title }) : t("{scene} (a race)", { scene: title })]), "sumo");
  const hint = t("In a duel two networks play against each other. In a race each drives alone on the same starts.");
  const place = element("div");
  const update = () => {
    const shown = scenes.filter(({ name, picture }) => name === scene.value && picture);
    place.replaceChildren(...shown.map(({ picture, title }) => scenePicture(picture, title)));
  };
  scene.addEventListener("change", update);
  update();
  const text = t("Students hand in networks for this scene: with “Hand in” above their world, or with submit(…) in a notebook. Then you start the games.");
  return showForm({ title: t("Tournament"), text, content: [field(t("Scene"), scene, hint), place], yes: t("Collect networks") }, () =>
    command({ do: "tournament", scene: scene.value }),
  );
}

/**
 * Ask how to play a tournament, and start it.
 * @param {ClassState} state
 */
export function showStart(state) {
  const { players, scene } = state.tournament;
  const isDuel = state.scenes.find(({ name }) => name === scene)?.is_duel ?? true;
  const seeds = select(SEEDS.map((count) => [String(count), String(count)]), DEFAULT_SEED);
  const system = choices(t("Who plays whom"), "system", SYSTEMS, "round-robin");
  const own = element("input", { type: "checkbox", checked: players < 2 });
  const games = element("p", { role: "status" });
  const update = () => {
    const entries = players + Number(own.checked);
    const count = gameCount(entries, Number(seeds.value), isDuel ? chosenIn(system) : "race");
    const playing = tn("{n} player", "{n} players", entries);
    setText(games, tn("{players}: {n} game.", "{players}: {n} games.", count, { players: playing }));
  };
  const content = [
    ...(isDuel ? [system] : []),
    field(isDuel ? t("Matches of each pair") : t("Races"), seeds, isDuel ? t("A match is two games from the same start, in which they change sides.") : t("Each from another start.")),
    choice(t("The scene’s own player takes part, too"), own),
    games,
  ];
  for (const each of content) each.addEventListener("change", update);
  update();
  const text = t("Only networks that have passed their check take part. Games that were played before with the same networks are not played again.");
  return showForm({ title: t("Start the tournament"), text, content, yes: t("Start") }, () =>
    command({ do: "start tournament", seeds: Number(seeds.value), system: isDuel ? chosenIn(system) : "round-robin", own_player: own.checked }),
  );
}

/**
 * Return the number of games; as Plan.games_for of the package.
 * @param {number} entries
 * @param {number} seeds
 * @param {string} system
 */
function gameCount(entries, seeds, system) {
  if (system === "race") return entries * seeds;
  if (system === "round-robin") return entries * (entries - 1) * seeds;
  const rounds = Math.ceil(Math.log2(Math.max(2, entries))) + 1;
  return Math.floor(entries / 2) * rounds * 2 * seeds;
}
