/** The messages between a page and its world. Made by python -m tests.web_messages --write */

/** The state of the script that drives an agent. */
export interface ScriptState {
  state: "connected" | "late" | "lost" | "waiting";
  /** The reason why it is not driving; empty if it is. */
  reason: string;
  /** A sentence about what had no effect lately; empty if all had. */
  warning: string;
  /** Counts that are not 0, by name: decisions, missing, ignored, refused, clipped, warnings. */
  counts: Record<string, number>;
}

/** A picture of a reading, with a pixel for each cell. */
export interface ReadingPicture {
  rows: number;
  columns: number;
  /** Address of the picture: a PNG as a `data:` URL. */
  cells: string;
  /** Its subject; `earlier` for an older reading, empty for the groups in its cells. */
  caption: string;
}

/** One number of a reading. */
export interface ReadingLine {
  name: string;
  /** The number, with four decimals; null if it is not finite. */
  value: number | null;
  /** The number as text. */
  text: string;
  /** Its unit; empty if it is normalized, or has none. */
  unit: string;
  /** Lower bound; null if it has none. */
  low: number | null;
  /** Upper bound; null if it has none. */
  high: number | null;
  /** False for a number below its range, which stands for "not visible". */
  is_seen: boolean;
  /** Its older values, oldest first; left out if readings are not stacked. */
  older?: number[];
}

/** Many numbers as bars side by side, left to right. */
export interface ReadingStrip {
  caption: string;
  /** Position of zero in the range of each number, 0 to 1. */
  zeros: number[];
  /** Position of each number in its range, 0 to 1. */
  shares: number[];
  /** Colour of each bar as CSS has it; null for one colour. */
  colours: string[] | null;
  /** Positions of older readings, oldest first. */
  older: number[][];
}

/** A sensor and its reading: one of `pictures`, `text`, `values` and `strips`. */
export interface SensorReading {
  /** Its perception key. */
  key: string;
  title: string;
  /** Name of its class. */
  class: string;
  /** Name of its icon, as in `web/shared/icons.js`. */
  icon: string;
  /** A short sentence about it. */
  help: string;
  /** Shape of the reading; empty for a single value. */
  shape: number[];
  /** Number of stacked readings, oldest first. */
  stack: number;
  pictures?: ReadingPicture[];
  text?: string;
  values?: ReadingLine[];
  strips?: ReadingStrip[];
  /** True if the page's picture can show it. */
  is_drawable: boolean;
  /** True if the page's picture shows it. */
  is_shown: boolean;
}

/** The present level of a need, such as energy. */
export interface NeedLevel {
  name: string;
  level: number;
  /** Lowest possible level. */
  low: number;
  /** Highest possible level. */
  high: number;
  /** Bounds of the comfort zone. */
  comfort: [number, number];
  /** Side on which the level is out of the comfort zone; empty if it is in there. */
  state: "" | "high" | "low";
}

/** One number of an action. For an action that fits no actuator, only `actuator`, `name` and `value` are there. */
export interface ActionNumber {
  /** Name of the actuator. */
  actuator: string;
  /** Title of the actuator. */
  title?: string;
  /** Name of the actuator's class. */
  class?: string;
  name: string;
  value: number;
  low?: number;
  high?: number;
  /** True if the number is one of several discrete choices. */
  is_choice?: boolean;
  /** False if it does nothing with the actuator's parameters, as a jump of power 0. */
  has_effect?: boolean;
}

/** A reward term. */
export interface RewardRow {
  term: string;
  /** Amount in the last finished decision. */
  decision: number;
  /** Sum in the episode so far. */
  episode: number;
}

/** The amount that one reward term paid in one decision. */
export interface PaidTerm {
  term: string;
  amount: number;
}

/** The rewards of one decision. */
export interface PaidDecision {
  /** Number of the decision in its episode, from 1. */
  decision: number;
  /** The terms that are not 0. */
  terms: PaidTerm[];
  total: number;
}

/** The progress of an agent's decision: sense, decide, act for some ticks, reward. */
export interface DecisionPhases {
  /** Ticks of the decision that are listed one by one. */
  ticks: number;
  /** Ticks of the decision. */
  all_ticks: number;
  /** Ticks that have passed; null while the world runs too fast to see them. */
  tick: number | null;
  /** The present phase; empty while the world runs too fast to see it. */
  now: "" | "act" | "reward" | "sense";
  /** True if the actuators act at every tick, False if only at the first. */
  repeats: boolean;
  /** Duration of the decision (s). */
  seconds: number;
}

/** One of several agents. */
export interface AgentSummary {
  id: string;
  title: string;
  /** Colour of its body as CSS has it. */
  colour: string;
  /** Episodes that it has begun. */
  episode: number;
  /** Decisions in its episode so far. */
  decision: number;
  /** Reward in its episode so far. */
  score: number;
  /** The end of its episode in a few words; empty while it runs. */
  state: string;
}

/** An agent's readings, action and rewards. */
export interface AgentPart {
  type: "part";
  name: "agent";
  id: string;
  title: string;
  /** Name of its driver, as in the command `driver`; empty if it can't be changed. */
  driver: string;
  /** Title of its brain. */
  brain: string;
  /** The end of its episode in a few words; empty while it runs. */
  state: string;
  /** The problem with the script that should drive it; empty if there is none. */
  problem: string;
  /** The script that drives it; null if none does. */
  script: ScriptState | null;
  /** Numbers of actions so far that were out of range and clipped. */
  clipped: number;
  sensors: SensorReading[];
  needs: NeedLevel[];
  /** The last action. */
  action: ActionNumber[];
  /** Reward of the last finished decision. */
  reward: number;
  rewards: RewardRow[];
  /** The latest decisions with a reward, the latest first. */
  paid: PaidDecision[];
  phases: DecisionPhases;
  /** All agents, if there are several. */
  others: AgentSummary[];
}

/** Something that can be added to a block: one of a kind of the gallery, or of one class. */
export interface BlockAddition {
  title: string;
  /** Kind of the gallery from which one is chosen. */
  kind?: "actuators" | "brains" | "rewards" | "sensors";
  /** Class of what is added, if there is but one. */
  class?: string;
  /** Path of the list that it is added to. */
  parent: (string | number)[];
}

