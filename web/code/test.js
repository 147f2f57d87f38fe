/** A test of the person's program: it drives several starts that it has not seen, as fast as the world goes. */

/** @import { EmitterClass } from "../types/events.js" */
/** @import { Percept, Welcome } from "../types/remote.js" */
/** @import { RemoteClient } from "../remote/client.js" */
/** @import { Answer, CodeEngine } from "./engine.js" */
/** @import { Connecting, Decision, RunEnd } from "./run.js" */

import { connect, isOver, ProgramMistake, programFacts, STOPPED, toldBy, valid } from "./run.js";
import { t } from "../shared/text.js";

export const STARTS = 10;
/** Number of different seeds; trainings use none of them, see evaluating.py. */
const SEEDS = 1_000_000;
/** Longest episode, in the world's time, where the scene has no limit of its own (s). */
const MAX_EPISODE_S = 60;
const REFUSED = t("Test would begin new episodes for the other robots of this world, too, and make them wait. Whoever runs the world may allow it (ai4u-edu play --lockstep --seeded-resets); Run works anyway.");
const INTERRUPTED = t("Another episode began in the middle of a start, so the test was ended.");

/**
 * @typedef {object} Start
 * @property {number} number from 1
 * @property {number} seed
 * @property {string} outcome "goal", "time", "fell", "over", "mistake", or empty before the end
 * @property {number} decisions
 * @property {number} seconds
 * @property {number} reward
 */
/** @typedef {<Result>(promise: Promise<Result>) => Promise<Result>} Until returns what a promise gives; throws if the test was ended meanwhile */

/** Its event "change" is of phase and rows. */
export class CodeTest extends /** @type {EmitterClass<{change: null, decision: Decision, end: RunEnd}>} */ (EventTarget) {
  /** "off", "loading" (Python), "joining" (the world gives the agent), or "testing". */
  phase = "off";
  /** @type {Start[]} */
  rows = [];
  /** Id of the agent that is tested. */
  agent = "";
  #parts;
  /** @type {RemoteClient | null} */
  #client = null;
  /** @type {CodeEngine | null} */
  #engine = null;
  #ticket = 0;
  /** @type {Start | null} */
  #current = null;

  /**
   * @param {object} parts
   * @param {() => Promise<CodeEngine>} parts.warm returns an engine with Python loaded
   * @param {{max: () => Promise<void>, restore: () => Promise<void>}} parts.speed of the world
   * @param {(options: Connecting) => Promise<RemoteClient>} [parts.connect]
   * @param {() => Promise<void>} [parts.prepare] called before the start; lets a paused world run
   * @param {(percept: Percept, seed: number) => Promise<string>} [parts.outcome] returns the world's word for an episode that ended
   *   without the goal
   * @param {() => number[]} [parts.draw] returns the seeds
   */
  constructor(parts) {
    super();
    this.#parts = { connect, prepare: async () => {}, outcome: async () => "over", draw: drawSeeds, ...parts };
  }

  get isOn() {
    return this.phase !== "off";
  }

  /** Number of the latest decision in its start. */
  get decision() {
    return this.#current?.decisions ?? 0;
  }

  /** Number of the latest start; 0 before the first one. */
  get start() {
    return this.#current?.number ?? 0;
  }

  /** The seed of the first start that did not reach the goal; null if there is none. */
  get failure() {
    return this.rows.find(({ outcome }) => outcome && outcome !== "goal")?.seed ?? null;
  }

