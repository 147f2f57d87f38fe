/**
 * A program in the fragment of a link to a scene: `&program=DATA&agent=ID` after the scene's own fields.
 *
 * DATA is the text of the program, compressed by zlib, in base64 for addresses. Nothing of it reaches a server, and it is
 * text only: the tab "Code" offers it, and runs nothing by itself.
 */

import { t } from "../shared/text.js";

/** Longest program (characters); a class keeps no longer one. */
export const MAX_PROGRAM_CHARS = 100_000;
/** Longest compressed program, in base64 (characters). */
const MAX_DATA_CHARS = 60_000;
/** Longest link; as MAX_LINK_CHARS of scene_link.py. */
const MAX_LINK_CHARS = 100_000;
const MAX_AGENT_CHARS = 100;
const DAMAGED = t("The link's program is damaged: a part of it is missing or was changed.");
const TOO_LARGE = t("This program is too large for a link. Download it, and share its file.");

/**
 * Return a link's fragment with a program in it. Rejects with a sentence.
 * @param {string} fragment
 * @param {{agent: string, source: string}} program
 */
export async function withProgram(fragment, { agent, source }) {
  const data = base64(await piped(new TextEncoder().encode(source), new CompressionStream("deflate")));
  const found = `${fragment}&program=${data}&agent=${encodeURIComponent(agent)}`;
  if (source.length > MAX_PROGRAM_CHARS || data.length > MAX_DATA_CHARS || found.length > MAX_LINK_CHARS) throw new Error(TOO_LARGE);
  return found;
}

/**
 * Return the program in a link: {agent, source}; null if there is none. Rejects with a sentence.
 * @param {string} link
 */
export async function programIn(link) {
  const fields = new URLSearchParams(link.replaceAll(/\s/g, "").split("#").pop());
  const [data, agent] = [fields.get("program"), fields.get("agent") ?? ""];
  if (data === null) return null;
  if (!/^[\w-]+$/.test(data) || data.length > MAX_DATA_CHARS || agent.length > MAX_AGENT_CHARS) throw new Error(DAMAGED);
  let source;
  try {
    const packed = Uint8Array.from(atob(data.replaceAll("-", "+").replaceAll("_", "/")), (each) => each.charCodeAt(0));
    source = new TextDecoder("utf-8", { fatal: true }).decode(await piped(packed, new DecompressionStream("deflate")));
  } catch {
    throw new Error(DAMAGED);
  }
  if (source.length > MAX_PROGRAM_CHARS) throw new Error(DAMAGED);
  return { agent, source };
}

/**
 * Return a link without its program, for the server.
 * @param {string} link
 */
export function withoutProgram(link) {
  return link.replaceAll(/&(program|agent)=[^&]*/g, "");
}

/**
 * Return the bytes that come out of a stream; rejects as soon as they are too many.
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {CompressionStream | DecompressionStream} stream
 */
async function piped(bytes, stream) {
  const parts = [];
  let size = 0;
  for await (const part of chunksOf(new Blob([bytes]).stream().pipeThrough(stream))) {
    size += part.length;
    if (size > 4 * MAX_PROGRAM_CHARS) throw new Error(TOO_LARGE);
    parts.push(part);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/**
 * Yield the parts of a stream: not all browsers iterate over one.
 * @param {ReadableStream<Uint8Array<ArrayBuffer>>} stream
 */
async function* chunksOf(stream) {
  const reader = stream.getReader();
  try {
    for (let next = await reader.read(); !next.done; next = await reader.read()) yield next.value;
  } finally {
    reader.cancel().catch(() => {}); // it is over already
  }
}

/** @param {Uint8Array} bytes */
function base64(bytes) {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}
