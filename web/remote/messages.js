/**
 * Messages of the protocol between a world and what drives one of its agents: see ai4u_edu/wire/native.py.
 * A frame is one msgpack array: the kind of message, then its fields.
 */

/** @typedef {Record<string, string[]>} Fields what is told besides an action, numbers as text, by name */
/** @import { Message, PerceptMessage, Reading, Value } from "../types/remote.js" */

import { decode, Encoder } from "../vendor/msgpack.js?v=269ec7b2";
import { t } from "../shared/text.js";

export const VERSION = 1;
export const SUBPROTOCOL = `ai4u-edu-remote.v${VERSION}`;
/** Errors that close the connection, by the WebSocket's close code. */
export const PROBLEMS = new Map([
  [4000, "version"],
  [4001, "bad_token"],
  [4002, "unknown_agent"],
  [4003, "unknown_key"],
  [4004, "agent_taken"],
  [4005, "session_over"],
  [4006, "malformed"],
  [4007, "too_large"],
  [4008, "too_fast"],
  [4009, "taken_over"],
  [4010, "ended"],
  [4011, "lockstep_refused"],
]);

/** AI4U's type of a reading that is several texts, which are sent as one. */
const SEVERAL_TEXTS = "sstrings";
/** First byte of a msgpack array with up to 15 elements. */
const ARRAY = 0x90;
/** Fields of the messages from a world, in their order; those of native.py, in camel case. */
export const FIELDS = {
  welcome: [
    ...["version", "session", "grace", "agent", "mode", "title", "ticksPerSecond", "skipFrame", "repeatAction"],
    ...["maxSteps", "rewards", "success", "readings", "outputs", "fields"],
  ],
  percept: [
    ...["episode", "step", "seq", "tick", "reward", "terms", "terminated", "truncated", "paused", "stopped"],
    ...["data", "texts"],
  ],
  problem: ["code", "text", "seq"],
  bye: ["reason"],
};
export const READING = ["key", "kind", "sensorType", "dtype", "shape", "offset", "low", "high", "unit", "isInput"];
export const OUTPUT = ["name", "kind", "low", "high", "isOutput"];
/**
 * Bytes of a number, and the list of numbers in a buffer, by dtype.
 * @type {Record<"<f4" | "<i4" | "|u1" | "|b1", [number, (buffer: ArrayBuffer) => (number | boolean)[]]>}
 */
const NUMBERS = {
  "<f4": [4, (buffer) => Array.from(new Float32Array(buffer))],
  "<i4": [4, (buffer) => Array.from(new Int32Array(buffer))],
  "|u1": [1, (buffer) => Array.from(new Uint8Array(buffer))],
  "|b1": [1, (buffer) => Array.from(new Uint8Array(buffer), Boolean)],
};

const plain = new Encoder();
/** An action's numbers are floats, also 1 and -0. */
const floats = new Encoder({ forceIntegerToFloat: true });

/**
 * Return the frame of a message: its kind and fields.
 * @param {unknown[]} fields
 * @returns {Uint8Array<ArrayBuffer>}
 */
export function frameOf(...fields) {
  return plain.encode(fields);
}

/**
 * Return the frame of an action.
 * @param {{episode: number, step: number, seq: number}} percept that it answers
 * @param {Record<string, number[]>} values by actuator
 * @param {Fields} [told] what the page tells besides
 */
export function actionFrame({ episode, step, seq }, values, told = {}) {
  const head = ["action", episode, step, seq].map((each) => plain.encode(each));
  const rest = [floats.encode(values), ...(isEmpty(told) ? [] : [plain.encode(told)])];
  return joined([new Uint8Array([ARRAY + head.length + rest.length]), ...head, ...rest]);
}

/**
 * Return the frame of a reset.
 * @param {number} seq number of the percept that it answers
 * @param {number | null} seed
 * @param {Fields} [told] what the page tells besides
 */
export function resetFrame(seq, seed, told = {}) {
  return frameOf("reset", seq, seed, ...(isEmpty(told) ? [] : [told]));
}