/** A block of an agent. */
export interface BlockRow {
  /** Names and indices that lead to it from the agent. */
  path: (string | number)[];
  /** Name in the percept, the action or the rewards; empty if it has none. */
  name: string;
  title: string;
  /** Name of its class. */
  class: string;
  /** Name of its icon, as in `web/shared/icons.js`. */
  icon: string;
  /** Its most important parameters in a few words. */
  reads: string;
  /** False if it is switched off. */
  is_on: boolean;
  can_switch: boolean;
  can_up: boolean;
  can_down: boolean;
  can_remove: boolean;
  /** Blocks that it holds. */
  children: BlockRow[];
  /** Things that can be added to it. */
  adds: BlockAddition[];
}

/** A field of a form. */
export interface FormField {
  /** Name of the parameter, as in the values of a command. */
  name: string;
  label: string;
  /** Kind of its control; `whole` is a whole number, `data` JSON. */
  kind: "choice" | "data" | "number" | "switch" | "text" | "whole";
  /** The present value. */
  value: unknown;
  /** The present value as text in an input, or as one of the choices. */
  shown: string;
  /** A short sentence about it. */
  hint: string;
  /** The meaning of the parameter in the words of its class, with its range. */
  detail: string;
  /** Values to choose from, for the kind `choice`; else suggestions. */
  choices: string[];
  /** Words for these values in the reader's language. */
  words: string[];
  /** True if every block of the kind has it. */
  is_common: boolean;
  /** True for the few fields that matter most. */
  is_first: boolean;
  /** Unit of a number; empty if it has none. */
  unit: string;
  /** Lower bound of a number; null if it has none. */
  low: number | null;
  /** Upper bound of a number; null if it has none. */
  high: number | null;
}

/** The form of one block. */
export interface BlockForm {
  path: (string | number)[];
  title: string;
  class: string;
  /** Name of its icon, as in `web/shared/icons.js`. */
  icon: string;
  /** The question that it answers. */
  question: string;
  /** A short sentence about it. */
  summary: string;
  /** The first sentence of its class's docstring. */
  detail: string;
  fields: FormField[];
}

/** A change that can be undone, or made again. */
export interface UndoLabel {
  /** The change in words; empty if there is none. */
  label: string;
}

/** An agent's blocks. */
export interface BlocksPart {
  type: "part";
  name: "blocks";
  /** Id of the agent. */
  agent: string;
  /** Name of its present driver. */
  driver: string;
  /** Blocks by kind: `sensors`, `actuators`, `rewards` and `brains`. */
  kinds: Record<string, BlockRow[]>;
  /** Form of the agent itself. */
  settings: FormField[];
  /** Form of the chosen block; null if there is none. */
  form: BlockForm | null;
  /** The change that undo takes back. */
  undo: UndoLabel;
  /** The change that redo makes again. */
  redo: UndoLabel;
  /** True if a change takes effect in the next episode. */
  waits_for_reset: boolean;
}

/** The rewards of an agent's episode so far. */
export interface CurvePart {
  type: "part";
  name: "curve";
  /** Id of the agent. */
  agent: string;
  /** Number, reward and sum so far of each decision, oldest first. */
  points: [number, number, number][];
}

/** A question of a step. */
export interface MissionQuestion {
  text: string;
  /** Answers to choose from; empty if a number has to be typed. */
  options: string[];
}

/** A function to write, which the page calls and the room judges; or a robot to build. */
export interface MissionExercise {
  id: string;
  /** Its name; empty for a robot. */
  function: string;
  /** Program to begin with. */
  text: string;
}

/** A star of a mission. */
export interface MissionStar {
  text: string;
  is_earned: boolean;
}

/** The mission that the page shows. */
export interface MissionPart {
  type: "part";
  name: "mission";
  /** Its name; empty if the page shows none. */
  mission: string;
  title: string;
  island: string;
  /** Name of its scene. */
  scene: string;
  scene_title: string;
  /** False if the world has another scene. */
  is_here: boolean;
  /** The present step, from 0. */
  step: number;
  /** Number of steps. */
  steps: number;
  /** The sentence about what to do; what stands in stars is bold. */
  say: string;
  /** Names of controls; the last one that can be seen is lit. */
  light: string[];
  /** True if the step is done. */
  is_done: boolean;
  /** The sentence about what happened; empty before the step is done. */
  done: string;
  /** Progress of the step in words; empty if there is nothing to say. */
  words: string;
  /** Sentence about what went wrong; empty if nothing did. */
  hint: string;
  /** Hints in this step so far. */
  hints: number;
  /** Sentence about another driver than the step asks for; empty if there is none. */
  driver: string;
  question: MissionQuestion | null;
  exercise: MissionExercise | null;
  /** The first one is for doing the mission. */
  stars: MissionStar[];
  /** Name of the mission that follows; empty after the last one. */
  next: string;
  next_title: string;
}

/** A recorded episode that is kept. */
export interface KeptEpisode {
  /** Number from 1, in order of arrival; never reused. */
  number: number;
  /** Title of its scene. */
  scene: string;
  /** True if its scene is the one that runs now. */
  is_here: boolean;
  /** Address of a picture of its start, relative to the page. */
  picture: string;
  /** Title of the driver, or the file that it was loaded from. */
  driver: string;
  /** True if a person took most decisions, by keys. */
  is_person: boolean;
  /** Its end: an agent reached the goal, the one that acts first fell, or the time was up. */
  end: "fell" | "goal" | "over" | "time";
  /** Sum of the rewards of the agent that acts first. */
  reward: number;
  /** Decisions of the agent that acts first. */
  decisions: number;
  /** Duration (s) in world time. */
  seconds: number;
  /** Its seed, a whole number as text. */
  seed: string;
  /** True if it is kept however many others come. */
  is_pinned: boolean;
  /** True for the best of its scene. */
  is_best: boolean;
  /** The file that it was loaded from; empty if it was recorded here. */
  source: string;
}

/** The chosen episode, and the state of the player. */
export interface PlayedEpisode {
  /** Its number; 0 for the one that runs. */
  number: number;
  /** Title of its scene. */
  scene: string;
  /** True if its scene is the one that runs now. */
  is_here: boolean;
  /** The decision that is shown, from 0. */
  step: number;
  /** The last decision that can be shown. */
  steps: number;
  /** Number by which the world counted it; 0 if it was loaded. */
  world_episode: number;
  is_playing: boolean;
  /** Speed of playing; 1 is the recorded speed. */
  speed: number;
}

