/** What a class's server sends to its pages: ai4u_edu/classroom/class_event.py, work_routes.py, join.py. */

import type { Switches } from "../generated/messages.js";

export interface Seat {
  number: number;
  name: string;
  colour: string;
  room: string;
  state: "in" | "left" | "kicked" | "banned";
  is_here: boolean;
}

export interface Room {
  id: string;
  /** Numbers of seats. */
  seats: number[];
  kind: "local" | "remote";
  status: string;
  is_running: boolean;
  scene: string;
  driver: string;
  seconds: number;
  episodes: number;
  falls: number;
  is_solved: boolean;
  error: string;
  /** These five are for the teacher alone. */
  learning?: string;
  is_learning?: boolean;
  help?: number;
  why?: string;
  look_in?: string;
}

/** A network that learned in a room. */
export interface RoomNetwork {
  scene: string;
  /** Number among those of the scene. */
  number: number;
  title: string;
  how: string;
}

export interface Attention {
  kind: "" | "pause" | "blank";
  message: string;
  /** s; 0 for no end */
  ends_in: number;
}

export interface RaceRow {
  name: string;
  colour: string;
  room: string;
  outcome: string;
  seconds: number;
  /** Reason for which it was refused. */
  why?: string;
}

export interface Race {
  id: string;
  phase: "countdown" | "running" | "over";
  starts_in: number;
  /** Its title. */
  scene: string;
  is_board_hidden: boolean;
  board: RaceRow[];
}

/** An entry of a tournament; `seat` is 0 for the scene's own player. */
export interface Entry {
  name: string;
  colour: string;
  seat: number;
}

export interface Standing extends Entry {
  won: number;
  drawn: number;
  lost: number;
  points: number;
  rating: number;
  range: number;
  is_provisional: boolean;
  /** Won, drawn and lost against each entry, in the order of the standings; null if they have not met. */
  against: (Score | null)[];
}

export type Score = [won: number, drawn: number, lost: number];

export interface Game {
  /** 0 without a recording. */
  number: number;
  who: Entry[];
  points: number[];
}

export interface Contest {
  entries: (Entry & { rank: number; points: number })[];
  problem: string;
  has_failed: boolean;
  games: Game[];
}

export interface Results {
  games: number;
  total: number;
  is_race: boolean;
  standings: Standing[];
  latest: Contest[];
  best: Game[];
  refused: (Entry & { reason: string })[];
}

export interface Tournament {
  id: string;
  scene: string;
  title: string;
  phase: "open" | "running" | "over" | "cancelled" | "failed";
  players: number;
  results: Results | null;
  problem?: string;
}

/** A network that a student has handed in. */
export interface Network {
  key: string;
  scene: string;
  part: string;
  file: string;
  verdict: "open" | "right" | "refused";
  reason: string;
}

/** A scene of the library. */
export interface LibraryScene {
  name: string;
  title: string;
  stars: number;
  is_duel: boolean;
  picture: string;
}

export interface Lesson {
  number: string;
  title: string;
  /** Its name in the library; empty for none. */
  scene: string;
}

/** A lesson with the ids of its exercises. */
export interface LessonExercises {
  lesson: string;
  title: string;
  ids: string[];
}

export interface ExerciseProgress {
  state: "tried" | "hint" | "solved";
  tries: number;
  minutes: number;
}

/** A mission of the map. */
export interface MissionTitle {
  name: string;
  title: string;
  island: string;
  steps: number;
  stars: number;
}

/** The step of a mission that a seat is at. */
export interface MissionPlace {
  mission: string;
  title: string;
  /** From 0. */
  step: number;
  steps: number;
  is_done: boolean;
  /** Sentence about what went wrong; empty for none. */
  hint: string;
  /** Time at this step. */
  minutes: number;
}

/** How the program of a seat runs. */
export interface ProgramRun {
  state: "running" | "mistake" | "ended";
  text: string;
  /** 0 for none */
  line: number;
}

/** A mistake that programs made, with words for the teacher. */
export interface ProgramMistake {
  kind: string;
  title: string;
  count: number;
  seats: number[];
  examples: string[];
  guide: string;
}

