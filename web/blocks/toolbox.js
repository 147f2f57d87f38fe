/** The blocks to choose from, in groups. */

import { KINDS } from "./kinds.js";

const shadow = (NUM) => ({ shadow: { type: "number", fields: { NUM } } });
/** Values that blocks of the toolbox hold already, by type and input. */
const HELD = {
  repeat: {},
  compare: { A: shadow(0), B: shadow(0) },
  arithmetic: { A: shadow(1), B: shadow(1) },
  of_two: { A: shadow(1), B: shadow(2) },
  absolute: { A: shadow(0) },
  random: { A: shadow(-1), B: shadow(1) },
};

/** Return the definitions of all blocks for Blockly. @param agent as agentBlocks() returns it */
export function definitions(agent) {
  const senses = agent.senses.map(({ type, message, fields, output, tooltip }) => ({
    type,
    message0: message,
    args0: fields,
    output,
    style: "senses",
    tooltip,
  }));
  const actions = agent.actions.map(({ type, message, fields }) => ({
    type,
    message0: message,
    args0: fields,
    previousStatement: null,
    nextStatement: null,
    inputsInline: true,
    style: "actions",
    tooltip: "Counts for this decision only; without it, the robot rests.",
  }));
  return [...KINDS, ...senses, ...actions, ...restOf(agent), ...touchOf(agent)];
}

/** Return the toolbox. */
export function toolbox(agent) {
  const rests = restOf(agent);
  const actions = agent.actions.map(({ type, start }) => block(type, { VALUE: shadow(start) }));
  const touches = touchOf(agent);
  const groups = [
    ["Events", "events", [...touches.map(({ type }) => block(type)), block("on_becomes"), block("on_begin")]],
    ["Actions", "actions", [...actions, ...rests.map(({ type }) => block(type))]],
    ["Senses", "senses", agent.senses.map(({ type }) => block(type))],
    ["Control", "control", ofStyle("control")],
    ["Numbers", "numbers", ofStyle("numbers")],
  ];
  const categories = groups.map(([name, style, contents]) => ({ kind: "category", name, categorystyle: style, contents }));
  const memory = { kind: "category", name: "Memory", categorystyle: "memory", custom: "AI4U_MEMORY" };
  return { kind: "categoryToolbox", contents: [...categories, memory] };
}

/** Return what stands in the group "Memory": it depends on the variables of the program. */
export function memoryBlocks(workspace) {
  const button = { kind: "button", text: "New variable", callbackkey: "AI4U_NEW_VARIABLE" };
  const print = block("print", { VALUE: shadow(0) });
  const variables = workspace.getVariableMap().getAllVariables();
  if (!variables.length) return [button, print];
  const field = (each) => ({ VAR: { id: each.getId(), name: each.getName() } });
  const latest = field(variables.at(-1));
  const changing = [
    { ...block("variables_set", { VALUE: shadow(0) }), fields: latest },
    { ...block("math_change", { DELTA: shadow(1) }), fields: latest },
  ];
  return [button, ...changing, ...variables.map((each) => ({ ...block("variables_get"), fields: field(each) })), print];
}

function ofStyle(style) {
  return KINDS.filter((kind) => kind.style === style).map(({ type }) => block(type, HELD[type]));
}

function block(type, inputs = {}) {
  return { kind: "block", type, inputs };
}

function restOf({ outputs }) {
  const isAny = outputs.some(({ parts }) => parts.some(({ type, isChoice }) => type && !isChoice));
  if (!isAny) return [];
  const tooltip = "Takes back what was set above it.";
  return [{ type: "rest", message0: "stand still", previousStatement: null, nextStatement: null, style: "actions", tooltip }];
}

function touchOf({ touches }) {
  if (!touches.length) return [];
  const options = touches.map(({ key }) => [key, key]);
  const args0 = [{ type: "field_dropdown", name: "KEY", options }];
  const tooltip = "Once, at the decision at which the touch begins.";
  return [{ type: "on_touch", message0: "as soon as %1 is touched", args0, nextStatement: null, style: "events", tooltip }];
}