/** A file of the chosen episode to download. */
export interface DownloadLink {
  /** Extension of the file. */
  format: string;
  title: string;
  /** Address, relative to the page. */
  url: string;
}

/** The kept episodes, and the state of the player. */
export interface PastPart {
  type: "part";
  name: "past";
  /** The kept episodes, the latest first. */
  episodes: KeptEpisode[];
  /** The chosen episode; null if none is, or nothing of it can be shown yet. */
  playing: PlayedEpisode | null;
  /** True if pages see a moment of the past. */
  is_showing: boolean;
  /** Label of that moment; empty for the present. */
  shown: string;
  /** State of the race against a ghost, as a sentence; empty without one. */
  ghost: string;
  /** The reason why an episode could not be recorded, kept or replayed; empty if all went well. */
  problem: string;
  /** Files of the chosen episode; empty if none is chosen. */
  downloads: DownloadLink[];
  /** Size of a recording at most. */
  max_recording_bytes: number;
}

/** The range of one number of an action. */
export interface ActionRange {
  /** Its name; empty if it has none. */
  name: string;
  low: number;
  high: number;
  /** False if it does nothing with the actuator's parameters, as a jump of power 0. */
  has_effect: boolean;
}

/** An actuator as a program names it. */
export interface ProgramActuator {
  name: string;
  /** True if its number is one of several discrete choices. */
  is_choice: boolean;
  components: ActionRange[];
}

/** One number of a reading. */
export interface SensorSlot {
  /** Its name; empty if it is the only one and has none. */
  name: string;
  /** Its unit; empty if it is normalized, or has none. */
  unit: string;
  /** Lower bound; null if it has none. */
  low: number | null;
  /** Upper bound; null if it has none. */
  high: number | null;
}

/** The order of the numbers that a flat fan of rays reads. */
export interface RayLayout {
  /** Angle of each ray from the heading, positive to the left; the rightmost ray is first. */
  angles_deg: number[];
  /** True if a ray reads the code of what it hits; it comes before the distance. */
  has_code: boolean;
  /** True if a ray reads the distance to what it hits; 0 if it hits nothing. */
  has_distance: boolean;
  /** Name of each group, and its code in the reading. */
  codes: [string, number][];
  /** Largest distance in the reading: 1, or metres. */
  reach: number;
  /** Length of a ray, metres. */
  reach_m: number;
}

/** A sensor as a program reads it. */
export interface ProgramSensor {
  /** Its perception key. */
  key: string;
  title: string;
  /** Name of its class. */
  class: string;
  kind: "bool" | "number" | "text";
  /** Unit of the reading; empty if it is normalized, or has none. */
  unit: string;
  /** Shape of the reading; empty for a single value. */
  shape: number[];
  /** Number of stacked readings, oldest first. */
  stack: number;
  /** Its numbers; empty if there are too many of them, or several axes. */
  slots: SensorSlot[];
  /** Order of the numbers of a flat fan of rays; null for another sensor. */
  rays: RayLayout | null;
}

/** The code that drives an agent from a notebook, and what a program can name. */
export interface PythonPart {
  type: "part";
  name: "python";
  /** Id of the agent. */
  agent: string;
  /** The code; empty if the agent has gone. */
  lines: string;
  actuators: ProgramActuator[];
  sensors: ProgramSensor[];
}

/** A stage on the way to the goal, or several of them in one line. */
export interface Stage {
  /** Its number, or how many of how many are done. */
  title: string;
  is_done: boolean;
  /** True for the stage that comes next. */
  is_now: boolean;
}

/** The state of the episode, for a page that shows an agent. */
export interface RunPart {
  type: "part";
  name: "run";
  /** Number of the episode, from 1; the agent's own once it has begun more than one alone. */
  episode: number;
  /** Decisions of the agent in the episode so far. */
  decision: number;
  /** Time of the episode (s); it stops at the episode's end. */
  time_s: number;
  /** Wanted time scale; 1 is real time. */
  speed: number | "max";
  /** Measured time scale. */
  real_speed: number;
  is_paused: boolean;
  /** `key` while the world waits for a person to press a key, `teacher` while a teacher holds it; empty otherwise. */
  waiting: string;
  /** Label of the moment of the past that is shown; empty for the present. */
  past: string;
  /** Seed of the episode, a whole number as text: JavaScript rounds those above 2**53. */
  seed: string;
  /** True if each reset repeats the seed. */
  is_seed_locked: boolean;
  /** Reward of the agent in the episode so far. */
  score: number;
  /** Stages on the way to the goal, in order. */
  stages: Stage[];
  /** World time (s) to the end by the step limit; null without a limit. */
  seconds_left: number | null;
  /** End of the agent's episode: `goal`, `won`, `lost`, `fell`, `time` or `over`. It is empty before. */
  result: string;
  /** The end of the agent's episode as a short sentence; empty while it runs. */
  result_text: string;
  /** The state of the world as a short sentence. */
  status: string;
  /** Warning about a slow tick; empty if there was none lately. */
  slow: string;
  /** Sentence about the error that stopped the world; empty if none did. */
  error: string;
  /** Sentence about a block that does not return; empty if all do. */
  stall: string;
}

/** The goals of a scene: reach it once; from ten unseen starts; and in few decisions. */
export interface StarGoals {
  /** 0 in a scene without `success`, 2 where the goal takes a fixed time, or 3. */
  count: number;
  /** Most decisions for the third star, on average over the ten starts. */
  few_decisions: number | null;
}

/** A colour of the legend. */
export interface LegendColour {
  /** Names of the groups that have it. */
  name: string;
  /** The colour as CSS has it. */
  colour: string;
}

/** An agent of the scene. */
export interface SceneAgent {
  id: string;
  /** Name of its body. */
  body: string;
  title: string;
  /** Colour of its body as CSS has it. */
  colour: string;
  /** Title of what drives it; empty while another world is being opened. */
  driver: string;
  /** True if a person drives it by keys. */
  is_person: boolean;
}

