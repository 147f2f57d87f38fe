/** Blocks of an agent's own senses and actions, with their Python. */

/** @import { ProgramActuator, ProgramSensor, PythonPart, RayLayout } from "../generated/messages.js" */
/** @import { Field } from "./kinds.js" */
/** @import { SenseFields } from "./text.js" */

import { ATOM, COMPARISON, PRODUCT, identifier } from "./words.js";
import { t } from "../shared/text.js";

/** @typedef {{code: string, order: number, functions: string[][]}} Value its code, how tightly it binds, and the functions that it needs */
/** @typedef {{type: string, message: string, fields: Field[], output: string, python: (fields: SenseFields) => Value, tooltip: string}} Sense */
/** @typedef {{type: string, message: string, fields: Field[], start: number, variable: string}} Action */
/**
 * @typedef {object} Part a number of an actuator; one without effect has a `rest` only
 * @property {string} rest its value at rest, as code
 * @property {string} [type] of its block
 * @property {string} [title]
 * @property {number} [low]
 * @property {number} [high]
 * @property {boolean} [isChoice]
 * @property {string} [variable]
 */
/** @typedef {{name: string, parts: Part[]}} Output an actuator */
/** @typedef {{senses: Sense[], actions: Action[], touches: ProgramSensor[], outputs: Output[]}} AgentBlocks */

/** Rays that are "ahead": their largest angle to the heading (degrees). */
const AHEAD_DEG = 20;
/** @type {Record<string, string>} */
const SECTORS = { around: t("on any side"), ahead: t("ahead"), left: t("to the left"), right: t("to the right") };
const STATISTICS = { min: t("smallest"), max: t("largest"), mean: t("mean") };
const TOUCHES = new Set(["TouchSensor", "GroupTouchSensor"]);
const EVENT = "EventSensor";
/** A sensor whose reading is the same in all decisions. */
const LEFT_OUT = new Set(["DoneSensor"]);

const FUNCTIONS = {
  nearest: [
    "def nearest(distances, reach):",
    "    # 0 stands for a ray that hits nothing",
    "    return min(each or reach for each in distances)",
  ],
  sees: ["def sees(codes, code):", "    return any(abs(each - code) < 0.001 for each in codes)"],
  direction: [
    "def direction(codes, code, angles):",
    "    # degrees, to the right above 0; 0 if it is not seen",
    "    hits = [angle for each, angle in zip(codes, angles) if abs(each - code) < 0.001]",
    "    return sum(hits) / len(hits) if hits else 0",
  ],
};

/**
 * Return the blocks of an agent.
 * @param {Partial<PythonPart>} part
 * @returns {AgentBlocks}
 */
export function agentBlocks({ sensors = [], actuators = [] }) {
  const known = sensors.filter(({ class: type, kind }) => kind !== "text" && !LEFT_OUT.has(type));
  const outputs = outputsOf(actuators);
  return {
    senses: known.flatMap(senseBlocks),
    actions: outputs.flatMap(({ parts }) => parts.filter((part) => part.type).map(actionBlock)),
    touches: known.filter((sensor) => TOUCHES.has(sensor.class)),
    outputs,
  };
}

// -- senses ----------------------------------------------------------------------------------------

/**
 * @param {ProgramSensor} sensor
 * @returns {Sense[]}
 */
function senseBlocks(sensor) {
  const { key, shape, stack = 1, rays, slots = [] } = sensor;
  const reading = `percept[${JSON.stringify(key)}]${stack > 1 ? "[-1]" : ""}`;
  if (rays) return rayBlocks(sensor, reading);
  if (shape.length === (stack > 1 ? 1 : 0)) return [plainBlock(sensor, reading)];
  if (TOUCHES.has(sensor.class)) return [touchBlock(sensor, `${reading}[0]`)];
  if (sensor.class === EVENT) return [eventBlock(sensor, `${reading}[0]`)];
  return slots.length ? [slotBlock(sensor, reading)] : [statisticBlock(sensor, reading)];
}

/**
 * @param {ProgramSensor} sensor
 * @param {string} reading
 */
