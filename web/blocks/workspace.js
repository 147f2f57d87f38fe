/** The editor of blocks: Blockly with an agent's own blocks. Loaded when a person chooses blocks. */

/** @import { AgentBlocks } from "./agent.js" */
/** @import { Block, Program } from "./text.js" */

import { blocklyWords } from "./blockly_words.js";
import { blocksTheme } from "./theme.js";
import { definitions, memoryBlocks, toolbox } from "./toolbox.js";
import { setAttributes } from "../shared/dom.js";
import { t } from "../shared/text.js";
import { Blockly } from "../vendor/blockly.js?v=e631db10";

/** Place of a block that nobody has moved (pixels of the workspace). */
const FIRST_PLACE = { x: 16, y: 16 };
/** No address, so that Blockly asks for none of its pictures and sounds; nothing that is used here needs one. */
const NO_MEDIA = "data:,";
/** Blocks are shown larger where a finger has to hit them: scale at first, and the least of wide blocks. */
const [SCALES, TOUCH_SCALES] = [
  { first: 0.9, least: 0.6 },
  { first: 1, least: 0.7 },
];
/** Few steps, so that blocks seldom change their size. */
const SCALE_STEP = 0.1;
/** Room to the right of the blocks, for the scroll bar (px). */
const BAR_PX = 20;

/** Blocks of a person who has none yet. */
export const FIRST_BLOCKS = { blocks: { languageVersion: 0, blocks: [{ type: "on_decision", ...FIRST_PLACE, deletable: false }] } };

/** Have Blockly speak the page's language; before the first workspace. */
export async function setBlocklyLanguage() {
  Blockly.setLocale(await blocklyWords());
}

export class BlocksWorkspace {
  /** Called after each change by the person. */
  onChange = () => {};
  #workspace;
  #kept = "";
  /**
   * Ids of the blocks that ran in the latest decision.
   * @type {string[]}
   */
  #ran = [];
  #mistake = "";
  #scales = matchMedia("(pointer: coarse)").matches ? TOUCH_SCALES : SCALES;
  /** Scale that wide blocks were given; another one is the person's, and stays. */
  #fitted = this.#scales.first;

