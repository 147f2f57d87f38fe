/** Messages from a world to what drives one of its agents, as web/remote/messages.js decodes them: ai4u_edu/wire/native.py. */

export interface Reading {
  key: string;
  kind: string;
  sensorType: string | number;
  dtype: "<f4" | "<i4" | "|u1" | "|b1";
  shape: number[];
  offset: number;
  /** One number for all entries, or one for each. */
  low: number[];
  high: number[];
  unit: string;
  isInput: boolean;
}

export interface Output {
  name: string;
  kind: string;
  low: number[];
  high: number[];
  isOutput: boolean;
}

/** The world's description of an agent. */
export interface Welcome {
  type: "welcome";
  version: number;
  session: string;
  /** Time for which a page whose connection is lost keeps its agent (s). */
  grace: number;
  agent: string;
  mode: string;
  title: string;
  ticksPerSecond: number;
  skipFrame: number;
  repeatAction: boolean;
  /** Decisions after which an episode is truncated; 0 for no limit. */
  maxSteps: number;
  rewards: string[];
  /** Name of the term that is paid at the goal; empty if there is none. */
  success: string;
  readings: Reading[];
  outputs: Output[];
  /** Names of the fields that the agent's sensors read; left out if there are none. */
  fields?: string[];
}

/** A number, boolean or text, or nested arrays of them. */
export type Value = number | boolean | string | Value[];

/** The result of the last decision. */
export interface Outcome {
  episode: number;
  /** Decisions in this episode so far. */
  step: number;
  seq: number;
  tick: number;
  reward: number;
  terms: Record<string, number>;
  terminated: boolean;
  truncated: boolean;
  paused: boolean;
  stopped: boolean;
}

export interface Percept extends Outcome {
  /** Readings by key. */
  values: Record<string, Value>;
}

export interface PerceptMessage extends Outcome {
  type: "percept";
  data: Uint8Array<ArrayBuffer>;
  texts: string[];
}

export interface Problem {
  type: "problem";
  code: string;
  text: string;
  /** Number of the percept that it is about; 0 for none. */
  seq: number;
}

export interface Bye {
  type: "bye";
  reason: string;
}

export type Message = Welcome | PerceptMessage | Problem | Bye;
