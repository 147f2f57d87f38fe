/**
 * The worker that runs a student's program: CPython as WebAssembly, and the package ai4u_edu/program in it.
 *
 * It has no network (its content security policy forbids it; the page hands it all files), no page and no
 * storage: what a worker could keep or connect with is removed before the program is loaded.
 *
 * The page sends {id, method: "start", parts}, then {id, method, text} with a method of
 * ai4u_edu/program/host.py; each is answered with {id, text}. Before, {id, isBegun} says that
 * the call has begun, and {line} which line of the program is about to run. Sentences are the page's: a worker has no texts.
 */

/** @import { Parts } from "./engine.js" */

import createPyodideModule from "../vendor/pyodide/pyodide.asm.mjs?v=f7cdc8ec";
import { loadPyodide } from "../vendor/pyodide/pyodide.mjs?v=6f1d60f7";

/** The first lines of Pyodide's own file of packages, of which none is here. */
const LOCK = {
  info: { abi_version: "2026_0", arch: "wasm32", platform: "emscripten_5_0_3", python: "3.14.2" },
  packages: {},
};
const PROGRAM_PATH = "/ai4u_edu.zip";
/** Length of an answer to the page; the program package cuts what a program prints far below it. */
const MAX_ANSWER_CHARS = 2 ** 20;
/** Names of the global scope that stay, besides those of the language itself. */
const KEPT = new Set(
  ("self globalThis console performance crypto location WebAssembly TextEncoder TextDecoder URL Event " +
    "EventTarget AbortController AbortSignal DOMException MessageChannel MessagePort setTimeout clearTimeout " +
    "setInterval clearInterval queueMicrotask").split(" "),
);
const LANGUAGE = new Set(
  ("Object Function Array Number parseFloat parseInt Infinity NaN undefined Boolean String Symbol Date Promise RegExp " +
    "Error AggregateError EvalError RangeError ReferenceError SyntaxError TypeError URIError SuppressedError JSON Math " +
    "Intl ArrayBuffer SharedArrayBuffer Atomics Uint8Array Int8Array Uint16Array Int16Array Uint32Array Int32Array " +
    "Float16Array Float32Array Float64Array Uint8ClampedArray BigUint64Array BigInt64Array DataView Map BigInt Set " +
    "Iterator WeakMap WeakSet WeakRef Proxy Reflect FinalizationRegistry DisposableStack AsyncDisposableStack " +
    "decodeURI decodeURIComponent encodeURI encodeURIComponent escape unescape eval isFinite isNaN").split(" "),
);

const send = self.postMessage.bind(self);
/** @type {Record<string, (text: string) => string>} */
let methods;

self.addEventListener("message", async ({ data: { id, method, text, parts } }) => {
  let answer;
  try {
    if (method === "start") methods = await start(parts);
    else send({ id, isBegun: true });
    answer = method === "start" ? "{}" : methods[method](text);
  } catch (error) {
    answer = problem("broken", String(error).trim().slice(-500));
  }
  if (answer.length > MAX_ANSWER_CHARS) answer = problem("too_large", "");
  send({ id, text: answer });
});

/**
 * @param {string} kind of which code/engine.js knows the sentence
 * @param {string} text that it has in it
 */
function problem(kind, text) {
  return JSON.stringify({ ok: false, kind, text, line: 0, printed: "", lines: [], variables: {} });
}

/**
 * Load Python with the files that the page has fetched; return the functions of host.py by name.
 * @param {Parts} parts
 */
async function start({ wasm, library, program, messages }) {
  checkPolicy();
  // Pyodide fetches two files by itself, of which one is compiled already
  self.fetch = async (url) => new Response(String(url).endsWith(".zip") ? library : null);
  WebAssembly.instantiateStreaming = async (_, imports) => ({
    module: wasm,
    instance: await WebAssembly.instantiate(wasm, imports),
  });
  const python = await loadPyodide({
    createPyodideModule,
    indexURL: new URL("../vendor/pyodide/", import.meta.url).href,
    lockFileContents: LOCK,
    jsglobals: {},
    stdin: /** @returns {null} */ () => null,
    stdout: () => {},
    stderr: () => {},
  });
  python.FS.writeFile(PROGRAM_PATH, program);
  python.runPython(`import sys; sys.path.insert(0, "${PROGRAM_PATH}")`);
  const host = python.pyimport("ai4u_edu.program.host");
  const { load, begin, decide, call } = host;
  host.translate(JSON.stringify(messages));
  host.watch((/** @type {number} */ line) => send({ line }));
  for (const name of ["js", "pyodide_js"]) python.unregisterJsModule(name);
  python.runPython(`import sys; [sys.modules.pop(name, None) for name in ("js", "pyodide_js")]`);
  removeConnections();
  return { load, begin: () => begin(), decide, call };
}

/** Fail unless the server has sent the worker's policy: with it, no text can become code. */
function checkPolicy() {
  let made;
  try {
    made = new Function("return 1");
  } catch {
    return;
  }
  throw new Error(`the server has sent no policy for the worker (${made.length})`);
}

/** Remove all of the global scope by which a worker could connect, store, or start another worker. */
function removeConnections() {
  const { userAgent, language } = navigator;
  for (let scope = self; scope !== EventTarget.prototype; scope = Object.getPrototypeOf(scope)) {
    for (const name of Object.getOwnPropertyNames(scope)) {
      const isKept = KEPT.has(name) || LANGUAGE.has(name) || name === "constructor";
      if (!isKept) Reflect.deleteProperty(scope, name); // two numbers can't be deleted
    }
  }
  Object.defineProperty(self, "navigator", { value: Object.freeze({ userAgent, language }) });
}