/** The scene's texts, the legend of its groups, and its agents. */
export interface ScenePart {
  type: "part";
  name: "scene";
  /** Name of the scene that runs now; empty without an editor. */
  scene: string;
  /** Title of the scene that is shown, which may be that of a recorded episode. */
  title: string;
  /** Its goal in words. */
  goal: string;
  /** A key of its task, under which a page keeps best times; empty without an editor. */
  key: string;
  can_edit_goal: boolean;
  /** Its controls in words. */
  controls: string;
  /** Its rewards in words. */
  rewards: string;
  /** Goals for programs; null in a scene that has none. */
  stars: StarGoals | null;
  legend: LegendColour[];
  agents: SceneAgent[];
  /** False if the world can only be watched and driven. */
  can_edit: boolean;
  /** True if episodes are recorded. */
  has_past: boolean;
  /** The change that undo takes back; left out without an editor. */
  undo?: UndoLabel;
  /** The change that redo makes again; left out without an editor. */
  redo?: UndoLabel;
  /** True if a change takes effect in the next episode; left out without an editor. */
  waits_for_reset?: boolean;
}

/** A person's finished drive of the agent. */
export interface TaughtDrive {
  /** Number among those of its scene. */
  number: number;
  /** True if an agent reached the goal; null for a scene without a goal. */
  result: boolean | null;
  /** Duration (s) in world time. */
  seconds: number;
  /** Decisions that the person took. */
  decisions: number;
  /** Share of the agent's decisions that the person took, above 0, up to 1. */
  share: number;
  /** Reason why the agent can't learn from it, in a few words; empty if it can. */
  reason: string;
}

/** State of the latest learning of the agent. */
export interface LearningState {
  /** True once it is done, has failed or was stopped. */
  is_over: boolean;
  /** Sentence about why it brought nothing; empty if it is under way or done. */
  problem: string;
  /** Sentence about what it waits for; empty if it learns or is over. */
  waiting: string;
  /** Errors on held-out moments, at equal distances of gradient steps. */
  errors: number[];
  /** Drives that it learns from. */
  drives: number;
  /** Decisions that it learned from; 0 until it is done. */
  decisions: number;
  /** Share of held-out moments in which the network acts like the person. */
  alike: number;
  /** The same share for always doing what was done most often. */
  commonest: number;
  /** Sentences about what is wrong with the drives. */
  remarks: string[];
}

/** State of the latest practice. */
export interface PracticeState {
  phase: "over" | "paused" | "running";
  /** Sentence about why it ended early; empty if it did not. */
  problem: string;
  /** Sentence about what it waits for; empty if it learns, is paused or over. */
  waiting: string;
  /** Agent and scene, if they are not what the page shows; empty otherwise. */
  elsewhere: string;
  /** True if the scene was changed since; it goes on in the scene as it was. */
  is_scene_changed: boolean;
  /** Sentence about what to change if it gets no better; empty if it does. */
  hint: string;
  /** Time (s) until it ends at the latest; null before its first check. */
  seconds_left: number | null;
  /** Decisions that it has learned from. */
  decisions: number;
  /** Decisions after which it ends at the latest. */
  total: number;
  /** Mean reward of an episode, by the weights, at each check. */
  rewards: number[];
  /** Share of the episodes of the latest check that reached the goal; null if there was none. */
  success: number | null;
  /** Way from easy starts (0) to all starts (1); null in a scene without easy ones. */
  easy_starts: number | null;
  /** True if these episodes are games against somebody. */
  is_game: boolean;
}

/** Starts from which a network reaches the goal. */
export interface NetworkScore {
  successes: number;
  starts: number;
  /** True if the scene has no other starts. */
  has_all: boolean;
  /** Lower end of the 95% confidence interval of the share; the share itself for all starts. */
  low: number;
  high: number;
}

/** A network that learned in this scene. */
export interface TaughtNetwork {
  /** Number among those of its scene. */
  number: number;
  title: string;
  /** Sentence about how it learned. */
  how: string;
  /** Time (s since 1970) at which it was kept; 0 if it is not known. */
  made_at: number;
  /** Sentences about its rewards, drives and settings. */
  facts: string[];
  /** Decisions of its practice after which an episode was kept, ascending. */
  replays: number[];
  /** Starts from which it reaches the goal; null if that is not known. */
  score: NetworkScore | null;
  /** True if it drives the agent now. */
  is_driving: boolean;
}

/** Drives that an agent can learn from, and its networks. */
export interface TeachPart {
  type: "part";
  name: "teach";
  /** Id of the agent that the page shows. */
  agent: string;
  /** Sentence about why the agent can't be taught; empty if it can. */
  problem: string;
  /** A person's finished drives of the agent, the latest first. */
  drives: TaughtDrive[];
  /** The latest learning of the agent; null if there was none since the start. */
  learning: LearningState | null;
  /** Names of the agent's reward terms. */
  rewards: string[];
  /** Possible players of the other side in a practice; empty in a scene without one. */
  opponents: ("file" | "player" | "self")[];
  /** The practice that runs or is paused, or the agent's latest one; null if there is none. */
  practice: PracticeState | null;
  /** Decisions that such a practice learns from in a second; null before the first check. */
  decisions_per_s: number | null;
  /** Networks of this scene, the latest first. */
  networks: TaughtNetwork[];
  /** Networks that are kept for a scene. */
  max_networks: number;
  /** Size of a network's file at most. */
  max_network_bytes: number;
  /** Sentence about the file that is being opened; empty if none is. */
  opening: string;
  /** Sentence about why a drive could not be kept; empty if all could. */
  warning: string;
}

/** The progress of a training, and its learning curve. */
export interface TrainingPart {
  type: "part";
  name: "training";
  /** The progress as a sentence. */
  text: string;
  /** True once the finished policy drives. */
  is_over: boolean;
  /** Decisions learned from so far, as a share of all; 0 to 1. */
  share: number;
  /** The learning curve: decisions, mean reward, and share of successes (0 to 1) or null. */
  points: [number, number, number | null][];
}

/** A number that can be varied. */
export interface VariableNumber {
  name: string;
  /** Block, agent or thing that has it, in words. */
  owner: string;
  /** Name of the number in words, with its unit. */
  label: string;
  /** Its present value; null if it has none. */
  value: number | null;
  /** Its range in words; empty if it has none. */
  limits: string;
}

/** Result of the episodes with one value of a parameter. */
export interface TriedValue {
  value: number;
  episodes: number;
  /** Episodes that reached the goal; None in a scene without a goal. */
  successes: number | null;
  /** Lower end of the 95% confidence interval of the share of successes. */
  low: number | null;
  high: number | null;
  /** Mean reward of an episode. */
  reward: number;
  /** Mean duration (s) of an episode in world time. */
  seconds: number;
  /** Mean number of decisions of an episode. */
  decisions: number;
}

