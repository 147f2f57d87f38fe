/** Stand-ins for the little of a browser that a module under test needs. */

/** Listeners that modules have added to the window, by type. */
const listeners = new Map();

/** Give this process a window at an address, with storage that is empty. */
export function openWindow(address = "http://world.example/") {
  const kept = new Map();
  const localStorage = {
    getItem: (key) => kept.get(key) ?? null,
    setItem: (key, value) => void kept.set(key, String(value)),
    removeItem: (key) => void kept.delete(key),
  };
  class Element extends EventTarget {
    dataset = {};
    hidden = false;
    textContent = "";
    children = [];
    append(...children) {
      this.children.push(...children);
    }
    closest() {
      return null;
    }
    matches() {
      return false;
    }
    setAttribute(name, value) {
      this[name] = value;
    }
  }
  class HTMLElement extends Element {}
  class HTMLInputElement extends HTMLElement {}
  const document = new (class extends EventTarget {
    baseURI = address;
    hidden = false;
    body = new HTMLElement();
    createElement() {
      return new HTMLElement();
    }
    getElementById() {
      return null;
    }
    hasFocus() {
      return true;
    }
  })();
  listeners.clear();
  const addEventListener = (type, call) => listeners.set(type, [...(listeners.get(type) ?? []), call]);
  const all = { addEventListener, document, Element, HTMLElement, HTMLInputElement, localStorage, location: new URL(address) };
  for (const [name, value] of Object.entries(all)) Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });
  return { kept, document };
}

/** Send an event to what listens to the window. */
export function send(type, event = {}) {
  for (const listener of listeners.get(type) ?? []) listener(event);
}

/** Let `fetch` answer with these, one after another, each {status, body} or an error; return the requests. */
export function answerWith(...answers) {
  const asked = [];
  globalThis.fetch = async (url, options = {}) => {
    asked.push({ url: String(url), ...options });
    const answer = answers.length > 1 ? answers.shift() : answers[0];
    if (answer instanceof Error) throw answer;
    const { status = 200, body = "" } = answer;
    const text = typeof body === "string" ? body : JSON.stringify(body);
    return { ok: status < 400, status, json: async () => JSON.parse(text), text: async () => text };
  };
  return asked;
}

/** Let what is ready go on, until nothing is; mocked timers stand still meanwhile. */
export async function settle() {
  for (let turn = 0; turn < 50; turn += 1) await Promise.resolve();
}
