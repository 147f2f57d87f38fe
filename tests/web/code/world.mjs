/** A world and a Python that answer at once, for CodeRun and CodeTest. */

/** Return a percept with changes. */
export function percept(changes = {}) {
  return { values: { x: 1 }, episode: 1, step: 0, tick: 0, reward: 0, terms: {}, terminated: false, truncated: false, ...changes };
}

/** Return a fake: `calls` tells what was done, `percepts` are given in turn, `answers` by the number of a decision. */
export function fakeWorld(percepts, { welcome = {}, answers = {} } = {}) {
  const calls = [];
  const engine = {
    warm: async () => calls.push("warm"),
    load: async (source, facts) => (calls.push(`load ${source} ${JSON.stringify(facts.outputs)}`), { ok: true, ...answers.load }),
    begin: async () => (calls.push("begin"), { ok: true, ...answers.begin }),
    decide: async (_, number, stops = []) => (calls.push(`decide ${number}${stops.length ? ` until ${stops}` : ""}`), { ok: true, values: { move: [number] }, ...answers[number] }),
    finish: () => calls.push("finish"),
  };
  const client = {
    welcome: { success: "touch", ticksPerSecond: 60, maxSteps: 0, readings: [], outputs: [{ name: "move", low: [-1], high: [1] }], ...welcome },
    sense: async () => (percepts.length > 1 ? percepts.shift() : percepts[0]),
    act: async (values) => calls.push(`act ${values.move}`),
    reset: async (...seed) => calls.push(["reset", ...seed].join(" ")),
    wait: async () => calls.push("wait"),
    close: async () => calls.push("close"),
  };
  const connect = async ({ mode }) => (calls.push(`connect ${mode}`), client);
  return { calls, engine, client, connect };
}

/** Return a promise for the detail of the event "end". */
export function endOf(target) {
  return new Promise((resolve) => target.addEventListener("end", ({ detail }) => resolve(detail), { once: true }));
}
