/** A program of blocks as text: its Python, and the blocks as a comment in the last line, so no copy loses them. */

/** @typedef {{OP?: string, BOOL?: string, TEXT?: string, KEY?: string, NUM?: number, TIMES?: number, VAR?: {id: string}}} OwnFields */
/** @typedef {{SLOT?: string, STAT?: string, SIDE?: string, GROUP?: string}} SenseFields */
/**
 * @typedef {object} Block in the form of Blockly
 * @property {string} type
 * @property {string} [id]
 * @property {OwnFields & SenseFields} [fields]
 * @property {Record<string, {block?: Block, shadow?: Block}>} [inputs]
 * @property {{block?: Block}} [next]
 * @property {number} [x]
 * @property {number} [y]
 */
/** @typedef {{blocks?: {blocks?: Block[]}, variables?: {id: string, name: string}[]}} Program of blocks, in the form of Blockly */

const MARK = "\n# blocks: ";
const VERSION = 1;

/**
 * Return a program's Python and its blocks.
 * @param {string} text
 * @returns {{python: string, blocks: Program | null, isOfBlocks: boolean}} isOfBlocks is true if the Python is still the
 *   one that the blocks mean, and nobody went on in Python
 */
export function splitProgram(text) {
  const at = text.lastIndexOf(MARK);
  /** @type {ReturnType<typeof splitProgram>} */
  const none = { python: text, blocks: null, isOfBlocks: false };
  if (at < 0) return none;
  const [line, ...rest] = text.slice(at + MARK.length).split("\n");
  if (rest.join("").trim()) return none;
  try {
    const { version, of, blocks } = JSON.parse(line);
    if (version !== VERSION || typeof blocks !== "object" || blocks === null) return none;
    const python = text.slice(0, at);
    return { python, blocks, isOfBlocks: of === checksum(python) };
  } catch {
    return none; // somebody has changed the line
  }
}

/**
 * Return the text of a program with blocks.
 * @param {string} python
 * @param {Program | null} blocks
 * @param {boolean} isOfBlocks as in splitProgram()
 */
export function joinProgram(python, blocks, isOfBlocks) {
  if (blocks === null) return python;
  const kept = { version: VERSION, of: isOfBlocks ? checksum(python) : "", blocks };
  return `${python}${MARK}${JSON.stringify(kept)}\n`;
}

/**
 * Return a number for a text, in hexadecimal digits (FNV-1a, 32 bits).
 * @param {string} text
 */
function checksum(text) {
  let sum = 0x811c9dc5;
  for (let at = 0; at < text.length; at += 1) sum = Math.imul(sum ^ text.charCodeAt(at), 0x01000193);
  return (sum >>> 0).toString(16).padStart(8, "0");
}