export interface Misconception {
  exercise: string;
  diagnosis: string;
  count: number;
  seats: number[];
  sentence: string;
  guide: string;
}

/** The state of a class. What may be missing is for the teacher alone; "by seat" is by its number. */
export interface ClassState {
  type: "class";
  code: string;
  address: string;
  /** Address of a picture. */
  qr: string;
  open: boolean;
  problem: string;
  attention: Attention;
  switches: Switches;
  shown: { kind: "join" | "room" | "race" | "tournament" | "game" | "board"; room: string; game: number };
  race: Race | null;
  tournament: Tournament | null;
  scenes: LibraryScene[];
  /** Longest text of a scene file. */
  max_scene_chars: number;
  exercises: LessonExercises[];
  lessons: Lesson[];
  seats: Seat[];
  rooms: Room[];
  handed_in?: { missing: string; networks: (Network & { seat: number })[] };
  /** By seat and exercise. */
  progress?: Record<string, Record<string, ExerciseProgress>>;
  /** By seat and scene. */
  stars?: Record<string, Record<string, number>>;
  /** In the order of the map. */
  missions?: MissionTitle[];
  /** Finished steps and stars, by seat and mission. */
  mission_progress?: Record<string, Record<string, [steps: number, stars: number]>>;
  /** By seat. */
  mission_places?: Record<string, MissionPlace>;
  /** How many are in each mission, and how many of them are stuck; for the projector alone. */
  mission_counts?: { title: string; count: number; stuck: number }[];
  /** By seat. */
  runs?: Record<string, ProgramRun>;
  program_mistakes?: ProgramMistake[];
  misconceptions?: Misconception[];
}

/** A filled disc, or a polygon if the radius is 0. */
export interface Shape {
  colour: string;
  radius: number;
  /** x, y of each corner, or of the disc's centre (m). */
  points: number[];
}

export interface DrawingMessage {
  type: "drawing";
  room: string;
  number: number;
  /** Left, bottom, right, top (m). */
  bounds: [number, number, number, number];
  ground: Shape[];
  bodies: { name: string; is_agent: boolean; shapes: Shape[] }[];
}

/** Poses for a drawing: x, y (m), heading (rad) and visibility of each body in turn. */
export interface Poses {
  drawing: number;
  values: number[];
}

export interface PosesMessage {
  type: "poses";
  rooms: Record<string, Poses>;
}

/** The class as a student's page knows it: ai4u_edu/member/class_view.py. */
export interface ClassEvent {
  type: "class";
  name: string;
  colour: string;
  role: "teacher" | "student";
  people: Person[];
  has_teacher: boolean;
  attention: Attention;
  switches: Switches;
  race: StudentRace | null;
  lesson: string;
  program: StartingProgram | null;
  mission: AssignedMission;
}

/** The mission of an assignment; empty for none. */
export interface AssignedMission {
  mission: string;
  assignment: string;
}

export type Person = Pick<Seat, "number" | "name" | "colour" | "is_here">;

export interface StudentRace extends Pick<Race, "id" | "phase" | "starts_in"> {
  board: Pick<RaceRow, "name" | "colour" | "outcome" | "seconds">[];
  own_best: number | null;
}

/** A program that a teacher gives to begin with; `scene` is empty for any. */
export interface StartingProgram {
  scene: string;
  source: string;
}

/** The latest program of a seat; without a `source` there is nothing else. */
export interface SeatProgram {
  seat: number;
  name: string;
  source: string | null;
  scene?: string;
  agent?: string;
  /** s */
  age?: number;
}

/** A student's program as the class keeps it; without a `source` there is nothing else, and an empty one was deleted. */
export interface KeptProgram {
  source: string | null;
  version?: number;
  is_of_device?: boolean;
}

/** What a student has handed in, and may hand in. */
export interface HandedIn {
  scenes: { name: string; title: string; parts: string[] }[];
  /** Scene of the present tournament; empty for none. */
  scene: string;
  networks: Network[];
  max_bytes: number;
}
