/** The selected things of the world, and what can be done with all of them at once. */

/**
 * @import { Align } from "../../generated/messages.js"
 * @import { Panel } from "../panel.js"
 * @import { Point } from "./ground.js"
 */

/** Radius of the knobs that turn and resize a thing (px). */
const KNOB_PX = 14;
const TOUCH_KNOB_PX = 22;

/**
 * Return the names of all selected things.
 * @param {Panel} panel
 */
export function selected(panel) {
  const { body, others } = panel.shown;
  return body ? [body, ...(others ?? [])] : [];
}

/**
 * Select a thing, and others with it: its form opens, and the picture marks them.
 * @param {Panel} panel
 * @param {string | null} body
 * @param {string[]} [others]
 */
export function choose(panel, body, others = []) {
  panel.show({ body, others });
  panel.send("select", { body, others }, { quiet: true });
}

/**
 * Select things besides those that are, or let those go that are selected already.
 * @param {Panel} panel
 * @param {string[]} names
 * @param {{isToggle?: boolean}} [options]
 */
export function chooseMore(panel, names, { isToggle = false } = {}) {
  const before = selected(panel);
  const kept = before.filter((name) => !isToggle || !names.includes(name));
  const [body = null, ...others] = [...kept, ...names.filter((name) => !before.includes(name))];
  choose(panel, body, others);
}

/** @param {Panel} panel */
export async function removeSelected(panel) {
  const names = selected(panel);
  const answer = await panel.send("remove_bodies", { names });
  if (answer.ok && selected(panel).some((name) => names.includes(name))) choose(panel, null);
}

/** @param {Panel} panel */
export async function duplicateSelected(panel) {
  chooseAdded(panel, await panel.send("duplicate", { names: selected(panel) }));
}

/** @param {Panel} panel */
export function copySelected(panel) {
  panel.send("copy", { names: selected(panel) });
}

/**
 * @param {Panel} panel
 * @param {Point | null} place of the middle of what is pasted (m); null for beside where it was
 */
export async function paste(panel, place) {
  chooseAdded(panel, await panel.send("paste", place ?? {}));
}

/**
 * @param {Panel} panel
 * @param {Align["how"]} how
 */
export function alignSelected(panel, how) {
  panel.send("align", { names: selected(panel), how });
}

/**
 * Let things be moved with the mouse or a finger, by knobs that are large enough for it.
 * @param {Panel} panel
 * @param {boolean} on
 */
export function setMoveMode(panel, on) {
  const radius = matchMedia("(pointer: coarse)").matches ? TOUCH_KNOB_PX : KNOB_PX;
  const height = document.getElementById("root")?.clientHeight || innerHeight;
  panel.send("move_mode", { on, knob: Math.min(0.2, Math.max(0.005, radius / height)) }, { quiet: true });
}

/**
 * Select what was added.
 * @param {Panel} panel
 * @param {{ok: boolean, bodies?: string[]}} answer
 */
export function chooseAdded(panel, { ok, bodies = [] }) {
  const [body, ...others] = bodies;
  if (ok && body) choose(panel, body, others);
}