function plainBlock({ key, kind, unit }, reading) {
  const output = kind === "bool" ? "Boolean" : "Number";
  return sense(`sense:${key}`, `${key}${unit && ` (${unit})`}`, [], output, () => value(reading));
}

/**
 * @param {ProgramSensor} sensor
 * @param {string} reading
 */
function touchBlock({ key }, reading) {
  return sense(`sense:${key}`, t("{key} is touched", { key }), [], "Boolean", () => value(`${reading} > 0`, COMPARISON));
}

/**
 * @param {ProgramSensor} sensor
 * @param {string} reading
 */
function eventBlock({ key }, reading) {
  return sense(`sense:${key}`, t("{key} has just happened", { key }), [], "Boolean", () => value(`${reading} > 0`, COMPARISON));
}

/**
 * @param {ProgramSensor} sensor
 * @param {string} reading
 */
function slotBlock({ key, slots }, reading) {
  const words = (/** @type {ProgramSensor["slots"][number]} */ { name, unit }) => [name, unit && `(${unit})`].filter(Boolean).join(" ");
  const ranges = slots.map(({ name, low, high }) => [name, rangeWords(low, high)].filter(Boolean).join(": ")).join("; ");
  if (slots.length === 1) return sense(`sense:${key}`, `${key} ${words(slots[0])}`, [], "Number", () => value(`${reading}[0]`), ranges);
  const options = slots.map((slot, index) => [words(slot), String(index)]);
  return sense(`sense:${key}`, `${key} %1`, [list("SLOT", options)], "Number", ({ SLOT }) => value(`${reading}[${SLOT}]`), ranges);
}

/**
 * @param {ProgramSensor} sensor
 * @param {string} reading
 */
function statisticBlock({ key, unit }, reading) {
  const options = Object.entries(STATISTICS).map(([name, words]) => [words, name]);
  const message = t("%1 of {key}", { key: `${key}${unit && ` (${unit})`}` });
  return sense(`many:${key}`, message, [list("STAT", options)], "Number", ({ STAT }) => value(`${reading}.${STAT}()`));
}

/**
 * Return the blocks of a flat fan of rays: the nearest thing, whether a group is seen, and where.
 * @param {ProgramSensor} sensor
 * @param {string} reading
 */
function rayBlocks({ key, rays }, reading) {
  const angles = rays.angles_deg;
  const sectors = Object.keys(SECTORS).filter((name) => sideOf(name, angles).count);
  const sides = list("SIDE", sectors.map((name) => [SECTORS[name], name]));
  const groups = list("GROUP", rays.codes.map(([name]) => [name, name]));
  const codeOf = (/** @type {string} */ group) => number(rays.codes.find(([name]) => name === group)?.[1] ?? -1);
  const width = Number(rays.has_code) + Number(rays.has_distance);
  const part = (/** @type {string} */ name, /** @type {number} */ offset) => `${reading}${slice(sideOf(name, angles), width, offset, angles.length)}`;
  const made = [];
  if (rays.has_distance) {
    const factor = rays.reach === rays.reach_m ? "" : `${number(rays.reach_m)} * `;
    const near = (/** @type {string} */ side) => `${factor}nearest(${part(side, width - 1)}, ${number(rays.reach)})`;
    const python = (/** @type {SenseFields} */ { SIDE }) => value(near(SIDE), factor ? PRODUCT : ATOM, FUNCTIONS.nearest);
    made.push(sense(`near:${key}`, t("distance %1 (m)"), [sides], "Number", python, t("How far it is to what is nearest, up to {metres} m.", { metres: rays.reach_m })));
  }
  if (!rays.has_code || !rays.codes.length) return made;
  const sees = (/** @type {SenseFields} */ { GROUP, SIDE }) => value(`sees(${part(SIDE, 0)}, ${codeOf(GROUP)})`, ATOM, FUNCTIONS.sees);
  made.push(sense(`sees:${key}`, t("sees %1 %2"), [groups, sides], "Boolean", sees, t("True if a ray hits such a thing.")));
  const rightward = `[${angles.map((angle) => number(-angle || 0)).join(", ")}]`;
  const where = (/** @type {SenseFields} */ { GROUP }) => {
    const [codes, code] = [part("around", 0), codeOf(GROUP)];
    return value(`direction(${codes}, ${code}, ${rightward})`, ATOM, FUNCTIONS.direction);
  };
  made.push(sense(`angle:${key}`, t("direction of %1 (°)"), [groups], "Number", where, t("Above 0 to the right, below 0 to the left; 0 if it is straight ahead, or not seen.")));
  return made;
}

