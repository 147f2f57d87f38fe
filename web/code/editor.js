/** The editor of a program: CodeMirror with our marks and colors. Loaded when the tab "Code" is opened. */

/** @import { CompletionContext, Doc, EffectType, Mark, MarkRange, Transaction } from "../vendor/codemirror.js?v=b595b00f" */

import {
  autocompletion,
  bracketMatching,
  closeBrackets,
  closeBracketsKeymap,
  completionKeymap,
  Decoration,
  defaultKeymap,
  EditorState,
  EditorView,
  highlightActiveLine,
  history,
  historyKeymap,
  indentOnInput,
  indentUnit,
  indentWithTab,
  keymap,
  lineNumbers,
  python,
  StateEffect,
  StateField,
  syntaxHighlighting,
  tagHighlighter,
  tags,
} from "../vendor/codemirror.js?v=b595b00f";

/** Classes of what is written, which styles/panel/code.css gives the panel's colors. */
const COLORS = tagHighlighter([
  { tag: [tags.keyword, tags.operatorKeyword, tags.bool, tags.null, tags.self], class: "ai4u-code-keyword" },
  { tag: [tags.string, tags.special(tags.string)], class: "ai4u-code-string" },
  { tag: tags.number, class: "ai4u-code-number" },
  { tag: tags.comment, class: "ai4u-code-comment" },
  { tag: [tags.definition(tags.function(tags.variableName)), tags.definition(tags.className)], class: "ai4u-code-name" },
]);
/** A place where the name of a reading or an actuator is typed, up to the cursor. */
const PERCEPT_KEY = /\bpercept\[\s*["'][^"']*$/;
const ACTION_NAME = /\breturn\s*\{\s*(?:.*,\s*)?["'][^"']*$/;

/** Hanging indent of a wrapped line's further rows (characters). */
const HANG_CHARS = 2;

/** @type {EffectType<number[]>} */
const setMistake = StateEffect.define();
/** @type {EffectType<number[]>} */
const setRan = StateEffect.define();
/** @type {EffectType<number[]>} */
const setStops = StateEffect.define();
/** @type {EffectType<number[]>} */
const setWaiting = StateEffect.define();
/** @type {EffectType<boolean>} */
const setReadOnly = StateEffect.define();
const mistakes = lineMarks(setMistake, Decoration.line({ class: "ai4u-code-mistake-line" }));
const stops = lineMarks(setStops, Decoration.line({ class: "ai4u-code-stop-line" }));
const waiting = lineMarks(setWaiting, Decoration.line({ class: "ai4u-code-waiting-line" }));
const ran = lineMarks(setRan, Decoration.line({ class: "ai4u-code-ran-line" }));

const readOnly = StateField.define({
  create: () => false,
  update: (value, { effects }) => effects.findLast((effect) => effect.is(setReadOnly))?.value ?? value,
  provide: (field) => [EditorState.readOnly.from(field), EditorView.editable.from(field, (value) => !value)],
});

const hanging = StateField.define({
  create: ({ doc }) => hangingIndents(doc),
  update: (marks, { docChanged, state }) => (docChanged ? hangingIndents(state.doc) : marks),
  provide: (field) => EditorView.decorations.from(field),
});

export class CodeEditor {
  /**
   * Called with the text after each change by the person.
   * @type {(text: string) => void}
   */
  onChange = () => {};
  /**
   * Called with the lines that have a breakpoint after each change of them, and with the one that was set or null.
   * @type {(lines: number[], added: number | null) => void}
   */
  onStops = () => {};
  #view;
  /** @type {{readings: string[], outputs: string[]}} */
  #names = { readings: [], outputs: [] };
  #isSetting = false;

  /**
   * @param {HTMLElement} parent element that gets the editor
   * @param {object} options
   * @param {string} options.label accessible name
   * @param {string} [options.describedBy] id of the element that tells how to use it
   * @param {{key: string, run: () => boolean}[]} [options.keys] in CodeMirror's words; they come before the editor's own
   */
  constructor(parent, { label, describedBy = "", keys = [] }) {
    const attributes = { "aria-label": label, "aria-describedby": describedBy, spellcheck: "false", autocapitalize: "off", tabindex: "0" };
    const extensions = [
      keymap.of([...keys, { key: "F9", run: () => this.#toggleStop(this.#view.state.selection.main.head) }]),
      lineNumbers({ domEventHandlers: { mousedown: (_, { from }) => this.#toggleStop(from) } }),
      history(),
      indentOnInput(),
      indentUnit.of("    "),
      EditorState.tabSize.of(4),
      bracketMatching(),
      closeBrackets(),
      highlightActiveLine(),
      autocompletion({ override: [(context) => this.#complete(context)], icons: false }),
      keymap.of([...closeBracketsKeymap, ...completionKeymap, ...defaultKeymap, ...historyKeymap, indentWithTab]),
      python(),
      syntaxHighlighting(COLORS),
      EditorView.lineWrapping,
      readOnly,
      EditorView.contentAttributes.of(attributes),
      EditorView.contentAttributes.compute([readOnly], (state) => ({ "aria-readonly": String(state.field(readOnly)) })),
      EditorView.updateListener.of((update) => this.#onUpdate(update)),
      mistakes,
      stops,
      ran,
      waiting,
      hanging,
    ];
    this.#view = new EditorView({ parent, extensions });
    this.#keepKeys();
  }

  get text() {
    return this.#view.state.doc.toString();
  }

  /** Replace the text, which the person can undo; it does not count as a change by them. */
  set text(text) {
    if (text === this.text) return;
    this.#isSetting = true;
    this.#view.dispatch({
      changes: { from: 0, to: this.#view.state.doc.length, insert: text },
      selection: { anchor: 0 },
      effects: setStops.of([]),
      userEvent: "input.replace", // a step of its own to undo, however soon it comes after another one
    });
    this.#isSetting = false;
    this.onStops([], null);
  }

  /**
   * True if the person can read and copy the text, but not change it.
   * @param {boolean} value
   */
  set isReadOnly(value) {
    this.#view.dispatch({ effects: setReadOnly.of(value) });
  }

  focus() {
    this.#view.focus();
  }

  /**
   * Offer these names in `percept["..."]` and in `return {"..."}`.
   * @param {{readings: string[], outputs: string[]}} names
   */
  setNames({ readings, outputs }) {
    this.#names = { readings, outputs };
  }

  /**
   * Mark the line of a mistake, and scroll to it; null removes the mark.
   * @param {number | null} line
   */
  markMistake(line) {
    const lines = this.#lines([line]);
    const scrolls = lines.map((from) => EditorView.scrollIntoView(from, { y: "center" }));
    this.#view.dispatch({ effects: [setMistake.of(lines), ...scrolls] });
  }

  /**
   * Mark the lines that ran in the latest decision.
   * @param {number[]} lines
   */
  markRan(lines) {
    this.#view.dispatch({ effects: setRan.of(this.#lines(lines)) });
  }

  /** The lines with a breakpoint. */
  get stops() {
    const { doc } = this.#view.state;
    /** @type {Set<number>} */
    const found = new Set();
    this.#view.state.field(stops).between(0, doc.length, (from) => void found.add(doc.lineAt(from).number));
    return [...found];
  }

  /**
   * Mark the line at which the program waits, and scroll to it; null removes the mark.
   * @param {number | null} line
   */
  markWaiting(line) {
    const lines = this.#lines([line]);
    const scrolls = lines.map((from) => EditorView.scrollIntoView(from, { y: "nearest" }));
    this.#view.dispatch({ effects: [setWaiting.of(lines), ...scrolls] });
  }

  /**
   * Set a breakpoint at the line of a position, or remove it. Returns true: the key or the click is used.
   * @param {number} at
   */
  #toggleStop(at) {
    const { number } = this.#view.state.doc.lineAt(at);
    const before = this.stops;
    const isThere = before.includes(number);
    const lines = isThere ? before.filter((line) => line !== number) : [...before, number];
    this.#view.dispatch({ effects: setStops.of(this.#lines(lines)) });
    this.onStops(this.stops, isThere ? null : number);
    return true;
  }

  /**
   * Put the cursor into a line, and the focus into the editor.
   * @param {number} line
   */
  goTo(line) {
    const [at] = this.#lines([line]);
    if (at !== undefined) this.#view.dispatch({ selection: { anchor: at }, scrollIntoView: true });
    this.#view.focus();
  }

  /**
   * Insert a text in place of the selection.
   * @param {string} text
   */
  insert(text) {
    if (this.#view.state.readOnly) return;
    this.#view.dispatch(this.#view.state.replaceSelection(text));
    this.#view.focus();
  }

  /** Keep keys from the panel, which ends the editing of a field at Enter; Escape ends it if it closes no list of names. */
  #keepKeys() {
    const { dom } = this.#view;
    let hasList = false;
    dom.addEventListener("keydown", () => (hasList = dom.querySelector(".cm-tooltip-autocomplete") !== null), { capture: true });
    dom.addEventListener("keydown", (event) => (event.key !== "Escape" || hasList) && event.stopPropagation());
  }

  /**
   * Return where lines begin, in order, each once; numbers that no line has are left out.
   * @param {(number | null)[]} numbers
   */
  #lines(numbers) {
    const { doc } = this.#view.state;
    const found = new Set(numbers.filter((number) => number >= 1 && number <= doc.lines));
    return [...found].sort((a, b) => a - b).map((number) => doc.line(number).from);
  }

  /** @param {Transaction} update */
  #onUpdate(update) {
    if (!update.docChanged || this.#isSetting) return;
    this.onStops(this.stops, null); // they have moved with the text
    this.onChange(this.text);
  }

  /** @param {CompletionContext} context */
  #complete(context) {
    const { readings, outputs } = this.#names;
    for (const { pattern, names } of [{ pattern: PERCEPT_KEY, names: readings }, { pattern: ACTION_NAME, names: outputs }]) {
      const before = context.matchBefore(pattern);
      if (before === null || !names.length) continue;
      const typed = /[^"']*$/.exec(before.text)[0];
      return { from: context.pos - typed.length, options: names.map((label) => ({ label })), validFor: /^[^"']*$/ };
    }
    return null;
  }
}

/**
 * Return a field that marks the lines of the latest effect; the marks move with the text.
 * @param {EffectType<number[]>} effect
 * @param {Mark} mark
 */
function lineMarks(effect, mark) {
  return StateField.define({
    create: () => Decoration.none,
    update: (marks, transaction) => {
      const latest = transaction.effects.findLast((other) => other.is(effect));
      if (latest) return Decoration.set(latest.value.map((from) => mark.range(from)));
      return marks.map(transaction.changes);
    },
    provide: (field) => EditorView.decorations.from(field),
  });
}

/**
 * Return marks by which the rows of a long line stay to the right of its beginning.
 * @param {Doc} doc
 */
function hangingIndents(doc) {
  /** @type {MarkRange[]} */
  const marks = [];
  for (let number = 1; number <= doc.lines; number += 1) {
    const { from, text } = doc.line(number);
    const chars = text.search(/\S|$/) + HANG_CHARS;
    marks.push(Decoration.line({ attributes: { style: `--hang: ${chars}ch` } }).range(from));
  }
  return Decoration.set(marks);
}
