/** Event targets whose events have details of known types, by the event's type. */

export interface Emitter<Details> extends EventTarget {
  addEventListener<Type extends keyof Details & string>(
    type: Type,
    listener: (event: CustomEvent<Details[Type]>) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject | null, options?: boolean | AddEventListenerOptions): void;
}

/** The class to extend, in place of EventTarget. */
export type EmitterClass<Details> = new () => Emitter<Details>;