/**
 * Return the rays of a side: {first, count}; angles rise from the right to the left.
 * @param {string} name of the side
 * @param {RayLayout["angles_deg"]} angles
 */
export function sideOf(name, angles) {
  /** @type {Record<string, (angle: number) => boolean>} */
  const sides = {
    around: () => true,
    ahead: (angle) => Math.abs(angle) <= AHEAD_DEG,
    left: (angle) => angle > AHEAD_DEG,
    right: (angle) => angle < -AHEAD_DEG,
  };
  return { first: angles.findIndex(sides[name]), count: angles.filter(sides[name]).length };
}

/**
 * Return the Python that takes one number of each ray of a side.
 * @param {{first: number, count: number}} side
 * @param {number} width numbers of a ray
 * @param {number} offset of the number in them
 * @param {number} rays their count
 */
function slice({ first, count }, width, offset, rays) {
  const from = first * width + offset || "";
  const to = first + count === rays ? "" : (first + count) * width;
  if (width === 1) return from || to ? `[${from}:${to}]` : "";
  return `[${from}:${to}:${width}]`;
}

/**
 * @param {string} type
 * @param {string} message
 * @param {Field[]} fields
 * @param {string} output
 * @param {Sense["python"]} python
 */
function sense(type, message, fields, output, python, tooltip = "") {
  return { type, message, fields, output, python, tooltip };
}

/**
 * @param {string} name
 * @param {string[][]} options
 * @returns {Field}
 */
function list(name, options) {
  return { type: "field_dropdown", name, options };
}

/**
 * @param {string} code
 * @param {string[][]} functions
 * @returns {Value}
 */
function value(code, order = ATOM, ...functions) {
  return { code, order, functions };
}

// -- actions ---------------------------------------------------------------------------------------

/**
 * Return the actuators with their numbers: a number with effect has a type of block and a variable.
 * @param {ProgramActuator[]} actuators
 * @returns {Output[]}
 */
function outputsOf(actuators) {
  const taken = new Set(["percept", "nearest", "sees", "direction", "random"]);
  const isAlone = actuators.length === 1;
  return actuators.map(({ name, is_choice: isChoice, components }) => ({
    name,
    parts: components.map(({ name: own, low, high, has_effect: hasEffect }, index) => {
      const rest = number(Math.max(low, Math.min(high, 0)));
      if (!hasEffect) return { rest };
      const words = own.replaceAll("_", " ");
      const title = !words ? name : isAlone ? words : `${name}: ${words}`;
      return { type: `act:${name}:${index}`, title, low, high, isChoice, rest, variable: identifier(title, taken) };
    }),
  }));
}

/**
 * @param {Part} part
 * @returns {Action}
 */
function actionBlock({ type, title, low, high, variable }) {
  // of all actuators, a turn above 0 goes to the right
  const range = title.endsWith("turn") && low < 0 ? t("{low} left, {high} right", { low, high }) : t("{low} to {high}", { low, high });
  return {
    type,
    message: `${title} (${range}) %1`,
    fields: [{ type: "input_value", name: "VALUE", check: "Number" }],
    start: Math.max(low, Math.min(high, 1)),
    variable,
  };
}

/**
 * @param {number | null} low
 * @param {number | null} high
 */
function rangeWords(low, high) {
  return low === null || high === null ? "" : t("{low} to {high}", { low, high });
}

/** @param {number} value */
function number(value) {
  return String(Math.round(value * 1e6) / 1e6);
}