/** @param {Fields} told */
function isEmpty(told) {
  return Object.keys(told).length === 0;
}

/**
 * Return the message in a frame, with its fields by name and its type.
 *
 * @param {Uint8Array} frame
 * @returns {Message}
 * @throws {Error} there is no message in it
 */
export function messageIn(frame) {
  const [type, ...fields] = decode(frame);
  if (!Object.hasOwn(FIELDS, type)) throw new Error(t("a message of an unknown type, {type}", { type: String(type).slice(0, 40) }));
  const message = { type, ...named(FIELDS[/** @type {keyof typeof FIELDS} */ (type)], fields) };
  if (type === "welcome") {
    message.readings = message.readings.map((/** @type {unknown[]} */ values) => readingOf(named(READING, values)));
    message.outputs = message.outputs.map((/** @type {unknown[]} */ values) => named(OUTPUT, values));
  }
  return message;
}

/**
 * Return a percept's readings by key: numbers, booleans, texts, and nested arrays of them.
 * @param {Reading[]} readings
 * @param {Pick<PerceptMessage, "data" | "texts">} percept
 * @returns {Record<string, Value>}
 */
export function valuesOf(readings, { data, texts }) {
  return Object.fromEntries(readings.map((reading) => [reading.key, valueOf(reading, data, texts)]));
}

/**
 * @param {Reading} reading
 * @param {Uint8Array<ArrayBuffer>} data
 * @param {string[]} texts
 * @returns {Value}
 */
function valueOf({ kind, sensorType, dtype, shape, offset }, data, texts) {
  if (kind === "text") return sensorType === SEVERAL_TEXTS ? JSON.parse(texts[offset]) : texts[offset];
  const count = shape.reduce((product, length) => product * length, 1);
  return nested(numbersIn(data, dtype, offset, count), shape);
}

/**
 * @param {Uint8Array<ArrayBuffer>} data
 * @param {keyof typeof NUMBERS} dtype
 * @param {number} offset
 * @param {number} count
 */
function numbersIn(data, dtype, offset, count) {
  const [size, list] = NUMBERS[dtype];
  const bytes = data.slice(offset, offset + count * size); // a copy, at an address that is a multiple of size
  if (bytes.length !== count * size) throw new Error(t("a percept that is shorter than the welcome says"));
  return list(bytes.buffer);
}

/**
 * @param {(number | boolean)[]} flat
 * @param {number[]} shape
 * @returns {Value}
 */
function nested(flat, shape) {
  if (shape.length === 0) return flat[0];
  if (shape.length === 1) return flat;
  const [count, ...rest] = shape;
  const size = flat.length / count;
  return Array.from({ length: count }, (_, row) => nested(flat.slice(row * size, (row + 1) * size), rest));
}

/**
 * Return a reading whose lowest and highest values are numbers: one for all entries, or one for each.
 * @param {Omit<Reading, "low" | "high"> & {low: Uint8Array<ArrayBuffer>, high: Uint8Array<ArrayBuffer>}} reading
 */
function readingOf(reading) {
  if (reading.kind === "text") return { ...reading, low: [], high: [] };
  const [size] = NUMBERS[reading.dtype];
  const numbers = (/** @type {Uint8Array<ArrayBuffer>} */ bytes) => numbersIn(bytes, reading.dtype, 0, bytes.length / size);
  return { ...reading, low: numbers(reading.low), high: numbers(reading.high) };
}

/**
 * @param {string[]} names
 * @param {unknown[]} fields
 * @returns {any} with what the world has sent
 */
function named(names, fields) {
  return Object.fromEntries(names.map((name, place) => [name, fields[place]]));
}

/** @param {Uint8Array[]} pieces */
function joined(pieces) {
  const all = new Uint8Array(pieces.reduce((length, piece) => length + piece.length, 0));
  let end = 0;
  for (const piece of pieces) {
    all.set(piece, end);
    end += piece.length;
  }
  return all;
}
