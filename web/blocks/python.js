/** The Python that a program of blocks means. It reads the blocks as they are kept, so it needs no editor. */

/** @import { AgentBlocks, Output } from "./agent.js" */
/** @import { Block, Program } from "./text.js" */

import { blockOf } from "./kinds.js";
import { AND, ANY, ATOM, COMPARISON, identifier, NOT, OR, PRODUCT, SIGN, SUM } from "./words.js";

/** @typedef {{text: string, block: string}} Row a line, and the id of its block; empty if there is none */
/** @typedef {{code: string, order: number}} Code and how tightly it binds */

/** @type {Record<string, [string, number]>} */
const OPERATORS = { ADD: ["+", SUM], MINUS: ["-", SUM], MULTIPLY: ["*", PRODUCT], DIVIDE: ["/", PRODUCT] };
/** @type {Record<string, string>} */
const COMPARISONS = { LT: "<", LTE: "<=", GT: ">", GTE: ">=", EQ: "==", NEQ: "!=" };
const INDENT = "    ";

/**
 * Return the Python of blocks.
 * @param {Program} state as Blockly.serialization.workspaces.save() returns it
 * @param {AgentBlocks} agent
 * @returns {{text: string, blocks: string[]}} the id of the block by line, from line 1; empty where there is none
 */
export function pythonOf(state, agent) {
  return new Writer(state, agent).program();
}

class Writer {
  #agent;
  #stacks;
  #events;
  /** Names of the program's own variables by the block editor's id. */
  #names;
  /**
   * Ids of variables that the program uses.
   * @type {Set<string>}
   */
  #used = new Set();
  /** @type {Set<string[]>} */
  #functions = new Set();
  #needsRandom = false;

  /**
   * @param {Program} state
   * @param {AgentBlocks} agent
   */
  constructor(state, agent) {
    this.#agent = agent;
    this.#stacks = state.blocks?.blocks ?? [];
    this.#events = this.#stacks.filter(({ type }) => type === "on_becomes" || type === "on_touch");
    const taken = new Set(["reset", "get_action", "begins", ...this.#events.map((_, index) => `was_${index + 1}`)]);
    this.#names = new Map((state.variables ?? []).map(({ id, name }) => [id, identifier(name, taken)]));
  }

  program() {
    const begin = this.#stackOf("on_begin");
    const main = this.#stacks.find(({ type }) => type === "on_decision");
    const isEarly = begin !== null && this.#isOwn(begin); // it senses or acts: that takes a decision
    const beginLines = begin === null ? [] : this.#statements(begin);
    const mainLines = this.#statements(main?.next?.block);
    const eventLines = this.#events.flatMap((event, index) => this.#event(event, index + 1));
    const resets = this.#resets(isEarly, beginLines, this.#events.length);
    const isClass = resets.length > 0;
    const decision = [
      ...this.#rests(main?.id),
      ...(isEarly ? [row("if self.begins:"), row(`${INDENT}self.begins = False`), ...indented(beginLines)] : []),
      ...mainLines,
      ...eventLines,
      row(`return {${this.#agent.outputs.map(outputCode).join(", ")}}`, main?.id),
    ];
    const head = row(isClass ? "def get_action(self, percept):" : "def decide(percept):", main?.id);
    const body = [head, ...indented(decision)];
    const rows = [...this.#imports(), ...(isClass ? classRows(resets, body) : body), ...this.#helpers()];
    return { text: `${rows.map(({ text }) => text).join("\n")}\n`, blocks: rows.map(({ block }) => block) };
  }

  /**
   * Return the first block under a hat; null if there is none.
   * @param {string} type
   */
  #stackOf(type) {
    return this.#stacks.find((each) => each.type === type)?.next?.block ?? null;
  }

  /**
   * Return true if some block of a stack senses or acts.
   * @param {Block | undefined} block
   * @returns {boolean}
   */
  #isOwn(block) {
    if (!block) return false;
    if (blockOf(block.type).isOwn) return true;
    const inputs = Object.values(block.inputs ?? {}).map((input) => input.block);
    return [...inputs, block.next?.block].some((each) => this.#isOwn(each));
  }

  /**
   * @param {boolean} isEarly
   * @param {Row[]} beginLines
   * @param {number} eventCount
   */
  #resets(isEarly, beginLines, eventCount) {
    const memory = [...this.#names].filter(([id]) => this.#used.has(id)).map(([, name]) => row(`self.${name} = 0`));
    const begins = isEarly ? [row("self.begins = True")] : [];
    const was = Array.from({ length: eventCount }, (_, index) => row(`self.was_${index + 1} = False`));
    return [...memory, ...was, ...begins, ...(isEarly ? [] : beginLines)];
  }

  #imports() {
    return this.#needsRandom ? [row("import random"), row(""), row("")] : [];
  }

  /** Return the functions that the blocks need; they stand below the program, which is read first. */
  #helpers() {
    return [...this.#functions].flatMap((lines) => ["", "", ...lines]).map((text) => row(text));
  }

  /**
   * Return the line that sets all actions to rest.
   * @param {string} block its id
   */
  #rests(block) {
    const parts = this.#agent.outputs.flatMap(({ parts }) => parts).filter(({ variable }) => variable);
    const values = [...new Set(parts.map(({ rest }) => rest))];
    return values.map((value) => {
      const names = parts.filter(({ rest }) => rest === value).map(({ variable }) => variable);
      return row(`${names.join(" = ")} = ${value}`, block);
    });
  }

