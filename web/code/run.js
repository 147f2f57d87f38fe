/** A run of the person's program: it senses, decides and acts until the episode is over, a mistake, or Stop. */

/** @import { EmitterClass } from "../types/events.js" */
/** @import { Percept, Value, Welcome } from "../types/remote.js" */
/** @import { RemoteClient } from "../remote/client.js" */
/** @import { Answer, CodeEngine, Facts, TracedMoment } from "./engine.js" */
/** @import { Told } from "./timeline.js" */

import { t } from "../shared/text.js";

/** @typedef {Told & {episode: number, number: number, source: string}} Decision */
/** @typedef {Decision & {percept: Record<string, Value>, action: Record<string, number[]> | null}} RunDecision */
/**
 * @typedef {object} RunEnd
 * @property {"over" | "tested" | "stopped" | "mistake" | "lost"} reason
 * @property {string} text
 * @property {number | null} line
 * @property {string} [kind] of a mistake
 * @property {Percept | null} percept the last one, if the episode is over
 */
/** @typedef {{change: null, decision: RunDecision, printed: {number: number, text: string}, end: RunEnd}} RunEvents */
/** @typedef {{agent: string, mode: "realtime" | "lockstep"}} Connecting */

/** Interval at which a world that waits between two steps is asked to wait longer (ms). */
const WAIT_MS = 400;
const NO_STEPS = t("Step would make the other robots of this world wait, too. Whoever runs the world may allow it (ai4u-edu play --lockstep); Run works anyway.");
/** @type {(isStep: boolean) => void} */
const NOBODY_WAITS = () => {};
/** Thrown where a run goes on after it was stopped. */
export const STOPPED = Symbol("stopped");

/** A sentence about a program that can't go on, with the line or null. */
export class ProgramMistake extends Error {
  /** @param {Answer} answer */
  constructor({ text, line = 0, kind = "" }) {
    super(text);
    this.line = line || null; // 0 is no line
    this.kind = kind;
  }
}

/** Its event "change" is of phase and decision. */
export class CodeRun extends /** @type {EmitterClass<RunEvents>} */ (EventTarget) {
  /** "off", "loading" (Python), "joining" (the world gives the agent), "running", "stepping", or "waiting" (at a breakpoint). */
  phase = "off";
  /**
   * Lines with a breakpoint.
   * @type {number[]}
   */
  stops = [];
  /**
   * The line at which the program waits, and the variables before it; null while it waits at none.
   * @type {TracedMoment | null}
   */
  moment = null;
  /** Ends the wait at a breakpoint. */
  #passOn = NOBODY_WAITS;
  /** True if the next decision waits at its first line. */
  #isStepping = false;
  /** Number of the latest decision in its episode; 0 before the first one of a run. */
  decision = 0;
  /** Name of the reward's term that is paid at the goal; empty if there is none. */
  success = "";
  /** Id of the agent that the latest run drove. */
  agent = "";
  #parts;
  /** @type {Promise<CodeEngine> | null} */
  #engine = null;
  #isWarm = false;
  /** @type {RemoteClient | null} */
  #client = null;
  /**
   * The end of the latest connection, or of its attempt.
   * @type {Promise<void>}
   */
  #ended = Promise.resolve();
  #ticket = 0;
  /** @type {string | null} */
  #source = null;
  /**
   * The percept that the next step decides about.
   * @type {Percept | null}
   */
  #pending = null;
  #timer = 0;

  /**
   * @param {object} parts
   * @param {() => Promise<CodeEngine>} [parts.makeEngine]
   * @param {(options: Connecting) => Promise<RemoteClient>} [parts.connect]
   * @param {() => Promise<void>} [parts.prepare] called before each start; lets a paused world run
   * @param {(on: boolean) => Promise<void>} [parts.hold] lets the world wait while the program waits at a breakpoint, or go on
   * @param {() => Promise<boolean>} [parts.beginAgain] begins another episode while nobody drives; returns false if it can't
   */
  constructor(parts = {}) {
    super();
    this.#parts = { makeEngine, connect, prepare: async () => {}, hold: async () => {}, beginAgain: async () => false, ...parts };
  }