/** State of the latest tries of the agent. */
export interface TriesState {
  is_over: boolean;
  /** Sentence about why they ended early; empty if they did not. */
  problem: string;
  /** Sentence about what they wait for; empty if the driver drives or they are over. */
  waiting: string;
  /** The number in words. */
  label: string;
  /** Episodes that were driven. */
  done: number;
  /** Episodes with all values. */
  total: number;
  /** Results of the values that are done. */
  rows: TriedValue[];
}

/** Numbers that can be varied, and what came of it. */
export interface TriesPart {
  type: "part";
  name: "tries";
  /** Id of the agent that the page shows. */
  agent: string;
  /** Sentence about why its driver can't be tried; empty if it can. */
  problem: string;
  numbers: VariableNumber[];
  /** The latest tries of the agent in this scene; null if there were none since the start. */
  tries: TriesState | null;
  max_starts: number;
  /** Most episodes, with all values, of a program in the page. */
  max_program_episodes: number;
}

/** The choices for the page's picture. */
export interface ViewPart {
  type: "part";
  name: "view";
  /** Position of the camera. */
  camera: "arena" | "eyes" | "follow" | "tilted" | "turn";
  /** True if the trail of the agent that is shown is drawn. */
  has_trail: boolean;
  /** State of the short tilt of the camera with which the page opens. */
  opening: "ending" | "none" | "over" | "running";
}

/** A network that can drive. */
export interface WatchableNetwork {
  /** Name of the driver. */
  name: string;
  title: string;
}

/** A race against a ghost, which has finished already. */
export interface NetworkRace {
  /** The ghost: the network's, or that of a person's drive against which the network races. */
  ghost: "drive" | "network";
  /** Seed of the start, a whole number as text; an episode with another one is no race. */
  seed: string;
  /** True if the ghost reached the goal; null in a scene without a goal. */
  is_won: boolean | null;
  /** Time (s) that the ghost takes. */
  seconds: number;
  /** Time (s) that it took at its full speed: less where it is slowed, so that keys can win. */
  full_speed_s: number;
  /** Reward of the ghost's agent. */
  score: number;
}

/** The networks that can drive the page's agent, and the one that is watched. */
export interface WatchPart {
  type: "part";
  name: "watch";
  agent: string;
  /** Networks of the scene, and a person's own; the first one is the usual choice. */
  networks: WatchableNetwork[];
  /** Name of the network that drives for a while; empty for none. */
  watching: string;
  /** True if a drive of a person is kept against which the network can race. */
  has_drive: boolean;
  /** The race that pages see; null for none. */
  race: NetworkRace | null;
}

/** A body, floor or area of the scene. */
export interface SceneThing {
  name: string;
  /** `agent`, `lamp`, `body`, `floor`, `area` or `picture`. */
  kind: string;
  /** Id of the agent whose body it is; null if it is nobody's. */
  agent: string | null;
  /** Type of its shape, such as `box`. */
  shape: string;
  /** Position (m) in the scene's file. */
  x: number;
  y: number;
  /** Heading (degrees) in the scene's file, from the x axis counterclockwise. */
  heading: number;
  /** True for a body that physics moves. */
  movable: boolean;
  /** Name of its colour; null for the colour of its kind. */
  colour: string | null;
  /** Text on it. */
  label: string | null;
  /** True if each episode draws a place for it, or chooses one. */
  is_random: boolean;
}

/** The form of one thing. */
export interface ThingForm {
  name: string;
  /** Kind of the thing, as in its row. */
  kind: string;
  fields: FormField[];
}

/** A scene that somebody changed and did not save. */
export interface UnsavedScene {
  name: string;
  /** Time of the last change, in words. */
  when: string;
}

/** The things of the scene, and the form of the selected one. */
export interface WorldPart {
  type: "part";
  name: "world";
  /** Title of the scene. */
  title: string;
  /** Bodies, floors and areas, the latest first. */
  bodies: SceneThing[];
  /** Form of the selected thing; null if there is none. */
  form: ThingForm | null;
  /** Form of the scene itself. */
  settings: FormField[];
  /** Form of the field that is generated at each start. */
  field: FormField[];
  /** A scene that can be restored; null if there is none. */
  unsaved: UnsavedScene | null;
  /** The reason why the scene is not kept while it is changed; empty if it is. */
  problem: string;
  /** True if scenes can be saved here; else they are downloaded. */
  can_save: boolean;
  /** True if the scene is kept while it is changed. */
  is_autosaved: boolean;
  /** True while somebody drags a thing. */
  is_dragging: boolean;
  /** True if this page moves things with the mouse. */
  is_move_mode: boolean;
  /** Grid (m) to which moved things snap; 0 for none. */
  snap: number;
  /** The change that undo takes back. */
  undo: UndoLabel;
  /** The change that redo makes again. */
  redo: UndoLabel;
  /** True if a change takes effect in the next episode. */
  waits_for_reset: boolean;
  /** Size of a scene file at most. */
  max_scene_bytes: number;
  /** Size of a picture for the ground at most. */
  max_picture_bytes: number;
}

/** The parts of the panel by name. */
export interface PanelParts {
  agent: AgentPart;
  blocks: BlocksPart;
  curve: CurvePart;
  mission: MissionPart;
  past: PastPart;
  python: PythonPart;
  run: RunPart;
  scene: ScenePart;
  teach: TeachPart;
  training: TrainingPart;
  tries: TriesPart;
  view: ViewPart;
  watch: WatchPart;
  world: WorldPart;
}

/** An error in words: of the page's message, or of the world. */
export interface ErrorEvent {
  type: "error";
  text: string;
}

/** The page's number, its agent, and the keys that drive the agent. */
export interface HelloEvent {
  type: "hello";
  /** Number of the page. */
  you: number;
  /** Id of its agent. */
  agent: string;
  /** Name of the agent's body. */
  name: string;
  /** Title of the agent's brain. */
  brain: string;
  /** Codes of physical keys by action, without those for actions that the body can't do. */
  keys: Record<string, string[]>;
  /** Labels of actions that do something else in this scene than their name says. */
  captions: Record<string, string>;
  /** True if it is driven by a stick, too. */
  stick: boolean;
  /** Title of the network or script that drives the agent now; empty if a person may. */
  others: string;
  /** Title of what drives it once the person lets go; empty if nothing does. */
  instead: string;
  /** True if a network drives the agent now. */
  is_network: boolean;
}

