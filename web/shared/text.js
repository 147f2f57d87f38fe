/** Texts in the reader's language; English in the code. See docs/translating.md. */

/**
 * @typedef {object} Catalogue of the page's language
 * @property {string} language its code, such as "pt_BR"
 * @property {Record<string, string | Record<string, string>>} messages translations by English text;
 *   of a text that counts something, by CLDR's plural category
 */

/** @type {Catalogue} */
let catalogue = { language: "en", messages: {} };
// workers have no document, and get theirs from their page
if (typeof document !== "undefined") {
  const element = document.getElementById("ai4u-texts");
  if (element !== null) catalogue = JSON.parse(element.textContent ?? "");
}

/** Return the page's language with its texts, for a worker. */
export const pageCatalogue = () => catalogue;

/** @param {Catalogue} wanted of the page that started this worker */
export function setCatalogue(wanted) {
  catalogue = wanted;
}

/**
 * Return a text in the page's language.
 * @param {string} text in English: a literal, since it is the key
 * @param {Record<string, string | number>} values by their names in braces in the text
 */
export function t(text, values = {}) {
  const found = catalogue.messages[text];
  return filled(typeof found === "string" ? found : text, values);
}

/**
 * Return a text that counts something.
 * @param {string} one in English, for the number 1
 * @param {string} many in English, for all others; {n} is the number
 * @param {number} number
 * @param {Record<string, string | number>} values
 */
export function tn(one, many, number, values = {}) {
  const found = catalogue.messages[one];
  const english = number === 1 ? one : many;
  let text = english;
  if (typeof found === "object") {
    const category = new Intl.PluralRules(catalogue.language.replace("_", "-")).select(number);
    text = found[category] ?? found.other ?? english;
  }
  return filled(text, { n: whole(number), ...values });
}

/**
 * Return a whole number with its thousands apart, as the page's language writes them.
 * @param {number} value
 */
export function whole(value) {
  return value.toLocaleString(catalogue.language.replace("_", "-"));
}

/**
 * @param {string} text
 * @param {Record<string, string | number>} values
 */
function filled(text, values) {
  return text.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? String(values[name]) : whole));
}
