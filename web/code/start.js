/** The program that a person begins with, made of what the agent senses and can do. */

/** @import { ActionRange, ProgramActuator, SensorReading } from "../generated/messages.js" */

/**
 * @typedef {object} Names words in a line, values to begin with
 * @property {{key: string, words: string}[]} readings
 * @property {{name: string, words: string, values: number[]}[]} outputs
 */

/** Most numbers that are named one by one. */
const MAX_NAMED = 6;
/** Turn of the first program, from -1 to 1. */
const TURN = 0.3;

/**
 * Return the names that the program of an agent reads and writes.
 * @param {SensorReading[]} sensors
 * @param {ProgramActuator[]} actuators
 * @returns {Names}
 */
export function namesOf(sensors, actuators) {
  return {
    readings: sensors.map((sensor) => ({ key: sensor.key, words: readingWords(sensor) })),
    outputs: actuators.map(({ name, is_choice: isChoice, components }) => ({
      name,
      words: components.map((component) => componentWords(component, isChoice)).join(", "),
      values: components.map((component) => startValue(component, isChoice)),
    })),
  };
}

/**
 * Return the program that a person begins with: it turns on the spot.
 * @param {Names} names
 */
export function startProgram({ readings, outputs }) {
  const sensed = readings.map(({ key, words }) => `# percept["${key}"]: ${words}`);
  const done = outputs.map(({ name, words }) => `# "${name}": ${words}`);
  const values = outputs.map((output) => `"${output.name}": [${output.values.join(", ")}]`);
  const lines = ["# It senses:", ...sensed, "# It can do:", ...done, "", "def decide(percept):"];
  return [...lines, `    return {${values.join(", ")}}`, ""].join("\n");
}

/**
 * @param {ActionRange} range
 * @param {boolean} isChoice
 */
function componentWords({ name, low, high, has_effect: hasEffect }, isChoice) {
  const words = name ? name.replaceAll("_", " ") : isChoice ? "choice" : "number";
  return `${words} ${hasEffect ? `${low} to ${high}` : "(no effect)"}`;
}

/**
 * @param {ActionRange} range
 * @param {boolean} isChoice
 */
function startValue({ name, low, high, has_effect: hasEffect }, isChoice) {
  const isTurn = hasEffect && !isChoice && /turn|steer/.test(name);
  return Math.max(low, Math.min(high, isTurn ? TURN : 0));
}

/** @param {SensorReading} sensor */
function readingWords({ values, shape = [], stack = 1, text, help, title }) {
  const isNamed = values?.length <= MAX_NAMED && values.some(({ name }) => !/^\d+$/.test(name));
  if (isNamed) return values.map(({ name }) => name.replaceAll("_", " ")).join(", ");
  if (text !== undefined && shape.length === 0) return lowered(help || title);
  const size = shape.join(" x ") || "1";
  return `${lowered(title)}, ${size} ${size === "1" ? "number" : "numbers"}${stack > 1 ? ` (${stack} moments)` : ""}`;
}

/** @param {string} words */
function lowered(words) {
  return (words.charAt(0).toLowerCase() + words.slice(1)).replace(/\.$/, "");
}