  /**
   * @param {HTMLElement} parent element that gets the editor
   * @param {object} options
   * @param {string} options.label accessible name
   * @param {AgentBlocks} options.agent
   * @param {(question: string, start: string) => Promise<string | null>} options.ask returns what the person answers to a
   *   question, or null
   */
  constructor(parent, { label, agent, ask }) {
    define(agent);
    /** @type {(question: string, start: string, answer: (text: string | null) => void) => Promise<void>} */
    const prompt = async (question, start, answer) => answer(await ask(question, start));
    Blockly.dialog.setPrompt(prompt);
    this.#workspace = Blockly.inject(parent, {
      toolbox: toolbox(agent),
      theme: Blockly.Theme.defineTheme("ai4u", blocksTheme()),
      renderer: "thrasos",
      media: NO_MEDIA,
      sounds: false,
      trashcan: false,
      comments: false,
      collapse: false,
      maxInstances: { on_decision: 1, on_begin: 1 },
      move: { scrollbars: true, drag: true, wheel: true },
      zoom: { startScale: this.#scales.first, minScale: 0.5, maxScale: 2, pinch: true },
    });
    // lists and fields hover over the page, outside of the panel
    /** @type {HTMLElement[]} */
    const floating = [Blockly.WidgetDiv.getDiv(), Blockly.DropDownDiv.getContentDiv().parentElement];
    for (const element of floating) {
      element.dataset.ai4uKeys = "";
      element.addEventListener("keydown", (event) => event.stopPropagation());
    }
    const memory = () => memoryBlocks(this.#workspace);
    this.#workspace.registerToolboxCategoryCallback("AI4U_MEMORY", memory);
    this.#workspace.registerButtonCallback("AI4U_NEW_VARIABLE", () => Blockly.Variables.createVariableButtonHandler(this.#workspace));
    this.#workspace.addChangeListener(Blockly.Events.disableOrphans);
    this.#workspace.addChangeListener((/** @type {{isUiEvent: boolean}} */ event) => this.#onEvent(event));
    const svg = parent.querySelector(".blocklySvg");
    if (svg) setAttributes(svg, { role: "group", "aria-label": label }); // its own role says that it has no name
    new ResizeObserver(() => parent.checkVisibility() && this.resize()).observe(parent);
    keepFocus(parent);
    // the panel scrolls, which Blockly does not notice
    addEventListener("scroll", ({ target }) => target instanceof Node && target.contains(parent) && this.#workspace.updateInverseScreenCTM(), { capture: true });
  }

  /**
   * The blocks with their ids, as blocks/python.js reads them.
   * @returns {Program}
   */
  get state() {
    return Blockly.serialization.workspaces.save(this.#workspace);
  }

  /** The blocks as they are kept: without ids, which differ from one start to the next. */
  get blocks() {
    return withoutIds(this.state);
  }

  /**
   * Show other blocks; it does not count as a change by the person.
   * @param {Program} blocks
   */
  load(blocks) {
    for (const type of typesIn(blocks)) if (!Blockly.Blocks[type]) Blockly.common.defineBlocksWithJsonArray([strangeBlock(type, blocks)]);
    Blockly.hideChaff();
    Blockly.serialization.workspaces.load(blocks, this.#workspace);
    if (!this.#workspace.getBlocksByType("on_decision").length) this.#addMain();
    this.#kept = JSON.stringify(this.blocks);
    this.#ran = [];
    this.#mistake = "";
    this.#fit();
  }

  /**
   * Offer another agent's blocks.
   * @param {AgentBlocks} agent
   */
  setAgent(agent) {
    define(agent);
    this.#workspace.updateToolbox(toolbox(agent));
  }

  /**
   * Mark the blocks that ran in the latest decision, and no others.
   * @param {string[]} ids
   */
  markRan(ids) {
    const wanted = new Set(ids);
    for (const id of this.#ran) if (!wanted.has(id)) this.#toggle(id, "ai4u-blocks-ran", false);
    for (const id of wanted) this.#toggle(id, "ai4u-blocks-ran", true);
    this.#ran = [...wanted];
  }

  /**
   * Mark the block of a mistake, and show it; empty removes the mark.
   * @param {string} id
   */
  markMistake(id) {
    this.#toggle(this.#mistake, "ai4u-blocks-mistake", false);
    this.#mistake = id;
    this.#toggle(id, "ai4u-blocks-mistake", true);
    if (id) this.#workspace.centerOnBlock(id);
  }

  /**
   * Put the focus onto a block.
   * @param {string} id
   */
  goTo(id) {
    const block = this.#workspace.getBlockById(id);
    if (block) Blockly.getFocusManager().focusNode(block);
  }

  /** Put the focus onto the block under which the decisions stand. */
  focus() {
    const [main] = this.#workspace.getBlocksByType("on_decision");
    Blockly.getFocusManager().focusNode(main);
  }

  resize() {
    Blockly.svgResize(this.#workspace);
    this.#fit();
  }

  /** Show blocks that are too wide for the editor smaller, and others in the usual size. */
  #fit() {
    const { scale } = this.#workspace;
    if (Math.abs(scale - this.#fitted) > 0.001) return;
    if (Blockly.WidgetDiv.isVisible() || Blockly.DropDownDiv.isVisible()) return; // a new scale would close it
    const { left, right } = this.#workspace.getBlocksBoundingBox();
    const view = this.#workspace.getMetricsManager().getViewMetrics();
    if (!view.width) return;
    const widest = (view.width - BAR_PX) / (right - Math.min(left, 0));
    const { first, least } = this.#scales;
    const fitting = Math.floor(widest / SCALE_STEP + 1e-6) * SCALE_STEP;
    this.#fitted = Math.max(least, Math.min(first, fitting));
    if (Math.abs(scale - this.#fitted) < 0.001) return;
    this.#workspace.setScale(this.#fitted);
    this.#workspace.scroll(Math.max(0, -left * this.#fitted), this.#workspace.scrollY);
  }

  /**
   * @param {string} id
   * @param {string} name of a class
   * @param {boolean} isOn
   */
  #toggle(id, name, isOn) {
    this.#workspace.getBlockById(id)?.getSvgRoot().classList.toggle(name, isOn);
  }

  #addMain() {
    const block = this.#workspace.newBlock("on_decision");
    block.setDeletable(false);
    block.initSvg();
    block.render();
    block.moveBy(FIRST_PLACE.x, FIRST_PLACE.y);
  }

  /** @param {{isUiEvent: boolean}} event */
  #onEvent(event) {
    if (event.isUiEvent) return;
    const kept = JSON.stringify(this.blocks);
    if (kept === this.#kept || this.#workspace.isDragging()) return;
    this.#kept = kept;
    this.#fit();
    this.onChange();
  }
}

/**
 * Give the focus back to what Blockly moves: a frame after a highlight it puts blocks in another order.
 * @param {HTMLElement} parent
 */
function keepFocus(parent) {
  /** @type {HTMLElement | null} */
  let latest = null;
  parent.addEventListener("focusin", ({ target }) => (latest = /** @type {HTMLElement} */ (target)));
  new MutationObserver((changes) => {
    if (document.activeElement !== document.body || !latest?.isConnected) return;
    const moved = changes.flatMap(({ removedNodes }) => [...removedNodes]);
    if (moved.some((node) => node.contains(latest))) latest.focus();
  }).observe(parent, { childList: true, subtree: true });
}

/**
 * Define an agent's blocks.
 * @param {AgentBlocks} agent
 */
function define(agent) {
  for (const type of Object.keys(Blockly.Blocks)) delete Blockly.Blocks[type]; // another agent's
  Blockly.common.defineBlocksWithJsonArray(definitions(agent));
}

/**
 * Return a block of another agent, in the form of Blockly: it shows its name, and keeps its values.
 * @param {string} type
 * @param {Program} blocks that have one of the type
 */
function strangeBlock(type, blocks) {
  const { fields = {} } = blocksIn(blocks).find((block) => block.type === type);
  const words = Object.keys(fields).map((name, index) => ({ type: "field_label_serializable", name, text: String(index) }));
  const marks = words.map((_, index) => ` %${index + 1}`).join("");
  const isAction = type.startsWith("act:") || type === "rest";
  const isHat = type.startsWith("on_");
  const inputs = isAction && type !== "rest" ? [{ type: "input_value", name: "VALUE" }] : [];
  /** @type {Record<string, null>} */
  const shape = isHat ? { nextStatement: null } : isAction ? { previousStatement: null, nextStatement: null } : { output: null };
  const name = t("(not of this robot) {name}", { name: type.replace(/^\w+:/, "").replaceAll("%", "%%") });
  const message0 = `${name}${marks}${inputs.length ? ` %${words.length + 1}` : ""}`;
  return { type, message0, args0: [...words, ...inputs], ...shape, style: isHat ? "events" : isAction ? "actions" : "senses" };
}

/** @param {Program} blocks */
function typesIn(blocks) {
  return new Set(blocksIn(blocks).map(({ type }) => type));
}

/**
 * Return all blocks of a state, inner ones, too.
 * @param {Program} state
 */
function blocksIn(state) {
  /** @type {Block[]} */
  const found = [];
  const visit = (/** @type {Block | undefined} */ block) => {
    if (!block) return;
    found.push(block);
    for (const { block: inner, shadow } of Object.values(block.inputs ?? {})) [inner, shadow].forEach(visit);
    visit(block.next?.block);
  };
  (state.blocks?.blocks ?? []).forEach(visit);
  return found;
}

/** @param {Program} state */
function withoutIds(state) {
  const copy = structuredClone(state);
  for (const block of blocksIn(copy)) {
    delete block.id;
    if ("x" in block) [block.x, block.y] = [Math.round(block.x), Math.round(block.y)];
  }
  return copy;
}