  /**
   * @param {Block} block
   * @param {number} number
   */
  #event(block, number) {
    const isTouch = block.type === "on_touch";
    const condition = isTouch ? `percept[${JSON.stringify(block.fields.KEY)}][0] > 0` : this.#input(block, "IF", ANY, "False");
    return [
      row(`is_${number} = ${condition}`, block.id),
      row(`if is_${number} and not self.was_${number}:`, block.id),
      ...this.#body(block.next?.block),
      row(`self.was_${number} = is_${number}`, block.id),
    ];
  }

  // -- statements --------------------------------------------------------------------------------

  /**
   * @param {Block | undefined} first of a stack
   * @returns {Row[]}
   */
  #statements(first) {
    const rows = [];
    for (let block = first; block; block = block.next?.block) rows.push(...this.#statement(block));
    return rows;
  }

  /**
   * Return the lines of a branch, one step to the right.
   * @param {Block | undefined} block
   */
  #body(block) {
    const rows = this.#statements(block);
    return indented(rows.length ? rows : [row("pass")]);
  }

  /**
   * @param {Block} block
   * @returns {Row[]}
   */
  #statement(block) {
    const { type, id, fields = {} } = block;
    const one = (/** @type {string} */ text) => [row(text, id)];
    if (type === "if" || type === "if_else") return this.#if(block, "if");
    if (type === "repeat") {
      return [row(`for _ in range(${Math.round(fields.TIMES)}):`, id), ...this.#body(block.inputs?.DO?.block)];
    }
    if (type === "rest") return this.#rests(id);
    if (type === "print") return one(`print(${JSON.stringify(fields.TEXT ?? "")}, ${this.#input(block, "VALUE", ANY, "0")})`);
    if (type === "variables_set") return one(`${this.#variable(fields)} = ${this.#input(block, "VALUE", ANY, "0")}`);
    if (type === "math_change") {
      const name = this.#variable(fields);
      return one(`${name} = ${name} + ${this.#input(block, "DELTA", PRODUCT, "0")}`);
    }
    const action = this.#agent.actions.find((each) => each.type === type);
    if (action) return one(`${action.variable} = ${this.#input(block, "VALUE", ANY, "0")}`);
    return one(`pass  # this robot has no ${type.replace(/^act:/, "").replaceAll("\n", " ")}`);
  }

  /**
   * @param {Block} block
   * @param {string} word
   * @returns {Row[]}
   */
  #if(block, word) {
    const head = row(`${word} ${this.#input(block, "IF", ANY, "False")}:`, block.id);
    const rows = [head, ...this.#body(block.inputs?.DO?.block)];
    if (block.type === "if") return rows;
    const other = block.inputs?.ELSE?.block;
    if (other && !other.next && /^if(_else)?$/.test(other.type)) return [...rows, ...this.#if(other, "elif")];
    return [...rows, row("else:", block.id), ...this.#body(other)];
  }

  // -- values ------------------------------------------------------------------------------------

  /**
   * Return the code of a value that goes into another one which binds with `order`.
   * @param {Block} block
   * @param {string} name of the input
   * @param {number} order
   * @param {string} fallback if it is empty
   */
  #input(block, name, order, fallback) {
    const input = block.inputs?.[name];
    const inner = input?.block ?? input?.shadow;
    if (!inner) return fallback;
    const { code, order: own } = this.#value(inner);
    return own > order ? `(${code})` : code;
  }

  /**
   * @param {Block} block
   * @returns {Code}
   */
  #value(block) {
    const { type, fields = {} } = block;
    const two = (/** @type {string} */ sign, /** @type {number} */ order, right = order - 1, left = order) => ({
      code: `${this.#input(block, "A", left, "0")} ${sign} ${this.#input(block, "B", right, "0")}`,
      order,
    });
    switch (type) {
      case "number": return { code: String(fields.NUM), order: fields.NUM < 0 ? SIGN : ATOM };
      case "true_false": return { code: fields.BOOL === "TRUE" ? "True" : "False", order: ATOM };
      case "compare": return two(COMPARISONS[fields.OP], COMPARISON, SUM, SUM);
      case "and_or": return this.#logic(block, fields.OP);
      case "not": return { code: `not ${this.#input(block, "A", NOT, "False")}`, order: NOT };
      case "arithmetic": return two(...OPERATORS[fields.OP]);
      case "of_two": return { code: `${fields.OP}(${this.#input(block, "A", ANY, "0")}, ${this.#input(block, "B", ANY, "0")})`, order: ATOM };
      case "absolute": return { code: `abs(${this.#input(block, "A", ANY, "0")})`, order: ATOM };
      case "random": return this.#random(block);
      case "variables_get": return { code: this.#variable(fields), order: ATOM };
      default: return this.#sense(type, fields);
    }
  }

  /**
   * @param {Block} block
   * @param {string} operator
   */
  #logic(block, operator) {
    const order = operator === "and" ? AND : OR;
    return { code: `${this.#input(block, "A", order, "False")} ${operator} ${this.#input(block, "B", order, "False")}`, order };
  }

  /** @param {Block} block */
  #random(block) {
    this.#needsRandom = true;
    return { code: `random.uniform(${this.#input(block, "A", ANY, "0")}, ${this.#input(block, "B", ANY, "1")})`, order: ATOM };
  }

  /**
   * @param {string} type
   * @param {Block["fields"]} fields
   */
  #sense(type, fields) {
    const known = this.#agent.senses.find((each) => each.type === type);
    if (!known) return { code: `percept[${JSON.stringify(type.replace(/^\w+:/, ""))}][0]`, order: ATOM }; // Run tells what is wrong
    const { code, order, functions } = known.python(fields);
    for (const each of functions) this.#functions.add(each);
    return { code, order };
  }

  /** @param {Block["fields"]} fields */
  #variable({ VAR }) {
    this.#used.add(VAR.id);
    return `self.${this.#names.get(VAR.id) ?? "x"}`;
  }
}

/**
 * @param {string} text
 * @returns {Row}
 */
function row(text, block = "") {
  return { text, block };
}

/** @param {Row[]} rows */
function indented(rows) {
  return rows.map(({ text, block }) => row(text && INDENT + text, block));
}

/**
 * @param {Row[]} resets
 * @param {Row[]} body
 */
function classRows(resets, body) {
  const reset = [row("def reset(self):"), ...indented(resets)];
  return [row("class Program:"), ...indented([...reset, row(""), ...body])];
}

/** @param {Output} output */
function outputCode({ name, parts }) {
  return `${JSON.stringify(name)}: [${parts.map(({ variable, rest }) => variable ?? rest).join(", ")}]`;
}
