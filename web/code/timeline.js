/** Records of a program's decisions, shown when the person goes back in time; the oldest are dropped. */

/** @typedef {{lines: number[], variables: Record<string, string>, printed: string}} Told lines that ran, variables at the end, and output */

const MAX_DECISIONS = 20_000;
/** Most characters of all variables and outputs. */
const MAX_CHARS = 4_000_000;

export class CodeTimeline {
  /**
   * Episodes by the world's number, the oldest first, with their decisions by number.
   * @type {Map<number, {source: string, decisions: Map<number, Told>}>}
   */
  #episodes = new Map();
  #count = 0;
  #chars = 0;

  /**
   * Note what a program told at a decision of an episode.
   * @param {number} episode
   * @param {number} number
   * @param {string} source
   * @param {Told} told
   */
  add(episode, number, source, { lines, variables, printed }) {
    const before = this.#episodes.get(episode);
    // an edited world counts from 1 again
    if (before !== undefined && (before.source !== source || before.decisions.has(number))) this.#drop(episode);
    if (!this.#episodes.has(episode)) this.#episodes.set(episode, { source, decisions: new Map() });
    const told = { lines: [...new Set(lines)], variables, printed };
    this.#episodes.get(episode).decisions.set(number, told);
    this.#count += 1;
    this.#chars += size(told);
    while (this.#count > MAX_DECISIONS || this.#chars > MAX_CHARS) this.#dropOldest();
  }

  /**
   * Return what was told at a decision, with the program's source; null if nothing is known.
   * @param {number} episode
   * @param {number} number
   */
  at(episode, number) {
    const kept = this.#episodes.get(episode);
    const told = kept?.decisions.get(number);
    return told === undefined ? null : { source: kept.source, ...told };
  }

  clear() {
    this.#episodes.clear();
    this.#count = this.#chars = 0;
  }

  #dropOldest() {
    const [[episode, { decisions }]] = this.#episodes;
    const [[number, told]] = decisions;
    decisions.delete(number);
    this.#count -= 1;
    this.#chars -= size(told);
    if (!decisions.size) this.#episodes.delete(episode);
  }

  /** @param {number} episode */
  #drop(episode) {
    const { decisions } = this.#episodes.get(episode);
    this.#count -= decisions.size;
    for (const told of decisions.values()) this.#chars -= size(told);
    this.#episodes.delete(episode);
  }
}

/** @param {Told} told */
function size({ lines, variables, printed }) {
  const texts = Object.entries(variables).flat();
  return printed.length + lines.length + texts.reduce((sum, text) => sum + text.length, 0);
}
