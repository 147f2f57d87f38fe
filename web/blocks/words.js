/** Python's words: names that a program can have, and the order in which operators bind. */

/** Precedence of operators, the highest first: code in an operator of a smaller number needs brackets. */
export const [ATOM, SIGN, PRODUCT, SUM, COMPARISON, NOT, AND, OR, ANY] = [0, 1, 2, 3, 4, 5, 6, 7, 8];

const KEYWORDS = new Set(
  ("False None True and as assert async await break class continue def del elif else except finally for from global if " +
    "import in is lambda match nonlocal not or pass raise return try while with yield abs any direction float int len list " +
    "max min nearest print range round sees self str sum").split(" "),
);

/**
 * Return a name of Python for some words.
 * @param {string} words
 * @param {Set<string>} taken names that are used already; gets the new one
 */
export function identifier(words, taken) {
  let name = words.trim().normalize("NFKC").replace(/[^\p{L}\p{N}]+/gu, "_").replace(/^_+|_+$/g, "");
  if (!/^\p{L}/u.test(name)) name = `x_${name}`;
  if (KEYWORDS.has(name)) name = `${name}_`;
  let free = name;
  for (let count = 2; taken.has(free); count += 1) free = `${name}_${count}`;
  taken.add(free);
  return free;
}