  get isOn() {
    return this.phase !== "off";
  }

  /** Load Python in advance; the promise rejects if that fails. */
  async warm() {
    this.#engine ??= Promise.resolve(this.#parts.makeEngine());
    const engine = await this.#engine.catch((error) => {
      this.#engine = null; // the next one tries again
      throw error;
    });
    await engine.warm();
    this.#isWarm = true;
    return engine;
  }

  /**
   * Drive an agent with a program, at the world's own pace. An episode with the same start begins, but after steps of
   * the same program it goes on.
   * @param {string} source
   * @param {string} agent
   * @param {object} [from]
   * @param {number | null} [from.seed] begins an episode with it instead
   * @param {boolean} [from.isHere] drives from where the agent stands instead
   * @param {boolean} [from.isWaitedFor] the world waits for a late decision, unless other robots would wait, too
   */
  async run(source, agent, { seed = null, isHere = false, isWaitedFor = false } = {}) {
    await this.#guarded(async (ticket) => {
      const isNext = this.phase === "stepping" && source === this.#source;
      const isFresh = seed === null && !isHere && !isNext;
      const start = (/** @type {Connecting["mode"]} */ mode) => this.#start(source, agent, mode, ticket, { seed, isFresh });
      const waitedFor = () =>
        start("lockstep").catch((error) => {
          if (error.code === "lockstep_refused") return start("realtime");
          throw error;
        });
      let percept = await (isWaitedFor ? waitedFor() : start("realtime"));
      this.#set("running");
      for (;;) percept = await this.#decide(percept, ticket);
    });
  }

  /**
   * Make one decision, and have the world wait before the next one.
   * @param {string} source
   * @param {string} agent
   */
  async step(source, agent) {
    const isNext = this.phase === "stepping" && source === this.#source;
    if (isNext && this.#pending === null) return; // the decision before is not over yet
    await this.#guarded(async (ticket) => {
      const percept = isNext ? this.#pending : await this.#start(source, agent, "lockstep", ticket);
      this.#pending = null;
      clearInterval(this.#timer);
      const client = this.#client;
      this.#pending = await this.#decide(percept, ticket);
      this.#set("stepping");
      // else the world would go on without an answer
      this.#timer = setInterval(() => client.wait().catch(() => {}), WAIT_MS); // the next step tells of an error
    });
  }

  /**
   * Go on from a breakpoint.
   * @param {boolean} isStep true to run one line, and wait again
   */
  goOn(isStep) {
    this.#passOn(isStep);
  }

  /** Give the agent back; a text tells why, if it was not the person who wanted it. */
  stop(text = "") {
    if (this.isOn) this.#end({ reason: text ? "lost" : "stopped", text });
  }

  /**
   * Call a function with a ticket, and end the run if it throws.
   * @param {(ticket: number) => Promise<void>} work
   */
  async #guarded(work) {
    const ticket = ++this.#ticket;
    this.#passOn(false); // the run before may wait at a breakpoint
    try {
      await work(ticket);
    } catch (error) {
      if (error === STOPPED || ticket !== this.#ticket) return;
      const reason = error instanceof ProgramMistake ? "mistake" : "lost";
      const text = error.code === "lockstep_refused" ? NO_STEPS : error.message;
      this.#end({ reason, text, line: error.line ?? null, kind: error.kind ?? "" });
    }
  }

  /**
   * Connect, load the program, and return the first percept.
   * @param {string} source
   * @param {string} agent
   * @param {Connecting["mode"]} mode
   * @param {number} ticket
   * @param {{seed?: number | null, isFresh?: boolean}} [from]
   */
  async #start(source, agent, mode, ticket, { seed = null, isFresh = false } = {}) {
    // from Step to Run and back, the same program goes on with what it remembers
    const goesOn = seed === null && !isFresh && this.isOn && this.#client !== null && source === this.#source;
    this.#leave();
    if (!goesOn) this.#endProgram();
    this.#source = null;
    if (!this.#isWarm) this.#set("loading");
    const engine = await valid(this.warm(), () => this.#isStale(ticket));
    this.#set("joining");
    if (isFresh) await this.#until(this.#parts.beginAgain(), ticket);
    let percept = await this.#join(agent, mode, ticket);
    if (isOver(percept) && seed === null) percept = await this.#beginAgain(agent, mode, ticket);
    if (!goesOn) {
      this.decision = 0;
      this.#checked(await this.#until(engine.load(source, programFacts(this.#client.welcome)), ticket));
      if (seed !== null) percept = await this.#resetTo(seed, ticket);
      this.#checked(await this.#until(engine.begin(), ticket));
    }
    this.#source = source;
    return percept;
  }

  /**
   * @param {string} agent
   * @param {Connecting["mode"]} mode
   * @param {number} ticket
   */
  async #join(agent, mode, ticket) {
    this.agent = agent;
    await this.#until(this.#parts.prepare(), ticket);
    const client = await this.#connect(agent, mode, ticket);
    this.#client = client;
    this.success = client.welcome.success ?? "";
    return this.#until(client.sense(), ticket);
  }

  /**
   * Connect when the connection before has ended: the world gives an agent to one at a time.
   * @param {string} agent
   * @param {Connecting["mode"]} mode
   * @param {number} ticket
   */
  #connect(agent, mode, ticket) {
    const connected = this.#ended.then(async () => {
      if (this.#isStale(ticket)) throw STOPPED;
      const client = await this.#parts.connect({ agent, mode });
      if (!this.#isStale(ticket)) return client;
      await client.close();
      throw STOPPED;
    });
    this.#ended = connected.then(() => {}, () => {}); // the caller is told
    return connected;
  }

  /**
   * @param {string} agent
   * @param {Connecting["mode"]} mode
   * @param {number} ticket
   */
  async #beginAgain(agent, mode, ticket) {
    this.#leave();
    await this.#until(this.#parts.beginAgain(), ticket);
    const percept = await this.#join(agent, mode, ticket);
    if (!isOver(percept)) return percept;
    await this.#until(this.#client.reset(), ticket);
    return this.#until(this.#client.sense(), ticket);
  }

  /**
   * @param {number} seed
   * @param {number} ticket
   */
  async #resetTo(seed, ticket) {
    await this.#until(this.#client.reset(seed), ticket);
    return this.#until(this.#client.sense(), ticket);
  }

  /**
   * Make one decision, and return the next percept; the end of the episode ends the run.
   * @param {Percept} percept
   * @param {number} ticket
   */
  async #decide(percept, ticket) {
    const engine = await this.#engine;
    const number = percept.step + 1;
    const stops = this.#isStepping ? [0] : this.stops;
    this.#isStepping = false;
    const answer = await this.#until(engine.decide(percept.values, number, stops), ticket);
    this.decision = number;
    if (answer.moments?.length) await this.#waitAt(answer.moments, ticket);
    const did = { percept: percept.values, action: answer.values ?? null };
    this.#emit("decision", { ...toldBy(answer), ...did, episode: percept.episode, number, source: this.#source });
    this.#checked(answer, number);
    await this.#until(this.#client.act(answer.values), ticket);
    const next = await this.#until(this.#client.sense(), ticket);
    if (isOver(next)) {
      this.#end({ reason: "over", percept: next });
      throw STOPPED;
    }
    if (next.episode !== percept.episode) this.#checked(await this.#until(engine.begin(), ticket));
    return next;
  }

  /**
   * Wait at a breakpoint while the world waits, too. The program has run on already: what it did after the line is shown
   * line by line, and its action is kept back.
   * @param {TracedMoment[]} moments
   * @param {number} ticket
   */
  async #waitAt(moments, ticket) {
    const { phase } = this;
    const client = this.#client;
    const asking = phase === "running" ? 0 : setInterval(() => client.wait().catch(() => {}), WAIT_MS);
    await this.#until(this.#parts.hold(true), ticket);
    try {
      let isStep = true;
      for (const [index, moment] of moments.entries()) {
        const isStop = index === 0 || this.stops.includes(moment.line);
        if (!isStep && !isStop) continue;
        this.moment = moment;
        this.#set("waiting");
        isStep = await this.#until(new Promise((resolve) => (this.#passOn = resolve)), ticket);
      }
      this.#isStepping = isStep;
    } finally {
      clearInterval(asking);
      this.moment = null;
      this.#passOn = NOBODY_WAITS;
      await this.#parts.hold(false);
    }
    this.#set(phase);
  }

  /**
   * Tell what an answer of the engine printed; throw if it tells of a mistake.
   * @param {Answer} answer
   */
  #checked(answer, number = 0) {
    if (answer.printed) this.#emit("printed", { number, text: answer.printed });
    if (!answer.ok) throw new ProgramMistake(answer);
  }

  /**
   * @template Result
   * @param {Promise<Result>} promise
   * @param {number} ticket
   */
  #until(promise, ticket) {
    return valid(promise, () => this.#isStale(ticket));
  }

  /** @param {number} ticket */
  #isStale(ticket) {
    return ticket !== this.#ticket;
  }

  /** @param {Partial<RunEnd> & Pick<RunEnd, "reason">} detail */
  #end(detail) {
    this.#ticket += 1;
    this.#isStepping = false;
    this.#passOn(false); // whoever waits finds that it is over
    this.#leave();
    this.#endProgram();
    this.#source = null;
    this.#set("off");
    this.#emit("end", { text: "", line: null, percept: null, ...detail });
  }

  /** End the program with all that it left running; Python is loaded again for the next one. */
  #endProgram() {
    if (!this.#isWarm) return;
    this.#isWarm = false;
    this.#engine.then((engine) => engine.finish());
    this.warm().catch(() => {}); // the next run tells of it
  }

  #leave() {
    clearInterval(this.#timer);
    this.#pending = null;
    const closed = Promise.resolve(this.#client?.close()).catch(() => {}); // it is gone already
    this.#ended = this.#ended.then(() => closed);
    this.#client = null;
  }

  /** @param {string} phase */
  #set(phase) {
    this.phase = phase;
    this.#emit("change");
  }

  /**
   * @template {keyof RunEvents} Type
   * @param {Type} type
   * @param {RunEvents[Type]} detail
   */
  #emit(type, detail = null) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}