/** The page that drives the agent. */
export interface SeatEvent {
  type: "seat";
  /** Number of the page that drives; null if none does. */
  driver: number | null;
  /** Count of the pages at this agent. */
  pages: number;
  /** Number of the seat of a class at which the driving page is; left out if it is at none. */
  seat?: number;
}

/** The state of the world and of the page's agent. */
export interface StateEvent {
  type: "state";
  paused: boolean;
  /** `key` while the world waits for a person to press a key, `teacher` while a teacher holds it; empty otherwise. */
  waiting: string;
  /** Label of the moment of the past that is shown; empty for the present. */
  past: string;
  /** Sentence about the error that stopped the world; empty if none did. */
  error: string;
  /** Number of the world's episode. */
  episode: number;
  /** Episodes that the agent has begun, alone or with the world. */
  agent_episode: number;
  /** True if each reset repeats the seed. */
  seed_locked: boolean;
  /** True if the agent's episode ended by what happened in it. */
  terminated: boolean;
  /** True if the agent's episode ended by the step limit. */
  truncated: boolean;
  /** True if its body has fallen off the floor. */
  fallen: boolean;
  /** Title of the scene. */
  title: string;
  /** Goal of the scene in words. */
  goal: string;
  /** End of the agent's episode: `goal`, `won`, `lost`, `fell`, `time` or `over`. It is empty before. */
  outcome: string;
  /** Time (s) of an episode that is over; null before, since it would change at each tick. */
  seconds: number | null;
  /** Reward of the agent in the episode; null if it is not finite. */
  reward: number | null;
  /** The same by reward term. */
  terms: Record<string, number | null>;
  /** Codes of the keys that the agent sees held. */
  held: string[];
  /** Contacts of its body with others that have begun since the world's reset. */
  bumps: number;
  /** Things that it has collected, and stages that it has passed, in this episode. */
  collects: number;
  /** Number that grows when somebody in the world says something, at most every 0.6 s of the world's time; 0 before. */
  said: number;
}

/** Switches of the whole class, which its teacher turns. All are off at first. */
export interface Switches {
  /** Students' pages may make sounds. */
  sound: boolean;
}

/** Position of a stick on the screen or a gamepad. */
export interface StickPosition {
  /** Deflection ahead, from -1 to 1. */
  forward?: number;
  /** Deflection to the right, from -1 to 1. */
  turn?: number;
}

/** All keys that are held now, and the position of the stick. A page sends it at each change, and ten times a second while any key is held. */
export interface Keys {
  type: "keys";
  /** Codes of physical keys, as in `KeyboardEvent.code`. */
  held: string[];
  stick?: StickPosition;
}

/** Release of control. */
export interface Release {
  type: "let_go";
}

/** The whole of what a page looks at; only the parts of open tabs are sent. */
export interface Show {
  type: "show";
  /** Id of the agent. */
  agent: string;
  /** Names of the parts of the open tabs. */
  tabs?: ("agent" | "blocks" | "past" | "world")[];
  /** Path of the block whose form is shown; null for none. */
  block?: (string | number)[] | null;
  /** Name of the selected thing; null for none. */
  body?: string | null;
  /** Names of the things that are selected with it. */
  others?: string[];
  /** Number of the chosen episode; null for none. */
  episode?: number | null;
}

/** Start of a world that waits for a key, by a key that the agent does not know. */
export interface Start {
  type: "start";
}

/** Request for control. */
export interface Take {
  type: "take";
}

/** Add a block to the agent, or to one of its blocks. */
export interface AddBlock {
  class: string;
  parent: (string | number)[];
  index?: number | null;
}

/** Add a thing at a place (m), or beside it if it is taken; by default where there is room. */
export interface AddBody {
  template: string;
  x?: number | null;
  y?: number | null;
}

/** Put things into a row or a column through their middle, or at equal distances. */
export interface Align {
  names: string[];
  how: "column" | "row" | "spread";
}

/** Answer the question of the step. */
export interface AnswerMission {
  answer: string;
}

/** Return the action at another pose, and show it; by default where the agent stands now. */
export interface AskElsewhere {
  x?: number | null;
  y?: number | null;
  heading_deg?: number | null;
}

/** Return the reward terms of the chosen episode over time, and the decisions that paid most. */
export interface AskPaid {
}

/** Another value of one number of a percept. */
export interface Change {
  key: string;
  index: number;
  value: number;
}

/** Return the action on the agent's percept, and on a changed one. */
export interface AskWhatIf {
  changes: Change[];
}

/** Show the present again. */
export interface BackToLive {
}

/** Put the camera somewhere. */
export interface Camera {
  mode: "arena" | "eyes" | "follow" | "tilted" | "turn";
}

/** Change parameters of the agent itself. */
export interface ChangeAgent {
  values: Record<string, unknown>;
}

/** Change parameters of a block of the agent. */
export interface ChangeBlock {
  path: (string | number)[];
  values: Record<string, unknown>;
}

/** Change properties of a thing. */
export interface ChangeBody {
  name: string;
  values: Record<string, unknown>;
}

/** Change the field that is generated at each start; a new episode begins with it. */
export interface ChangeField {
  values: Record<string, unknown>;
}

/** Change texts or settings of the scene. */
export interface ChangeSettings {
  values: Record<string, unknown>;
}

/** Show no mission on this page. */
export interface CloseMission {
}

/** Return where two drivers first disagree in the chosen episode; empty for the present one. */
export interface CompareDrivers {
  first: string;
  second: string;
}

/** Let the world run on from the shown decision. */
export interface ContinueHere {
}

/** Keep copies of things, which can be pasted, into another scene too. */
export interface Copy {
  names: string[];
}

/** Draw the picture in dark colours, or light ones. */
export interface Dark {
  on: boolean;
}

/** Pause, and run until the agent's decision is over. */
export interface Decision {
}

/** Delete a network. */
export interface DeleteNetwork {
  network: number;
  /** True deletes one that drives, too; the scene's own driver takes its place. */
  even_if_driving?: boolean;
}

/** Delete the unsaved scene. */
export interface Discard {
}

/** Return the scene's file. */
export interface Download {
}

/** Return a network's file: its `name`, and its bytes in base64 as `data`. */
export interface DownloadNetwork {
  network: number;
}

/** Return the results as CSV: the file's `name`, and its text as `data`. */
export interface DownloadTried {
}

