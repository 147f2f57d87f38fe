/** The program that a person begins with, made of what the agent senses and can do. */

/** Most numbers that are named one by one. */
const MAX_NAMED = 6;

/**
 * Return what the code of an agent reads and writes.
 * @param agent the part "agent"
 * @returns {{readings: {key, words}[], outputs: {name, parts: {name, low, high, isChoice}[]}[]}}
 */
export function namesOf(agent) {
  const readings = (agent?.sensors ?? []).map((sensor) => ({ key: sensor.key, words: readingWords(sensor) }));
  const outputs = new Map();
  for (const { actuator, name, low, high, is_choice: isChoice = false } of agent?.action ?? []) {
    if (!outputs.has(actuator)) outputs.set(actuator, { name: actuator, parts: [] });
    outputs.get(actuator).parts.push({ name, low, high, isChoice });
  }
  return { readings, outputs: [...outputs.values()] };
}

/** Return what the numbers of an actuator mean, in a line. */
export function outputWords({ parts }) {
  return parts.map((part) => `${partName(part)} ${part.low} to ${part.high}`).join(", ");
}

/** Return the program that a person begins with: it turns on the spot. */
export function startProgram(agent) {
  const { readings, outputs } = namesOf(agent);
  const sensed = readings.map(({ key, words }) => `# percept["${key}"]: ${words}`);
  const done = outputs.map(({ name, parts }) => `# "${name}": ${parts.map(partName).join(", ")}`);
  const values = outputs.map(({ name, parts }) => `"${name}": [${parts.map(startValue).join(", ")}]`);
  const lines = ["# It senses:", ...sensed, "# It can do:", ...done, "", "def decide(percept):"];
  return [...lines, `    return {${values.join(", ")}}`, ""].join("\n");
}

function startValue({ name, low, high, isChoice }) {
  if (isChoice) return Math.max(low, 0);
  return /turn|steer/.test(name ?? "") && high > 0 ? Math.min(0.3, high) : Math.max(low, Math.min(high, 0));
}

function readingWords({ values, shape = [], stack = 1, text, help, title }) {
  if (values?.length && values.length <= MAX_NAMED) return values.map(({ name }) => name.replaceAll("_", " ")).join(", ");
  if (text !== undefined && shape.length === 0) return lowered(help || title);
  const size = shape.join(" x ") || "1";
  return `${lowered(title)}, ${size} ${size === "1" ? "number" : "numbers"}${stack > 1 ? ` (${stack} moments)` : ""}`;
}

function partName({ name }) {
  return (name || "number").replaceAll("_", " ");
}

function lowered(words) {
  return (words.charAt(0).toLowerCase() + words.slice(1)).replace(/\.$/, "");
}
