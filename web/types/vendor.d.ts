/** Libraries of vendor/, by the version in their address. They come without types; of CodeMirror, here is what code/editor.js uses. */

declare module "*/blockly.js?v=e631db10";
declare module "*/blockly.pt_BR.js?v=a87d0860" {
  const words: Record<string, string>;
  export default words;
}
declare module "*/msgpack.js?v=269ec7b2";
declare module "*/pyodide.asm.mjs?v=f7cdc8ec";
declare module "*/pyodide.mjs?v=6f1d60f7";

declare module "*/codemirror.js?v=b595b00f" {
  type Extension = object;

  interface Facet<Value> {
    of(value: Value): Extension;
    from<Stored>(field: Field<Stored>, get?: (stored: Stored) => Value): Extension;
    compute(fields: object[], get: (state: EditorState) => Value): Extension;
  }

  interface Field<Value> {
    readonly init: (create: (state: EditorState) => Value) => Extension;
  }
  export const StateField: {
    define<Value>(config: {
      create: (state: EditorState) => Value;
      update: (value: Value, transaction: Transaction) => Value;
      provide: (field: Field<Value>) => Extension;
    }): Field<Value>;
  };

  interface Effect<Value> {
    readonly value: Value;
    is<Other>(type: EffectType<Other>): this is Effect<Other>;
  }
  interface EffectType<Value> {
    of(value: Value): Effect<Value>;
  }
  export const StateEffect: { define<Value>(): EffectType<Value> };

  interface Transaction {
    readonly changes: object;
    readonly docChanged: boolean;
    readonly effects: Effect<unknown>[];
    readonly state: EditorState;
  }

  interface Doc {
    readonly length: number;
    readonly lines: number;
    line(number: number): { from: number; text: string };
    lineAt(position: number): { number: number };
  }
  export class EditorState {
    static readonly readOnly: Facet<boolean>;
    static readonly tabSize: Facet<number>;
    readonly doc: Doc;
    readonly readOnly: boolean;
    readonly selection: { main: { head: number } };
    field<Value>(field: Field<Value>): Value;
    replaceSelection(text: string): object;
  }
  export class EditorView {
    static readonly contentAttributes: Facet<Record<string, string>>;
    static readonly decorations: Facet<Marks>;
    static readonly editable: Facet<boolean>;
    static readonly lineWrapping: Extension;
    static readonly updateListener: Facet<(update: Transaction) => void>;
    static scrollIntoView(at: number, options: { y: string }): Effect<unknown>;
    readonly dom: HTMLElement;
    readonly state: EditorState;
    constructor(config: { parent: HTMLElement; extensions: Extension[] });
    dispatch(transaction: object): void;
    focus(): void;
  }

  type MarkRange = object;
  interface Marks {
    map(changes: object): Marks;
    between(from: number, to: number, take: (from: number) => void): void;
  }
  interface Mark {
    range(from: number): MarkRange;
  }
  export const Decoration: { none: Marks; line(spec: object): Mark; set(ranges: MarkRange[]): Marks };

  interface CompletionContext {
    readonly pos: number;
    matchBefore(pattern: RegExp): { text: string } | null;
  }
  export function autocompletion(config: { override: ((context: CompletionContext) => object | null)[]; icons: boolean }): Extension;

  interface Binding {
    key?: string;
    mac?: string;
    run?: (view: EditorView) => boolean;
  }
  export const keymap: Facet<Binding[]>;
  export const closeBracketsKeymap: Binding[];
  export const completionKeymap: Binding[];
  export const defaultKeymap: Binding[];
  export const historyKeymap: Binding[];
  export const indentWithTab: Binding;

  interface Tag {
    readonly set: Tag[];
  }
  export const tags: Record<"bool" | "className" | "comment" | "keyword" | "null" | "number" | "operatorKeyword" | "self" | "string" | "variableName", Tag> &
    Record<"definition" | "function" | "special", (tag: Tag) => Tag>;
  export function tagHighlighter(rules: { tag: Tag | Tag[]; class: string }[]): object;
  export function syntaxHighlighting(highlighter: object): Extension;

  export const indentUnit: Facet<string>;
  export function bracketMatching(): Extension;
  export function closeBrackets(): Extension;
  export function highlightActiveLine(): Extension;
  export function history(): Extension;
  export function indentOnInput(): Extension;
  export function lineNumbers(config?: {
    domEventHandlers?: Record<string, (view: EditorView, line: { from: number }, event: Event) => boolean>;
  }): Extension;
  export function python(): Extension;
}