  /**
   * Drive an agent with a program from each start.
   * @param {string} source
   * @param {string} agent
   * @param {number[]} [seeds] of the starts; default: some that nobody can foresee
   */
  async run(source, agent, seeds = this.#parts.draw()) {
    this.stop();
    const ticket = ++this.#ticket;
    this.agent = agent;
    this.#current = null;
    this.rows = seeds.map((seed, index) => ({ number: index + 1, seed, outcome: "", decisions: 0, seconds: 0, reward: 0 }));
    try {
      await this.#drive(source, agent, (promise) => valid(promise, () => ticket !== this.#ticket));
      this.#end({ reason: "tested" });
    } catch (error) {
      if (error === STOPPED || ticket !== this.#ticket) return;
      const isMistake = error instanceof ProgramMistake;
      if (isMistake && this.#current !== null) this.#current.outcome = "mistake";
      const isRefused = error.code === "lockstep_refused" || error.code === "seed_refused";
      const text = isRefused ? REFUSED : error.message;
      this.#end({ reason: isMistake ? "mistake" : "lost", text, line: error.line ?? null, kind: error.kind ?? "" });
    }
  }

  /** End the test at once, and give the agent back. */
  stop(text = "") {
    if (this.isOn) this.#end({ reason: text ? "lost" : "stopped", text });
  }

  /** Forget the results. */
  clear() {
    this.stop();
    this.rows = [];
    this.#current = null;
    this.#emit("change");
  }

  /**
   * @param {string} source
   * @param {string} agent
   * @param {Until} until
   */
  async #drive(source, agent, until) {
    this.#set("loading");
    this.#engine = await until(this.#parts.warm());
    this.#set("joining");
    await until(this.#parts.prepare());
    const client = await this.#parts.connect({ agent, mode: "lockstep" });
    await until(null).catch((stopped) => {
      client.close();
      throw stopped;
    });
    this.#client = client;
    await until(this.#parts.speed.max());
    this.#set("testing");
    for (const row of this.rows) await this.#driveStart(row, source, client, until);
  }

  /**
   * @param {Start} row
   * @param {string} source
   * @param {RemoteClient} client
   * @param {Until} until
   */
  async #driveStart(row, source, client, until) {
    const engine = this.#engine;
    // nothing that the program remembers of the start before is there in a new interpreter; the next one loads meanwhile
    checked(await until(engine.load(source, programFacts(client.welcome), 0)));
    await until(client.reset(row.seed));
    let percept = await until(client.sense());
    this.#current = row;
    this.#emit("change");
    checked(await until(engine.begin()));
    const tally = new Tally(client.welcome, percept.tick);
    while (!isOver(percept) && !tally.isTimeUp) {
      row.decisions = percept.step + 1;
      const answer = await until(engine.decide(percept.values, row.decisions));
      const detail = { ...toldBy(answer), episode: percept.episode, number: row.decisions, source };
      this.dispatchEvent(new CustomEvent("decision", { detail }));
      checked(answer);
      await until(client.act(answer.values));
      const next = await until(client.sense());
      if (next.episode !== percept.episode) throw new Error(INTERRUPTED);
      percept = next;
      tally.add(percept);
      row.seconds = tally.seconds;
      row.reward = tally.reward;
    }
    if (tally.isGoal(percept)) row.outcome = "goal";
    else row.outcome = percept.terminated ? await until(this.#parts.outcome(percept, row.seed)) : "time";
    this.#emit("change");
  }

  /** @param {Partial<RunEnd> & Pick<RunEnd, "reason">} detail */
  #end(detail) {
    this.#ticket += 1;
    Promise.resolve(this.#client?.close()).catch(() => {}); // it is gone already
    this.#client = null;
    this.#engine?.finish();
    this.#engine = null;
    this.#parts.speed.restore();
    this.#set("off");
    this.dispatchEvent(new CustomEvent("end", { detail: { text: "", line: null, percept: null, ...detail } }));
  }

  /** @param {string} phase */
  #set(phase) {
    this.phase = phase;
    this.#emit("change");
  }

  /** @param {string} type */
  #emit(type) {
    this.dispatchEvent(new Event(type));
  }
}

/** The rewards and the time of an episode; it reaches the goal as in evaluating.py and outcome.py. */
class Tally {
  #welcome;
  #firstTick;
  #success = 0;
  reward = 0;
  seconds = 0;

  /**
   * @param {Welcome} welcome
   * @param {number} firstTick
   */
  constructor(welcome, firstTick) {
    this.#welcome = welcome;
    this.#firstTick = firstTick;
  }

  /** @param {Percept} percept */
  add({ tick, reward, terms }) {
    this.reward += reward;
    this.#success += terms[this.#welcome.success] ?? 0;
    this.seconds = (tick - this.#firstTick) / this.#welcome.ticksPerSecond;
  }

  get isTimeUp() {
    return !this.#welcome.maxSteps && this.seconds >= MAX_EPISODE_S;
  }

  /**
   * A scene that names no success has one all the same: an end that pays.
   * @param {Percept} percept
   */
  isGoal({ terminated }) {
    return this.#welcome.success ? this.#success > 0 : terminated && this.reward > 0;
  }
}

/**
 * Return how many decisions the starts took on average.
 * @param {Start[]} rows
 */
export function averageDecisions(rows) {
  return rows.reduce((sum, { decisions }) => sum + decisions, 0) / rows.length;
}

/** Return different seeds that nobody can foresee. */
function drawSeeds() {
  /** @type {Set<number>} */
  const seeds = new Set();
  while (seeds.size < STARTS) seeds.add(crypto.getRandomValues(new Uint32Array(1))[0] % SEEDS);
  return [...seeds];
}

/** @param {Answer} answer */
function checked(answer) {
  if (!answer.ok) throw new ProgramMistake(answer);
  return answer;
}
