/** Ids: of elements, and random ones. */

let lastId = 0;

/** Return an id that no other element of the page has. */
export function freeId() {
  lastId += 1;
  return `ai4u-${lastId}`;
}

/** Return random bytes in hexadecimal digits. crypto.randomUUID is missing on pages without HTTPS. */
export function randomId(bytes = 16) {
  return Array.from(crypto.getRandomValues(new Uint8Array(bytes)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}
