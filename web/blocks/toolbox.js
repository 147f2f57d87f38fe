/** The blocks to choose from, in groups. */

/** @import { AgentBlocks } from "./agent.js" */
/** @import { BlockKind } from "./kinds.js" */

import { KINDS } from "./kinds.js";
import { t } from "../shared/text.js";

/** @typedef {{getId: () => string, getName: () => string}} Variable of Blockly */
/** @typedef {Record<string, {shadow: {type: string, fields: {NUM: number}}}>} Inputs */

const shadow = (/** @type {number} */ NUM) => ({ shadow: { type: "number", fields: { NUM } } });
/**
 * Values that blocks of the toolbox hold already, by type and input.
 * @type {Record<string, Inputs>}
 */
const HELD = {
  repeat: {},
  compare: { A: shadow(0), B: shadow(0) },
  arithmetic: { A: shadow(1), B: shadow(1) },
  of_two: { A: shadow(1), B: shadow(2) },
  absolute: { A: shadow(0) },
  random: { A: shadow(-1), B: shadow(1) },
};

/**
 * Return the definitions of all blocks for Blockly.
 * @param {AgentBlocks} agent
 * @returns {BlockKind[]}
 */
export function definitions(agent) {
  const senses = agent.senses.map(({ type, message, fields, output, tooltip }) => ({
    type,
    message0: message,
    args0: fields,
    output,
    style: "senses",
    tooltip,
  }));
  const actions = agent.actions.map(/** @returns {BlockKind} */ ({ type, message, fields }) => ({
    type,
    message0: message,
    args0: fields,
    previousStatement: null,
    nextStatement: null,
    inputsInline: true,
    style: "actions",
    tooltip: t("Counts for this decision only; without it, the robot rests."),
  }));
  return [...KINDS, ...senses, ...actions, ...restOf(agent), ...touchOf(agent)];
}

/**
 * Return the toolbox.
 * @param {AgentBlocks} agent
 */
export function toolbox(agent) {
  const rests = restOf(agent);
  const actions = agent.actions.map(({ type, start }) => block(type, { VALUE: shadow(start) }));
  const touches = touchOf(agent);
  const contents = [
    category(t("Events"), "events", [...touches.map(({ type }) => block(type)), block("on_becomes"), block("on_begin")]),
    category(t("Actions"), "actions", [...actions, ...rests.map(({ type }) => block(type))]),
    category(t("Senses"), "senses", agent.senses.map(({ type }) => block(type))),
    category(t("Control"), "control", ofStyle("control")),
    category(t("Numbers"), "numbers", ofStyle("numbers")),
    { kind: "category", name: t("Memory"), categorystyle: "memory", custom: "AI4U_MEMORY" },
  ];
  return { kind: "categoryToolbox", contents };
}

/**
 * Return what stands in the group "Memory": it depends on the variables of the program.
 * @param {{getVariableMap: () => {getAllVariables: () => Variable[]}}} workspace of Blockly
 */
export function memoryBlocks(workspace) {
  const button = { kind: "button", text: t("New variable"), callbackkey: "AI4U_NEW_VARIABLE" };
  const print = block("print", { VALUE: shadow(0) });
  const variables = workspace.getVariableMap().getAllVariables();
  if (!variables.length) return [button, print];
  const field = (/** @type {Variable} */ variable) => ({ VAR: { id: variable.getId(), name: variable.getName() } });
  const latest = field(variables.at(-1));
  const changing = [
    { ...block("variables_set", { VALUE: shadow(0) }), fields: latest },
    { ...block("math_change", { DELTA: shadow(1) }), fields: latest },
  ];
  return [button, ...changing, ...variables.map((variable) => ({ ...block("variables_get"), fields: field(variable) })), print];
}

/**
 * @param {string} name
 * @param {string} categorystyle
 * @param {object[]} contents
 */
function category(name, categorystyle, contents) {
  return { kind: "category", name, categorystyle, contents };
}

/** @param {string} style */
function ofStyle(style) {
  return KINDS.filter((kind) => kind.style === style).map(({ type }) => block(type, HELD[type]));
}

/**
 * @param {string} type
 * @param {Inputs} [inputs]
 */
function block(type, inputs = {}) {
  return { kind: "block", type, inputs };
}

/**
 * @param {AgentBlocks} agent
 * @returns {BlockKind[]}
 */
function restOf({ outputs }) {
  const isAny = outputs.some(({ parts }) => parts.some(({ type, isChoice }) => type && !isChoice));
  if (!isAny) return [];
  const tooltip = t("Takes back what was set above it.");
  return [{ type: "rest", message0: t("stand still"), previousStatement: null, nextStatement: null, style: "actions", tooltip }];
}

/**
 * @param {AgentBlocks} agent
 * @returns {BlockKind[]}
 */
function touchOf({ touches }) {
  if (!touches.length) return [];
  const options = touches.map(({ key }) => [key, key]);
  const args0 = [{ type: "field_dropdown", name: "KEY", options }];
  const tooltip = t("Once, at the decision at which the touch begins.");
  return [{ type: "on_touch", message0: t("as soon as %1 is touched"), args0, nextStatement: null, style: "events", tooltip }];
}