/** Let a network drive the agent that the page shows. */
export interface DriveNetwork {
  network: number;
}

/** Add copies of things beside them. */
export interface Duplicate {
  names: string[];
}

/** Add a copy of a block of the agent. */
export interface DuplicateBlock {
  path: (string | number)[];
}

/** Name the bodies and areas whose middle is within a frame; of one point (m), what is there. */
export interface FindThings {
  corners: [number, number][];
}

/** Delete a drive. */
export interface ForgetDrive {
  drive: number;
}

/** Tell what the function returned, as the page's Python wrote it; answered as the check is. */
export interface FunctionReturned {
  value: string;
}

/** Go on with the practice that waits. */
export interface GoOnPractising {
}

/** Show a decision of the chosen episode, counted from 0. */
export interface GoToStep {
  step: number;
}

/** Return the map from the page's picture to the ground, 3 x 3, row by row. It takes (across, down, 1), shares of the picture's width and height, to (w x, w y, w): metres. */
export interface Ground {
}

/** Show no other pose any more. */
export interface HideElsewhere {
}

/** Wait until the tries of the page's program are over; the page is gone if this ends before. */
export interface HoldTries {
}

/** Begin to check the function that this page has for the step's exercise, or its robot. The answer has the arguments of a call, or the verdict: `passed`, `text` and `hint`. */
export interface JudgeFunction {
  /** The person's text, from which the numbers are drawn; it is not run here. */
  source: string;
}

/** Lay the PNG or JPEG file that was sent in binary messages before on the ground. */
export interface LayPicture {
  name: string;
  size: number;
}

/** Have a network learn from drives of the agent that the page shows, and let it drive then. */
export interface LearnFromDrives {
  /** Numbers of the drives. */
  drives: number[];
}

/** List the blocks that can be added. */
export interface ListBlocks {
  kind: "actuators" | "brains" | "rewards" | "sensors";
}

/** List the drivers that the agent can have. */
export interface ListDrivers {
}

/** Return the drivers that the present one can be compared with. */
export interface ListRivals {
}

/** List the scenes that can be opened. */
export interface ListScenes {
}

/** List the things that can be added, each with its picture from above. */
export interface ListThings {
}

/** Open the scene file that was sent in binary messages before. */
export interface LoadText {
  name: string;
  size: number;
}

/** Begin each episode with the same seed from now on, or with new ones. */
export interface LockSeed {
  on: boolean;
}

/** Move a block of the agent up (-1) or down (1). */
export interface MoveBlock {
  path: (string | number)[];
  by: number;
}

/** Put a thing somewhere (m, degrees). */
export interface MoveBody {
  name: string;
  x: number;
  y: number;
  heading_deg?: number | null;
}

/** Let the user move things with the mouse, or not. */
export interface MoveMode {
  on: boolean;
  /** Radius of the knobs that turn and resize a thing, as a share of the picture's height. */
  knob?: number;
}

/** Begin an episode with a new start, also if the seed is locked. */
export interface NewStart {
}

/** Note how the page's program did with a value. */
export interface NoteTriedValue {
  value: number;
  successes: number;
  reward: number;
  seconds: number;
  decisions: number;
}

/** Move things a bit (m, degrees). */
export interface Nudge {
  names: string[];
  dx?: number;
  dy?: number;
  turn_deg?: number;
}

/** Choose a recorded episode; 0 is the one that runs. */
export interface OpenEpisode {
  number: number;
}

/** Show a mission's step on this page, and begin to check it. */
export interface OpenMission {
  mission: string;
  /** From 0. */
  step?: number;
}

/** Keep the network in the file that the page has sent. */
export interface OpenNetwork {
  /** Name of the file. */
  name: string;
  size: number;
}

/** Open the recording that was sent in binary messages before. */
export interface OpenRecording {
  name: string;
  size: number;
}

/** Open a scene of the library, or a saved one. */
export interface OpenScene {
  name: string;
  is_saved?: boolean;
}

/** Add what was copied, with its middle at a place (m); by default beside where it was. */
export interface Paste {
  x?: number | null;
  y?: number | null;
}

/** Pause the world. */
export interface Pause {
}

/** Let the practice wait; it can go on after a restart of the world, too. */
export interface PausePractising {
}

/** Keep an episode however many others come, or no longer. */
export interface Pin {
  number: number;
  on: boolean;
}

/** Play the chosen episode. */
export interface Play {
}

/** Open with a short tilt of the camera, or end it. */
export interface PlayOpening {
  on: boolean;
}

/** Have a network practise for rewards with the page's agent, and drive it meanwhile. */
export interface PractiseForRewards {
  /** Decisions to learn from. */
  steps: number;
  /** Factors of reward terms by name; 1 for one that is left out. */
  weights: Record<string, number>;
  /** Number of a network to begin with; null for a new one. */
  begin_with?: number | null;
  /** Player of the other side; null if all others are driven as the scene says. */
  against?: "file" | "player" | "self" | null;
  /** Number of the network that plays the other side; null for none. */
  opponent?: number | null;
}

/** Multiply the scene's own rewards of the page's agent by factors. */
export interface PutRewards {
  weights: Record<string, number>;
}

/** Begin an episode with the same start, against a ghost of the chosen one. */
export interface Race {
}

/** Let a person race against a trained network's ghost, from the same start. */
export interface RaceNetwork {
  /** Name of the driver; empty for the usual one. */
  network?: string;
}

/** Make the change again that was undone last. */
export interface Redo {
}

/** Leave out motion that nothing in the world makes, or not. */
export interface ReduceMotion {
  on: boolean;
}

/** Remove a block of the agent. */
export interface RemoveBlock {
  path: (string | number)[];
}

/** Delete things; the body of an agent goes with its agent. */
export interface RemoveBodies {
  names: string[];
}

/** Remove the ghost. */
export interface RemoveGhost {
}

/** Give a network another title. */
export interface RenameNetwork {
  network: number;
  title: string;
}

/** Show an episode of a network's practice in the player of recorded episodes. */
export interface ReplayPractice {
  network: number;
  /** Decisions that the network had learned from then, one of its replays. */
  decisions: number;
}

/** Begin an episode with the locked seed, or else with a new one. */
export interface Reset {
}

/** Open the unsaved scene. */
export interface Restore {
}

/** Let the world run. */
export interface Resume {
}

/** Save the scene under a name. */
export interface SaveScene {
  name: string;
  over?: boolean;
}

