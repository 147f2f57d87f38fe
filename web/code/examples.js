/** Example programs, of blocks and as the Python that they mean. Each is for one scene of the library, where it has been tried. */

/** @import { PythonPart, ScenePart } from "../generated/messages.js" */
/** @import { Block, Program } from "../blocks/text.js" */

import { section, tile, tiles } from "../panel/widgets/parts.js";
import { t } from "../shared/text.js";

/**
 * @typedef {object} Example
 * @property {string} name
 * @property {string} title
 * @property {string} text
 * @property {string} scene
 * @property {string} sceneTitle
 * @property {string} way path data of the robot's way in its picture, 96 x 60
 * @property {string} things path data of the walls or the line in it
 * @property {() => Program} blocks
 */

const SVG = "http://www.w3.org/2000/svg";
const COUNT = { id: "ai4u-count", name: "count" };
const SIDE = { id: "ai4u-side", name: "side" };

/** @type {Example[]} */
export const EXAMPLES = [
  {
    name: "square",
    title: t("Drive a square"),
    text: t("It counts its decisions: some to drive, some to turn, and again."),
    scene: "forage",
    sceneTitle: t("Forage"),
    way: "M30 48V14h34v34H38",
    things: "",
    blocks: () =>
      program(
        [COUNT],
        [
          block("math_change", { VAR: { id: COUNT.id } }, { DELTA: number(1) }),
          either(compare(recalled(COUNT), "LT", number(20)), act(0, number(0.5)), act(1, number(0.48))),
          when(compare(recalled(COUNT), "GT", number(31)), stored(COUNT, number(0))),
        ],
      ),
  },
  {
    name: "follow",
    title: t("Follow the line"),
    text: t("If the line is on the left, the right wheel drives faster; on the right, the left one."),
    scene: "line_follow",
    sceneTitle: t("Line follower"),
    way: "M12 44c16 0 18-28 36-28",
    things: "M12 44c16 0 18-28 36-28s20 26 36 26",
    blocks: () =>
      program(
        [],
        [
          act(0, number(0.4)),
          act(1, number(0.4)),
          when(compare(line(1), "GT", line(3)), act(0, number(0))),
          when(compare(line(3), "GT", line(1)), act(1, number(0))),
        ],
      ),
  },
  {
    name: "avoid",
    title: t("Avoid walls"),
    text: t("It drives while there is room ahead. At a wall, it turns."),
    scene: "maze",
    sceneTitle: t("Maze"),
    way: "M16 46h40V18h22",
    things: "M66 28v28M50 8h38",
    blocks: () => program([], [either(compare(near("ahead"), "LT", number(0.8)), act(1, number(0.5)), act(0, number(0.5)))]),
  },
  {
    name: "wall",
    title: t("Follow a wall"),
    text: t("It keeps 0.8 m away from the wall on its right, like a hand on the wall."),
    scene: "maze",
    sceneTitle: t("Maze"),
    way: "M14 16h46v30h24",
    things: "M14 28h34v30h40M72 8v26h16",
    blocks: () =>
      program(
        [],
        [
          either(
            compare(near("ahead"), "LT", number(0.9)),
            act(1, number(-0.8)),
            act(0, number(0.5), act(1, block("arithmetic", { OP: "MINUS" }, { A: near("right"), B: number(0.8) }))),
          ),
        ],
      ),
  },
  {
    name: "memory",
    title: t("Remember a side"),
    text: t("At each wall it turns to the other side than the time before: it remembers the side in a variable."),
    scene: "maze",
    sceneTitle: t("Maze"),
    way: "M12 48h22V30h22V12h26",
    things: "M44 38v18M24 20h22M66 22v16M72 6h18",
    blocks: () =>
      program(
        [SIDE],
        [
          either(compare(near("ahead"), "LT", number(0.8)), act(1, recalled(SIDE)), act(0, number(0.5))),
        ],
        stack("on_begin", [stored(SIDE, number(0.5))], 200),
        stack("on_becomes", [stored(SIDE, block("arithmetic", { OP: "MULTIPLY" }, { A: recalled(SIDE), B: number(-1) }))], 320, {
          IF: compare(near("ahead"), "GT", number(1.2)),
        }),
      ),
  },
];

