/** Storage of a person's choices in this browser. Without storage they last as long as the page. */

const PREFIX = "ai4u-";
const unstored = new Map();

/**
 * Return a remembered value; `fallback` if there is none.
 * @param {string} key
 * @param {unknown} fallback
 * @returns {any} another page, or an earlier version, may have kept anything
 */
export function recall(key, fallback) {
  try {
    const text = localStorage.getItem(PREFIX + key);
    return text === null ? (unstored.get(key) ?? fallback) : JSON.parse(text);
  } catch {
    return unstored.get(key) ?? fallback; // storage is blocked, or holds something else
  }
}

/**
 * Return the browser's key for a key of ours, as its event "storage" has it.
 * @param {string} key
 */
export function storageKey(key) {
  return PREFIX + key;
}

/**
 * Remember a value that JSON can hold.
 * @param {string} key
 * @param {unknown} value
 */
export function remember(key, value) {
  unstored.set(key, value);
  try {
    localStorage.setItem(PREFIX + key, JSON.stringify(value));
  } catch {
    // storage is blocked or full
  }
}

/**
 * Forget a value.
 * @param {string} key
 */
export function forget(key) {
  unstored.delete(key);
  try {
    localStorage.removeItem(PREFIX + key);
  } catch {
    // storage is blocked
  }
}
