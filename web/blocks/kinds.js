/** The blocks that every agent has: events, control, logic, numbers and memory. */

import { t } from "../shared/text.js";

/**
 * @typedef {object} Field in the form of Blockly
 * @property {string} type
 * @property {string} name
 * @property {string | null} [check]
 * @property {string[][]} [options]
 * @property {string} [variable]
 * @property {number | string} [value]
 * @property {string} [text]
 * @property {number} [min]
 * @property {number} [max]
 * @property {number} [precision]
 */
/** @typedef {{type: string, message0: string, args0?: Field[], style: string, tooltip: string, [property: string]: unknown}} BlockKind */

/** @type {{previousStatement: null, nextStatement: null}} */
const STATEMENT = { previousStatement: null, nextStatement: null };
/** @type {(name: string, check: string | null) => Field} */
const value = (name, check) => ({ type: "input_value", name, check });
/** @type {(name: string) => Field} */
const body = (name) => ({ type: "input_statement", name });
/** @type {(name: string, options: string[][]) => Field} */
const list = (name, options) => ({ type: "field_dropdown", name, options });
const variable = { type: "field_variable", name: "VAR", variable: "count" };

/**
 * Blocks in the form of Blockly, but for the colors, which come from the style.
 * @type {BlockKind[]}
 */
export const KINDS = [
  hat("on_decision", t("forever"), [], t("Again and again, at each decision, what stands below decides what the robot does next.")),
  hat("on_begin", t("when an episode begins"), [], t("Once, before the first decision of each episode.")),
  hat("on_becomes", t("as soon as %1"), [value("IF", "Boolean")], t("Once, at the decision at which the condition becomes true.")),
  statement("if", "control", t("if %1 %2"), [value("IF", "Boolean"), body("DO")]),
  statement("if_else", "control", t("if %1 %2 else %3"), [value("IF", "Boolean"), body("DO"), body("ELSE")]),
  statement("repeat", "control", t("repeat %1 times %2"), [{ type: "field_number", name: "TIMES", value: 3, min: 0, max: 1000, precision: 1 }, body("DO")], t("All of it in one decision.")),
  output("compare", "numbers", "%1 %2 %3", "Boolean", [
    value("A", "Number"),
    list("OP", [["<", "LT"], ["≤", "LTE"], [">", "GT"], ["≥", "GTE"], ["=", "EQ"], ["≠", "NEQ"]]),
    value("B", "Number"),
  ]),
  output("and_or", "numbers", "%1 %2 %3", "Boolean", [value("A", "Boolean"), list("OP", [[t("and"), "and"], [t("or"), "or"]]), value("B", "Boolean")]),
  output("not", "numbers", t("not %1"), "Boolean", [value("A", "Boolean")]),
  output("true_false", "numbers", "%1", "Boolean", [list("BOOL", [[t("true"), "TRUE"], [t("false"), "FALSE"]])]),
  output("number", "numbers", "%1", "Number", [{ type: "field_number", name: "NUM", value: 0 }]),
  output("arithmetic", "numbers", "%1 %2 %3", "Number", [
    value("A", "Number"),
    list("OP", [["+", "ADD"], ["−", "MINUS"], ["×", "MULTIPLY"], ["÷", "DIVIDE"]]),
    value("B", "Number"),
  ]),
  output("of_two", "numbers", t("%1 of %2 and %3"), "Number", [list("OP", [[t("smaller"), "min"], [t("larger"), "max"]]), value("A", "Number"), value("B", "Number")]),
  output("absolute", "numbers", t("size of %1"), "Number", [value("A", "Number")], t("Without the sign: 3 for -3.")),
  output("random", "numbers", t("any number from %1 to %2"), "Number", [value("A", "Number"), value("B", "Number")]),
  output("variables_get", "memory", "%1", null, [variable]),
  statement("variables_set", "memory", t("set %1 to %2"), [variable, value("VALUE", null)], t("It stays until the episode ends.")),
  statement("math_change", "memory", t("change %1 by %2"), [variable, value("DELTA", "Number")]),
  statement("print", "memory", t("show %1 %2"), [{ type: "field_input", name: "TEXT", text: t("value") }, value("VALUE", null)], t("Writes it into Output, at each decision.")),
];

const ORDINARY = new Set(KINDS.map(({ type }) => type));

/**
 * Return {isOwn}: true for a type of block that is made of an agent's senses or actions.
 * @param {string} type
 */
export function blockOf(type) {
  return { isOwn: !ORDINARY.has(type) };
}

/**
 * @param {string} type
 * @param {string} message0
 * @param {Field[]} args0
 * @param {string} tooltip
 * @returns {BlockKind}
 */
function hat(type, message0, args0, tooltip) {
  return { type, message0, args0, nextStatement: null, style: "events", tooltip };
}

/**
 * @param {string} type
 * @param {string} style
 * @param {string} message0
 * @param {Field[]} args0
 */
function statement(type, style, message0, args0, tooltip = "") {
  return { type, message0, args0, ...STATEMENT, inputsInline: true, style, tooltip };
}

/**
 * @param {string} type
 * @param {string} style
 * @param {string} message0
 * @param {string | null} outputType
 * @param {Field[]} args0
 */
function output(type, style, message0, outputType, args0, tooltip = "") {
  return { type, message0, args0, output: outputType, inputsInline: true, style, tooltip };
}