/** Tell what the person sees and does in this page. */
export interface SeeMission {
  /** Name of the open tab of the panel; empty if the panel is folded. */
  tab: string;
  /** `python` or `blocks`, as the program in the tab "Code" is written; empty before. */
  way?: string;
  /** True if another page drives the robot: what it does is not this person's. */
  is_watching?: boolean;
}

/** Select a thing, and others with it. */
export interface SelectBody {
  body: string | null;
  others?: string[];
}

/** Choose the agent's driver. */
export interface SetDriver {
  name: string;
  agent?: string | null;
}

/** Set the speed of playing; 1 is the recorded speed. */
export interface SetPlaySpeed {
  speed: number;
}

/** Begin an episode with a seed. */
export interface SetSeed {
  seed: string;
}

/** Set the time scale; 1 is real time. */
export interface SetSpeed {
  speed: number | "max";
}

/** Give the number a value for all episodes until the next one, and begin an episode. */
export interface SetTriedValue {
  value: number;
}

/** Show another agent. */
export interface ShowAgent {
  agent: string;
}

/** Show maps over the floor: what the agent would do at each place, and what it is worth. */
export interface ShowMaps {
  field: boolean;
  values: boolean;
  facing?: string;
}

/** Draw a sensor in the picture, or hide it. */
export interface ShowSensor {
  key: string;
  on: boolean;
}

/** Draw the agent's trail, or hide it. */
export interface ShowTrail {
  on: boolean;
}

/** Show why the agent acts as it does, or no longer. */
export interface ShowWhy {
  on: boolean;
}

/** Set the grid (m) to which moved things snap; 0 for none. */
export interface Snap {
  distance: number;
}

/** Stop playing. */
export interface Stop {
}

/** End the learning without a result. */
export interface StopLearning {
}

/** End the practice; the best network until then is kept. */
export interface StopPractising {
}

/** End the episodes; what was driven is kept. */
export interface StopTrying {
}

/** Give the agent back to its own driver, at the same start. */
export interface StopWatching {
}

/** Switch a block of the agent on or off. */
export interface SwitchBlock {
  path: (string | number)[];
  on: boolean;
}

/** Pause, and tick once. */
export interface Tick {
}

/** Begin an episode with the same start. */
export interface TryAgain {
}

/** Let the driver of the page's agent drive from the same starts with each value of a number. */
export interface TryMany {
  /** Name of the number. */
  parameter: string;
  /** Numbers with commas between. */
  values: string;
  /** Episodes with each value. */
  starts: number;
}

/** Begin to try values with the program in this page, which drives one after another. */
export interface TryProgram {
  parameter: string;
  values: string;
  starts: number;
}

/** Take back the last change. */
export interface Undo {
}

/** Let a trained network drive for a while, from the same start, and show why it acts so. */
export interface WatchNetwork {
  /** Name of the driver; empty for the usual one. */
  network?: string;
  /** True to let it race against a person's best or last drive, from the start of that. */
  against_my_drive?: boolean;
}

/** The commands by name: what is sent with each of them. */
export interface Commands {
  add_block: AddBlock;
  add_body: AddBody;
  agent: ShowAgent;
  align: Align;
  back_to_live: BackToLive;
  camera: Camera;
  change_agent: ChangeAgent;
  change_block: ChangeBlock;
  change_body: ChangeBody;
  change_field: ChangeField;
  change_settings: ChangeSettings;
  compare: CompareDrivers;
  continue: ContinueHere;
  copy: Copy;
  dark: Dark;
  decision: Decision;
  discard: Discard;
  download: Download;
  driver: SetDriver;
  drivers: ListDrivers;
  duplicate: Duplicate;
  duplicate_block: DuplicateBlock;
  elsewhere: AskElsewhere;
  episode: OpenEpisode;
  find_things: FindThings;
  gallery: ListBlocks;
  ground: Ground;
  hide_elsewhere: HideElsewhere;
  lay_picture: LayPicture;
  load_text: LoadText;
  lock_seed: LockSeed;
  maps: ShowMaps;
  mission_answer: AnswerMission;
  mission_close: CloseMission;
  mission_judge: JudgeFunction;
  mission_open: OpenMission;
  mission_returned: FunctionReturned;
  mission_see: SeeMission;
  move_block: MoveBlock;
  move_body: MoveBody;
  move_mode: MoveMode;
  new_start: NewStart;
  nudge: Nudge;
  open_recording: OpenRecording;
  open_scene: OpenScene;
  opening: PlayOpening;
  paid: AskPaid;
  palette: ListThings;
  paste: Paste;
  pause: Pause;
  pin: Pin;
  play: Play;
  play_speed: SetPlaySpeed;
  race: Race;
  race_network: RaceNetwork;
  redo: Redo;
  reduce_motion: ReduceMotion;
  remove_block: RemoveBlock;
  remove_bodies: RemoveBodies;
  remove_ghost: RemoveGhost;
  reset: Reset;
  restore: Restore;
  resume: Resume;
  rivals: ListRivals;
  save_scene: SaveScene;
  scenes: ListScenes;
  seed: SetSeed;
  select: SelectBody;
  sensor: ShowSensor;
  snap: Snap;
  speed: SetSpeed;
  step: GoToStep;
  stop: Stop;
  stop_watching: StopWatching;
  switch_block: SwitchBlock;
  teach_delete: DeleteNetwork;
  teach_download: DownloadNetwork;
  teach_download_tried: DownloadTried;
  teach_drive: DriveNetwork;
  teach_forget_drive: ForgetDrive;
  teach_go_on: GoOnPractising;
  teach_hold_tries: HoldTries;
  teach_learn: LearnFromDrives;
  teach_note_value: NoteTriedValue;
  teach_open: OpenNetwork;
  teach_pause: PausePractising;
  teach_practise: PractiseForRewards;
  teach_put_rewards: PutRewards;
  teach_rename: RenameNetwork;
  teach_replay: ReplayPractice;
  teach_set_value: SetTriedValue;
  teach_stop: StopLearning;
  teach_stop_practising: StopPractising;
  teach_stop_trying: StopTrying;
  teach_try: TryMany;
  teach_try_program: TryProgram;
  tick: Tick;
  trail: ShowTrail;
  try_again: TryAgain;
  undo: Undo;
  watch_network: WatchNetwork;
  what_if: AskWhatIf;
  why: ShowWhy;
}