/** @returns {Promise<CodeEngine>} */
async function makeEngine() {
  return new (await import("./engine.js")).CodeEngine();
}

/**
 * @param {Connecting} options
 * @returns {Promise<RemoteClient>}
 */
export async function connect(options) {
  return (await import("../remote/client.js")).RemoteClient.connect(options);
}

/**
 * Return what a promise gives, unless the run was stopped meanwhile.
 * @template Result
 * @param {Promise<Result>} promise
 * @param {() => boolean} isStale
 */
export async function valid(promise, isStale) {
  const value = await promise;
  if (isStale()) throw STOPPED;
  return value;
}

/** @param {Percept} percept */
export function isOver({ terminated, truncated }) {
  return terminated || truncated;
}

/**
 * Return what an answer of the engine tells of a decision, for CodeTimeline.
 * @param {Answer} answer
 * @returns {Told}
 */
export function toldBy({ lines = [], variables = {}, printed = "" }) {
  return { lines, variables, printed };
}

/**
 * Return what CodeEngine.load takes, from the world's welcome.
 * @param {Welcome} welcome
 * @returns {Facts}
 */
export function programFacts({ readings, outputs }) {
  return { readings, outputs: Object.fromEntries(outputs.map(({ name, low, high }) => [name, [low, high]])) };
}
