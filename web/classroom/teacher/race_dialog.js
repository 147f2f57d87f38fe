/** The dialog that starts a race. */

/** @import { ClassState } from "../../types/class.js" */

import { command } from "./command.js";
import { element } from "../../shared/dom.js";
import { choice, field, select, showForm } from "../../shared/form_dialog.js";
import { t } from "../../shared/text.js";
import { sceneChoice, seedField } from "./scene_choice.js";

const COUNTDOWNS = [
  ["5", t("5 seconds")],
  ["10", t("10 seconds")],
  ["20", t("20 seconds")],
  ["60", t("1 minute")],
];

/** @param {ClassState} state */
export function showRace(state) {
  const scene = sceneChoice(state);
  const countdown = select(COUNTDOWNS, "10");
  const seed = seedField(t("Empty: a random start, the same for all."));
  const hide = element("input", { type: "checkbox" });
  const content = [
    ...scene.nodes,
    field(t("Countdown"), countdown),
    seed.node,
    choice(t("Hide the board: everybody sees only their own best"), hide),
  ];
  const text = t("Everybody drives in their own room, from the same start. What they have built is kept.");
  return showForm({ title: t("Race"), text, content, yes: t("Start the countdown") }, async () => {
    const wanted = { scene: await scene.value(), seed: seed.value(), countdown: Number(countdown.value) };
    await command({ do: "race", ...wanted, hide_board: hide.checked });
  });
}
