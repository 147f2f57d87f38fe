/** The panel as the tab "Code" and the blocks use it, and what they read of its parts: ai4u_edu/page/panel/parts/. */

import type { Emitter } from "./events.js";

export interface RayLayout {
  /** Angles to the heading, positive to the left; the rightmost ray is first. */
  angles_deg: number[];
  has_code: boolean;
  has_distance: boolean;
  /** Codes of groups by their names. */
  codes: [name: string, code: number][];
  /** Largest distance in the reading: 1, or metres; and the length of a ray (m). */
  reach: number;
  reach_m: number;
}

export interface SensorSlot {
  name: string;
  unit: string;
  /** null for no bound */
  low: number | null;
  high: number | null;
}

/** A sensor as a program reads it. */
export interface ProgramSensor {
  key: string;
  class: string;
  kind: "bool" | "number" | "text";
  unit: string;
  shape: number[];
  stack: number;
  slots: SensorSlot[];
  rays: RayLayout | null;
}

export interface ActionRange {
  name: string;
  low: number;
  high: number;
  has_effect: boolean;
}

/** An actuator as a program names it. */
export interface ProgramActuator {
  name: string;
  is_choice: boolean;
  components: ActionRange[];
}

export interface PythonPart {
  agent: string;
  actuators: ProgramActuator[];
  sensors: ProgramSensor[];
}

export interface SensorReading {
  key: string;
  title: string;
  help: string;
  shape: number[];
  stack: number;
  text?: string;
  values?: { name: string }[];
}

export interface AgentPart {
  id: string;
  sensors: SensorReading[];
}

export interface SceneAgent {
  id: string;
  is_person: boolean;
}

export interface StarGoals {
  count: number;
  /** Most decisions for the third star; null if there is none. */
  few_decisions: number | null;
}

export interface ScenePart {
  scene: string;
  stars: StarGoals | null;
  agents: SceneAgent[];
  can_edit: boolean;
}

export interface RunPart {
  decision: number;
  speed: number | "max";
  is_paused: boolean;
  seed: string;
  result: string;
}

export interface PlayedEpisode {
  step: number;
  steps: number;
  /** Number by which the world counted it; 0 if it was loaded. */
  world_episode: number;
}

export interface PastPart {
  playing: PlayedEpisode | null;
  is_showing: boolean;
}

export interface PanelParts {
  agent: AgentPart;
  past: PastPart;
  python: PythonPart;
  run: RunPart;
  scene: ScenePart;
}

type PartEvents = { [Name in keyof PanelParts as `part:${Name}`]: PanelParts[Name] };

export interface PanelEvents extends PartEvents {
  agent: null;
  connected: null;
  driver: object;
}

export interface CodePanel extends Emitter<PanelEvents> {
  program: { agent: string; episode: number; isTest: boolean } | null;
  hasProgram: boolean;
  driving?: { letGo(): void };
  driver?: { hello: { instead?: string } };
  part<Name extends keyof PanelParts>(name: Name): PanelParts[Name] | null;
  send(command: string, args?: object, options?: { quiet?: boolean }): Promise<{ ok: boolean; text: string }>;
  notice(text: string, level?: string): void;
  dialog(title: string, ...children: HTMLElement[]): { dialog: HTMLDialogElement };
}
