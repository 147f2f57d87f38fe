/**
 * What the panel's socket brings besides the structs of generated/messages.d.ts: answers to commands, the parts of
 * options, and a few messages.
 */

import type { Commands, PanelParts } from "../generated/messages.js";
import type { DriverView } from "../page/driver_status.js";

/** A problem with a value of a form; the path begins with the field's name, and is empty for the whole form. */
export interface Problem {
  path: (string | number)[];
  text: string;
}

/** The answer to a command: ai4u_edu/page/panel/answers.py. */
export interface Answer {
  ok: boolean;
  text: string;
  /** Empty unless a form was refused. */
  problems: Problem[];
  code?: string;
}

/** One number of an action, as it is and as it would be. */
export interface ChangedNumber {
  name: string;
  low: number;
  high: number;
  has_effect: boolean;
  now: number;
  then: number;
}

/** A driver that the agent can have; one with a reason can't be chosen. */
export interface DriverChoice {
  name: string;
  title: string;
  reason: string;
}

export interface GalleryBlock {
  class: string;
  title: string;
  question: string;
  summary: string;
  picture: string;
  /** Reason for which it can't be added; empty if it can. */
  reason: string;
}

/** A driver that can be compared on the chosen episode. */
export interface Rival {
  value: string;
  text: string;
  /** Decisions that a checkpoint of a training learned from; null for another driver. */
  steps: number | null;
}

/** A thing that can be added to the world, with its picture from above. */
export interface PaletteThing {
  name: string;
  title: string;
  /** The picture as a data: address. */
  url: string;
  /** Length of its sides in the world (m). */
  side_m: number;
}

export interface SceneCard {
  name: string;
  title: string;
  goal: string;
  level: string;
  minutes: number;
  /** Most stars that a program earns in it; 0 for none. */
  stars: number;
  picture: string;
  is_saved: boolean;
}

/** Where two drivers first disagree; `step` is null if they agree everywhere. */
export interface DriverComparison {
  step: number | null;
  count: number;
  distance: number[];
  largest: number;
  action: ChangedNumber[];
  first: string;
  second: string;
}

export interface PaidMoment {
  step: number;
  terms: { term: string; amount: number }[];
}

export interface PaidCurve {
  term: string;
  total: number;
  curve: number[];
}

/** One number of the percept that can be changed. */
export interface Dial {
  key: string;
  index: number;
  name: string;
  value: number;
  low: number;
  high: number;
}

export interface StandingPose {
  x: number;
  y: number;
  heading_deg: number;
}

/** The next call of an exercise's function, as JSON; or the verdict, if there is none. */
export interface FunctionCall {
  arguments: string;
  passed: boolean;
  text: string;
  hint: string;
}

/** Further fields of the answers to commands that were carried out. */
export interface AnswerFields {
  add_block: { path: (string | number)[] };
  add_body: { bodies: string[] };
  compare: DriverComparison;
  download: { file: string; content: string };
  drivers: { items: DriverChoice[] };
  duplicate_block: { path: (string | number)[] };
  duplicate: { bodies: string[] };
  elsewhere: StandingPose & { can_stand: boolean; action: ChangedNumber[] };
  gallery: { items: GalleryBlock[] };
  find_things: { names: string[] };
  ground: { matrix: number[] };
  mission_judge: FunctionCall;
  mission_returned: FunctionCall;
  lay_picture: { bodies: string[] };
  move_block: { path: (string | number)[] };
  open_recording: { number: number };
  paste: { bodies: string[] };
  palette: { items: PaletteThing[] };
  paid: { terms: PaidCurve[]; moments: PaidMoment[] };
  rivals: { rivals: Rival[] };
  scenes: { items: SceneCard[] };
  teach_download: { name: string; data: string };
  teach_download_tried: { name: string; data: string };
  teach_try_program: { values: number[] };
  what_if: { dials: Dial[]; action: ChangedNumber[] };
}

/** The answer to a command; its further fields are missing in one that failed. */
export type AnswerTo<Name extends keyof Commands> = Name extends keyof AnswerFields ? Answer & Partial<AnswerFields[Name]> : Answer;

/** A number, or several, of the percept, and how far it moves each number of the action (share of its range). */
export interface ExplainedSlot {
  key: string;
  name: string;
  sees: string;
  share: number;
  shares: number[];
}

/** An explanation of an agent's action: ai4u_edu/explain_page/option.py. */
export interface WhyPart {
  type: "part";
  name: "why";
  agent: string;
  problem: string;
  sentence: string;
  baseline: string;
  also: string;
  explained: string;
  limits: string;
  /** Names of the numbers of the action. */
  components: string[];
  slots: ExplainedSlot[];
  /** The slots that matter most, the first one most. */
  top: ExplainedSlot[];
}

export interface MapProgress {
  done: number;
  count: number;
  /** World time (s) of the world that it was made in. */
  seconds: number;
}

export interface ValueMap extends MapProgress {
  /** null before any value is known */
  low: number | null;
  high: number | null;
  words: string;
  /** As CSS has them, from the lowest value on. */
  colours: string[];
}

/** The state of an agent's maps; null for one of which nothing is known yet. */
export interface MapsPart {
  type: "part";
  name: "maps";
  agent: string;
  problem: string;
  /** Things that the agent could look at from each place. */
  faced: string[];
  field: MapProgress | null;
  values: ValueMap | null;
}

/** The tabs that options bring. */
export interface TabsPart {
  type: "part";
  name: "tabs";
  tabs: { name: string; title: string }[];
}

/** All parts by name. */
export interface Parts extends PanelParts {
  maps: MapsPart;
  tabs: TabsPart;
  why: WhyPart;
}

export interface NoteMessage {
  type: "note";
  level: "info" | "error";
  text: string;
}

/** Somebody clicked on a body in the page's picture. */
export interface SelectedMessage {
  type: "selected";
  body: string;
  agent: string;
}

/** Somebody drags the outline of the agent in the page's picture. */
export interface StandInMessage extends StandingPose {
  type: "stand_in";
}

/** What comes over the panel's socket, besides answers. */
export type PanelMessage = Parts[keyof Parts] | NoteMessage | SelectedMessage | StandInMessage;

export interface DoneMessage extends Partial<Answer> {
  type: "done";
  id: number;
}

export interface FailedMessage extends Partial<Answer> {
  type: "failed";
  id: number;
}

type PartEvents = { [Name in keyof Parts as `part:${Name}`]: Parts[Name] };

export interface PanelEvents extends PartEvents {
  agent: null;
  connected: null;
  details: null;
  disconnected: null;
  driver: DriverView;
  selected: SelectedMessage;
  shown: null;
  stand_in: StandInMessage;
  thought: null;
  /** Another tab is open, or the panel was folded or opened. */
  tab: null;
  /** The program in the tab "Code" is written in blocks now, or in Python. */
  way: null;
}
