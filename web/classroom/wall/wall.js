/** The wall: a card for each room, sorted, filtered and sized, with the drawings of all rooms behind them. */

/** @import { ClassState, DrawingMessage, PosesMessage, Seat } from "../../types/class.js" */

import { keyed } from "../../shared/dom.js";
import { roomCard, updateCard } from "./room_card.js";
import { roomName } from "../room_words.js";
import { WallCanvas } from "./canvas.js";
import { FILTERS, fitting, ordered } from "./order.js";

const GAP_PX = 10;
const MIN_CARD_PX = 112;
/** Cards below this width have no foot; as in styles/classroom/wall.css. */
const MIN_FOOT_PX = 170;
/** Time that a pointer resting on a card keeps the order (ms). */
const POINTER_HOLDS_MS = 10_000;

/** @typedef {{of: (seat: Seat) => string}} Names real names, see classroom/teacher/real_names.js */

export class Wall {
  #wall;
  #list;
  #canvas;
  #onOpen;
  #realNames;
  /** @type {ClassState | null} */
  #state = null;
  /**
   * Ids of rooms.
   * @type {string[]}
   */
  #order = [];
  #pointerUntil = 0;
  #view = { by: "help", filter: "all", width: 0 };
  /** The number of cards, the wall's width, and the columns that fit them. */
  #fitted = { count: 0, width: 0, columns: 0 };

  /**
   * @param {HTMLElement} wall has a canvas and a list
   * @param {object} options
   * @param {((room: string) => void) | null} [options.onOpen] called with a room's id; without it, cards are no buttons
   * @param {Names} [options.realNames]
   * @param {() => number} options.heightLeft returns the height that all cards should fit into
   */
  constructor(wall, { onOpen = null, realNames = { of: () => "" }, heightLeft }) {
    this.#wall = wall;
    this.#list = wall.querySelector("ul");
    this.#canvas = new WallCanvas(wall, wall.querySelector("canvas"));
    this.#onOpen = onOpen;
    this.#realNames = realNames;
    this.#heightLeft = heightLeft;
    wall.addEventListener("pointermove", () => (this.#pointerUntil = performance.now() + POINTER_HOLDS_MS));
    wall.addEventListener("pointerleave", () => (this.#pointerUntil = 0));
    this.#list.addEventListener("keydown", (event) => this.#moveFocus(event));
    this.#list.addEventListener("focusin", ({ target }) => this.#makeTabStop(target));
    new ResizeObserver(() => this.fit()).observe(wall);
    addEventListener("resize", () => this.fit());
  }
  #heightLeft;

  /** @param {DrawingMessage} message */
  setDrawing(message) {
    this.#canvas.setDrawing(message);
  }

  /** @param {PosesMessage} message */
  setPoses({ rooms }) {
    this.#canvas.setPoses(rooms);
  }

  /**
   * Show the class's state.
   * @param {ClassState} state
   */
  show(state) {
    this.#state = state;
    this.#canvas.keepOnly(state.rooms.map((room) => room.id));
    this.#update();
  }

  /**
   * Change the view.
   * @param {{by?: string, filter?: string, width?: number}} view order ("help" or "name"), filter (see classroom/wall/order.js), and width of a
   *   card (0: so that all fit)
   */
  look(view) {
    Object.assign(this.#view, view);
    this.#order = [];
    this.#update();
  }

  get filter() {
    return this.#view.filter;
  }

  /**
   * Return how many rooms a filter keeps.
   * @param {string} filter
   */
  count(filter) {
    return this.#state?.rooms.filter(FILTERS[filter].keeps).length ?? 0;
  }

  #update() {
    const state = this.#state;
    if (!state) return;
    const shown = state.rooms.filter(FILTERS[this.#view.filter].keeps);
    const rooms = ordered(shown, this.#view.by, (room) => roomName(room, state), this.#isHeld() ? this.#order : null);
    const ids = rooms.map((room) => room.id);
    const isOther = ids.join() !== this.#order.join();
    this.#order = ids;
    const focused = this.#list.contains(document.activeElement) ? /** @type {HTMLElement} */ (document.activeElement) : null;
    keyed(
      this.#list,
      rooms,
      (room) => room.id,
      (room) => roomCard(room, this.#onOpen),
      (card, room) => updateCard(card, room, state, this.#realNames),
    );
    if (focused?.isConnected && focused !== document.activeElement) focused.focus({ preventScroll: true });
    if (!isOther) return;
    if (this.#onOpen) this.#makeTabStop(this.#list.querySelector("button[tabindex='0']") ?? this.#buttons()[0]);
    const cards = /** @type {HTMLElement[]} */ ([...this.#list.children]);
    this.#canvas.show(new Map(cards.map((card) => [card.dataset.key, card.querySelector(".ai4u-room-picture")])));
    this.fit();
  }

  /** Return true while cards must keep their places: a person points at one, or is at one with the keyboard. */
  #isHeld() {
    return performance.now() < this.#pointerUntil || this.#list.querySelector(":focus-visible") !== null;
  }

  /** Fit the cards into the window again. */
  fit() {
    const width = this.#wall.clientWidth;
    if (width === 0) return;
    const wanted = this.#view.width;
    const most = Math.max(1, Math.floor((width + GAP_PX) / (wanted + GAP_PX)));
    const { columns, cardWidth } = wanted
      ? { columns: most, cardWidth: (width - GAP_PX * (most - 1)) / most }
      : this.#fitting(this.#order.length, width);
    if (!wanted) this.#fitted = { count: this.#order.length, width, columns };
    this.#list.style.gridTemplateColumns = `repeat(${columns}, minmax(0, ${Math.floor(cardWidth)}px))`;
    this.#list.style.gap = `${GAP_PX}px`;
    this.#canvas.layOut();
  }

  /**
   * @param {number} count
   * @param {number} width
   */
  #fitting(count, width) {
    const isSame = count === this.#fitted.count && width === this.#fitted.width;
    const card = { minWidth: MIN_CARD_PX, heightOf, widthOf };
    return fitting(count, width, this.#heightLeft(), GAP_PX, card, isSame ? this.#fitted.columns : 0);
  }

  #buttons() {
    return [...this.#list.querySelectorAll("button")];
  }

  /**
   * The wall is one stop of the Tab key; arrows lead from card to card.
   * @param {EventTarget | null} card
   */
  #makeTabStop(card) {
    for (const each of this.#buttons()) each.tabIndex = each === card ? 0 : -1;
  }

  /** @param {KeyboardEvent} event */
  #moveFocus(event) {
    const cards = this.#buttons();
    const columns = getComputedStyle(this.#list).gridTemplateColumns.split(" ").length;
    const at = cards.findIndex((card) => card === document.activeElement);
    /** @type {Record<string, number>} */
    const ways = { ArrowRight: at + 1, ArrowLeft: at - 1, ArrowDown: at + columns, ArrowUp: at - columns, Home: 0, End: cards.length - 1 };
    const to = ways[event.key];
    if (at < 0 || !cards[to] || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    cards[to].focus();
  }
}

/**
 * Return a card's height; as in styles/classroom/wall.css.
 * @param {number} width
 */
function heightOf(width) {
  const fontSize = Math.min(34, Math.max(12, 0.052 * width));
  const lines = width < MIN_FOOT_PX ? 2 : 4;
  return 0.75 * (width - 2) + lines * fontSize + 4;
}

/**
 * Return the largest width of a card of a height.
 * @param {number} height
 */
function widthOf(height) {
  let width = (height / 0.75) | 0;
  while (width > 0 && heightOf(width) > height) width -= 1;
  return width;
}