/** The examples to choose from, with pictures. */
export class ExampleList {
  #tiles = tiles();
  element = section("code-examples", t("Examples"), {}, this.#tiles);
  #onChoose;
  #shown = "";

  /** @param {(example: Example) => void} onChoose called with the one that is clicked */
  constructor(onChoose) {
    this.#onChoose = onChoose;
    this.#tiles.classList.add("ai4u-code-examples");
  }

  /** @param {ScenePart | null} part null before it is known */
  update(part) {
    if (part === null) return;
    const { scene, can_edit: canOpen } = part;
    const shown = `${scene} ${canOpen}`;
    if (shown === this.#shown) return; // else the focus would be lost
    this.#shown = shown;
    this.#tiles.replaceChildren(...EXAMPLES.map((example) => this.#tile(example, example.scene === scene, canOpen)));
  }

  /**
   * @param {Example} example
   * @param {boolean} isHere true if its scene is open
   * @param {boolean} canOpen true if the person may open another one
   */
  #tile(example, isHere, canOpen) {
    const { title, text, sceneTitle } = example;
    const note = !isHere && canOpen ? t("Opens {scene}", { scene: sceneTitle }) : "";
    const reason = !isHere && !canOpen ? t("Only in the scene {scene}", { scene: sceneTitle }) : "";
    const made = tile({ title, text, note, reason }, () => this.#onChoose(example));
    made.prepend(picture(example));
    return made;
  }
}

/**
 * Return the program of an example; null if the robot lacks what it uses.
 * @param {Example} example
 * @param {PythonPart} part of the robot
 * @returns {Promise<{python: string, blocks: Program} | null>}
 */
export async function exampleProgram(example, part) {
  const [{ agentBlocks }, { pythonOf }] = await Promise.all([import("../blocks/agent.js"), import("../blocks/python.js")]);
  const agent = agentBlocks(part);
  const known = new Set([...agent.senses, ...agent.actions].map(({ type }) => type));
  const blocks = example.blocks();
  const used = [...JSON.stringify(blocks).matchAll(/"type":"(\w+:[^"]*)"/g)].map(([, type]) => type);
  return used.every((type) => known.has(type)) ? { python: pythonOf(blocks, agent).text, blocks } : null;
}

/** @param {Example} example */
function picture({ way, things }) {
  const svg = document.createElementNS(SVG, "svg");
  for (const [name, value] of Object.entries({ viewBox: "0 0 96 60", "aria-hidden": "true" })) svg.setAttribute(name, value);
  const [x, y] = /^M(\d+) (\d+)/.exec(way).slice(1);
  const robot = `M${Number(x) - 5} ${y}a5 5 0 1 0 10 0a5 5 0 1 0 -10 0`;
  for (const [name, data] of Object.entries({ things, way, robot })) {
    const path = document.createElementNS(SVG, "path");
    path.setAttribute("class", name);
    path.setAttribute("d", data);
    svg.append(path);
  }
  return svg;
}

/**
 * @param {{id: string, name: string}[]} variables
 * @param {Block[]} main blocks of each decision
 * @param {Block[]} others other stacks
 * @returns {Program}
 */
function program(variables, main, ...others) {
  const state = { blocks: { languageVersion: 0, blocks: [{ ...stack("on_decision", main, 16), deletable: false }, ...others] } };
  return variables.length ? { ...state, variables } : state;
}

/**
 * @param {string} type of the hat
 * @param {Block[]} blocks
 * @param {number} y
 * @param {Record<string, Block>} [inputs]
 * @returns {Block}
 */
function stack(type, blocks, y, inputs = {}) {
  return { ...block(type, {}, inputs), x: 16, y, next: { block: chained(blocks) } };
}

/**
 * Return the first of some blocks, with the others below it.
 * @param {Block[]} blocks
 */
function chained(blocks) {
  return blocks.reduceRight((below, above) => ({ ...above, next: { block: below } }));
}

/**
 * @param {string} type
 * @param {Block["fields"]} [fields]
 * @param {Record<string, Block>} [inputs]
 * @returns {Block}
 */
function block(type, fields = {}, inputs = {}) {
  const entries = Object.entries(inputs).map(([name, inner]) => [name, { block: inner }]);
  return { type, fields, inputs: Object.fromEntries(entries) };
}

/** @param {number} value */
function number(value) {
  return block("number", { NUM: value });
}

/**
 * @param {number} index of the actuator's number
 * @param {Block} value
 * @param {Block[]} next
 */
function act(index, value, ...next) {
  return chained([block(`act:move:${index}`, {}, { VALUE: value }), ...next]);
}

/** @param {string} side */
function near(side) {
  return block("near:vision", { SIDE: side });
}

/** @param {number} slot of the line sensor, from the left */
function line(slot) {
  return block("sense:line", { SLOT: String(slot) });
}

/**
 * @param {Block} left
 * @param {string} operator
 * @param {Block} right
 */
function compare(left, operator, right) {
  return block("compare", { OP: operator }, { A: left, B: right });
}

/**
 * @param {Block} condition
 * @param {Block} yes
 * @param {Block} no
 */
function either(condition, yes, no) {
  return block("if_else", {}, { IF: condition, DO: yes, ELSE: no });
}

/**
 * @param {Block} condition
 * @param {Block} yes
 */
function when(condition, yes) {
  return block("if", {}, { IF: condition, DO: yes });
}

/** @param {{id: string}} variable */
function recalled({ id }) {
  return block("variables_get", { VAR: { id } });
}

/**
 * @param {{id: string}} variable
 * @param {Block} value
 */
function stored({ id }, value) {
  return block("variables_set", { VAR: { id } }, { VALUE: value });
}
