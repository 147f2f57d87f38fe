/** An exercise whose answer is a function: written here, called by the page's Python, and judged by the room. */

/**
 * @import { MissionExercise } from "../generated/messages.js"
 * @import { CodeEditor } from "../code/editor.js"
 * @import { CodeEngine } from "../code/engine.js"
 * @import { Panel } from "../panel/panel.js"
 * @import { AnswerTo } from "../types/panel.js"
 */
import { button, element, setText, withBold } from "../shared/dom.js";
import { roomOfPage } from "../shared/room.js";
import { recall, remember } from "../shared/storage.js";
import { t } from "../shared/text.js";

/** Longest value that is sent to the room, which takes no longer one (characters). */
const MAX_VALUE_CHARS = 20_000;
const TOO_LARGE = JSON.stringify({ shown: t("a very large value") });

export class ExerciseForm {
  #panel;
  /** @type {MissionExercise | null} */
  #exercise = null;
  /** @type {CodeEditor | null} */
  #editor = null;
  /** @type {CodeEngine | null} */
  #engine = null;
  #isChecking = false;
  #code = element("div", { className: "ai4u-code-editor ai4u-mission-code" });
  #check = button(t("Check"), () => void this.#judge(), { icon: "play", kind: "main" });
  #again = button(t("Begin again"), () => this.#reset(), { kind: "quiet", title: t("Put back the text that was here at first") });
  #said = element("p", { className: "ai4u-mission-problem", role: "status", hidden: true });
  #printed = element("pre", { className: "ai4u-mission-printed", hidden: true });
  element = element("div", { className: "ai4u-mission-exercise", hidden: true });

  /** @param {Panel} panel */
  constructor(panel) {
    this.#panel = panel;
    const tools = element("div", { className: "ai4u-mission-buttons" }, this.#check, this.#again);
    this.element.append(this.#code, tools, this.#said, this.#printed);
  }

  /**
   * Show an exercise; null for none.
   * @param {MissionExercise | null} exercise
   */
  show(exercise) {
    this.element.hidden = exercise === null;
    if (exercise?.id === this.#exercise?.id) return;
    this.#exercise = exercise;
    this.#say("");
    if (exercise === null) {
      this.#engine?.end();
      this.#engine = null;
    } else if (exercise.function) void this.#open(exercise);
    this.#code.hidden = this.#again.hidden = !exercise?.function;
  }

  /** @param {MissionExercise} exercise */
  async #open(exercise) {
    // they are large, and most pages show no exercise
    const [{ CodeEditor }, { CodeEngine }] = await Promise.all([import("../code/editor.js"), import("../code/engine.js")]);
    if (this.#exercise !== exercise) return;
    if (this.#editor === null) {
      this.#editor = new CodeEditor(this.#code, {
        label: t("Your function"),
        keys: [{ key: "Mod-Enter", run: () => (void this.#judge(), true) }],
      });
      this.#editor.onChange = (text) => this.#exercise && remember(key(this.#exercise), text);
    }
    const kept = recall(key(exercise), exercise.text);
    this.#editor.text = typeof kept === "string" ? kept : exercise.text;
    this.#engine ??= new CodeEngine();
    this.#engine.warm().catch((error) => this.#say(error.message));
  }

  #reset() {
    if (this.#exercise === null || this.#editor === null) return;
    this.#editor.text = this.#exercise.text;
    remember(key(this.#exercise), this.#exercise.text);
    this.#say("");
  }

  async #judge() {
    const [exercise, editor, engine] = [this.#exercise, this.#editor, this.#engine];
    const isRobot = exercise !== null && !exercise.function;
    if (exercise === null || this.#isChecking || (!isRobot && (editor === null || engine === null))) return;
    this.#isChecking = true;
    this.#check.disabled = true;
    this.#say("");
    try {
      if (isRobot) this.#tell(await this.#panel.send("mission_judge", { source: "" }, { quiet: true }));
      else await this.#callAll(exercise, editor.text, engine);
    } finally {
      this.#isChecking = false;
      this.#check.disabled = false;
    }
  }

  /**
   * Call the function as the room asks, until it says what it thinks of it.
   * @param {MissionExercise} exercise
   * @param {string} source
   * @param {CodeEngine} engine
   */
  async #callAll(exercise, source, engine) {
    const loaded = await engine.loadFunctions(source);
    let printed = loaded.printed ?? "";
    if (!loaded.ok) {
      this.#say(textOf(loaded), printed, loaded.line);
      return;
    }
    /** @type {AnswerTo<"mission_judge">} */
    let answer = await this.#panel.send("mission_judge", { source }, { quiet: true });
    while (answer.ok && typeof answer.arguments === "string") {
      const called = await engine.call(exercise.function, answer.arguments);
      printed += called.printed ?? "";
      if (!called.ok) {
        this.#say(textOf(called), printed, called.line);
        return;
      }
      const value = called.value.length > MAX_VALUE_CHARS ? TOO_LARGE : called.value;
      answer = await this.#panel.send("mission_returned", { value }, { quiet: true });
    }
    this.#tell(answer, printed);
  }

  /**
   * Show a verdict.
   * @param {AnswerTo<"mission_judge">} answer
   * @param {string} [printed]
   */
  #tell({ ok: isOk, passed, text, hint }, printed = "") {
    if (isOk && passed) this.#say("", printed);
    else this.#say([text, hint].filter(Boolean).join(" "), printed);
  }

  /**
   * @param {string} text what is wrong; empty if nothing is
   * @param {string} [printed]
   * @param {number} [line] with the mistake
   */
  #say(text, printed = "", line = 0) {
    // the lessons write code between backticks, and bold words between stars
    if (this.#said.textContent.replaceAll("*", "") !== text.replaceAll(/[`*]/g, "")) {
      this.#said.replaceChildren(...text.split("`").flatMap((part, index) => (index % 2 ? [element("code", { textContent: part })] : withBold(part))));
    }
    this.#said.hidden = !text;
    setText(this.#printed, printed);
    this.#printed.hidden = !printed;
    if (text) this.#said.scrollIntoView({ block: "nearest" });
    this.#editor?.markMistake(line);
  }
}

/** @param {{line?: number, text?: string}} mistake */
function textOf({ line, text = "" }) {
  return line ? t("Line {line}: {text}", { line, text }) : text;
}

/** @param {MissionExercise} exercise */
function key({ id }) {
  const room = roomOfPage();
  return `exercise-${room && `${room}/`}${id}`;
}
