/** The program that a person begins with, made of what the agent senses and can do. */

/** @import { ActionRange, ProgramActuator, SensorReading } from "../generated/messages.js" */

import { identifier } from "../blocks/words.js";
import { t, tn } from "../shared/text.js";

/**
 * @typedef {object} Names words in a line, values to begin with
 * @property {{key: string, words: string}[]} readings
 * @property {{name: string, words: string, values: StartValue[]}[]} outputs
 */
/** @typedef {{name: string, value: number}} StartValue one without a name is written as a number */

/** Most numbers that are named one by one. */
const MAX_NAMED = 6;
/**
 * Numbers of the first program, from -1 to 1, by a word in their name: it drives in a circle, and does not jump.
 * @type {[RegExp, number][]}
 */
const CIRCLE = [[/jump/, 0], [/turn|steer|right/, 0.3], [/forward|throttle|speed|left/, 0.4]];

/**
 * Return the names that the program of an agent reads and writes.
 * @param {SensorReading[]} sensors
 * @param {ProgramActuator[]} actuators
 * @returns {Names}
 */
export function namesOf(sensors, actuators) {
  return {
    // while a program decides, no episode is over
    readings: sensors.filter((sensor) => sensor.class !== "DoneSensor").map((sensor) => ({ key: sensor.key, words: readingWords(sensor) })),
    outputs: actuators.map(({ name, is_choice: isChoice, components }) => ({
      name,
      words: components.map((component) => componentWords(component, isChoice)).join(", "),
      values: components.map((component) => ({ name: component.has_effect ? component.name : "", value: startValue(component, isChoice) })),
    })),
  };
}

/**
 * Return the program that a person begins with: it drives in a circle, and its numbers have names.
 * @param {Names} names
 */
export function startProgram({ outputs }) {
  const taken = new Set(["percept"]);
  /** @type {string[]} */
  const lines = [];
  const write = (/** @type {StartValue} */ { name, value }) => {
    if (!name || !value) return String(value);
    const variable = identifier(name, taken);
    lines.push(`    ${variable} = ${value}`);
    return variable;
  };
  const codes = outputs.map(({ name, values }) => `"${name}": [${values.map(write).join(", ")}]`);
  return ["def decide(percept):", ...lines, `    return {${codes.join(", ")}}`, ""].join("\n");
}

/**
 * @param {ActionRange} range
 * @param {boolean} isChoice
 */
function componentWords({ name, low, high, has_effect: hasEffect }, isChoice) {
  const words = name ? name.replaceAll("_", " ") : isChoice ? t("choice") : t("number");
  return hasEffect ? t("{name} {low} to {high}", { name: words, low, high }) : t("always 0");
}

/**
 * @param {ActionRange} range
 * @param {boolean} isChoice
 */
function startValue({ name, low, high, has_effect: hasEffect }, isChoice) {
  const share = isChoice ? 1 : (CIRCLE.find(([word]) => word.test(name))?.[1] ?? 0); // 0 is a choice to stay
  return Math.max(low, Math.min(high, hasEffect ? share : 0));
}

/** @param {SensorReading} sensor */
function readingWords({ values, shape = [], stack = 1, text, help, title }) {
  const isNamed = values?.length <= MAX_NAMED && values.some(({ name }) => !/^\d+$/.test(name));
  if (isNamed) return values.map(({ name }) => name.replaceAll("_", " ")).join(", ");
  if (text !== undefined && shape.length === 0) return lowered(help || title);
  const size = shape.join(" x ") || "1";
  const numbers = size === "1" ? t("1 number") : t("{size} numbers", { size });
  const what = `${lowered(title)}, ${numbers}`;
  return stack > 1 ? tn("{what}, now and {n} time before", "{what}, now and {n} times before", stack - 1, { what }) : what;
}

/** @param {string} words */
function lowered(words) {
  return (words.charAt(0).toLowerCase() + words.slice(1)).replace(/\.$/, "");
}
