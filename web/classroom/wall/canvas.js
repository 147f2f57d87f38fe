/**
 * The one canvas of a wall, on which all rooms are drawn, behind the cards' empty picture areas.
 *
 * It covers what is in view and a margin, and moves in steps: so scrolling moves it with the page. A room is
 * drawn again only if something in it changed and it is in view.
 */

/** @import { DrawingMessage, Poses } from "../../types/class.js" */

import { Drawing } from "./drawing.js";

/** Part of the window's height that the canvas extends beyond it, above and below. */
const MARGIN = 0.3;

/** @typedef {{x: number, y: number, width: number, height: number}} Box in the canvas's pixels */

export class WallCanvas {
  #wall;
  #canvas;
  #context;
  /**
   * Drawings by room, kept while a room isn't shown.
   * @type {Map<string, Drawing>}
   */
  #drawings = new Map();
  /**
   * Poses that came before their drawing.
   * @type {Map<string, Poses>}
   */
  #early = new Map();
  /**
   * Picture areas by room.
   * @type {Map<string, Element>}
   */
  #areas = new Map();
  /** @type {Map<string, Box>} */
  #boxes = new Map();
  /** @type {Set<string>} */
  #dirty = new Set();
  #isLaidOut = false;
  #frame = 0;
  #top = 0;
  #ratio = 1;
  #background = "";
  #still = matchMedia("(prefers-reduced-motion: reduce)");

  /**
   * @param {HTMLElement} wall positioned; its size is the canvas's width
   * @param {HTMLCanvasElement} canvas in the wall
   */
  constructor(wall, canvas) {
    this.#wall = wall;
    this.#canvas = canvas;
    this.#context = canvas.getContext("2d");
    new ResizeObserver(() => this.layOut()).observe(wall);
    addEventListener("scroll", () => this.#request(), { passive: true, capture: true });
    addEventListener("resize", () => this.layOut());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.layOut());
  }

  /**
   * Show these rooms.
   * @param {Map<string, Element>} areas picture areas by room
   */
  show(areas) {
    this.#areas = areas;
    this.layOut();
  }

  /** Measure the picture areas and draw all rooms again; to be called after something moved. */
  layOut() {
    this.#isLaidOut = false;
    this.#request();
  }

  /** @param {DrawingMessage} message */
  setDrawing(message) {
    const drawing = new Drawing(message);
    this.#drawings.set(message.room, drawing);
    const early = this.#early.get(message.room);
    if (early?.drawing === message.number) drawing.setPoses(early.values, performance.now(), false);
    this.#early.delete(message.room);
    this.#markDirty(message.room);
  }

  /**
   * Take poses.
   * @param {Record<string, Poses>} rooms by room
   */
  setPoses(rooms) {
    const now = performance.now();
    for (const [room, poses] of Object.entries(rooms)) {
      const drawing = this.#drawings.get(room);
      if (drawing?.number === poses.drawing) drawing.setPoses(poses.values, now, !this.#still.matches);
      else this.#early.set(room, poses);
      this.#markDirty(room);
    }
  }

  /**
   * Forget the drawings of all rooms but these.
   * @param {string[]} rooms
   */
  keepOnly(rooms) {
    const kept = new Set(rooms);
    for (const map of [this.#drawings, this.#early]) {
      for (const room of map.keys()) if (!kept.has(room)) map.delete(room);
    }
  }

  /** @param {string} room */
  #markDirty(room) {
    this.#dirty.add(room);
    if (this.#areas.has(room)) this.#request();
  }

  #request() {
    if (this.#frame === 0) this.#frame = requestAnimationFrame((now) => this.#draw(now));
  }

  /** @param {number} now (ms) */
  #draw(now) {
    this.#frame = 0;
    const wall = this.#wall.getBoundingClientRect();
    if (wall.width === 0) return; // another tab of the page is shown; showing the wall lays it out
    const above = -wall.top; // of the window's top edge, in the wall
    const margin = MARGIN * innerHeight;
    const isInside = above >= this.#top && above + innerHeight <= this.#top + innerHeight + 2 * margin;
    if (!this.#isLaidOut || !isInside) this.#place(wall, above - margin, innerHeight + 2 * margin);
    for (const room of this.#dirty) {
      const box = this.#boxes.get(room);
      if (!box) {
        this.#dirty.delete(room);
        continue;
      }
      if (!isInView(box, above, this.#ratio, this.#top)) continue; // it stays dirty until it is
      this.#context.fillStyle = this.#background;
      this.#context.fillRect(box.x, box.y, box.width, box.height);
      const drawing = this.#drawings.get(room);
      drawing?.draw(this.#context, box, now);
      if (!drawing?.isMoving(now)) this.#dirty.delete(room);
      else this.#request();
    }
  }

  /**
   * Put the canvas at a height of the wall, clear it, and measure where rooms are.
   * @param {DOMRect} wall
   * @param {number} top
   * @param {number} height
   */
  #place(wall, top, height) {
    this.#isLaidOut = true;
    this.#top = Math.round(top);
    this.#ratio = Math.min(2, devicePixelRatio);
    const pixels = (/** @type {number} */ length) => Math.round(length * this.#ratio);
    this.#canvas.style.top = `${this.#top}px`;
    this.#canvas.style.height = `${Math.round(height)}px`;
    this.#canvas.width = pixels(wall.width);
    this.#canvas.height = pixels(Math.round(height));
    this.#background = getComputedStyle(this.#canvas).color;
    this.#boxes.clear();
    for (const [room, area] of this.#areas) {
      const rect = area.getBoundingClientRect();
      const y = rect.top - wall.top - this.#top;
      this.#boxes.set(room, {
        x: pixels(rect.left - wall.left),
        y: pixels(y),
        width: pixels(rect.width),
        height: pixels(rect.height),
      });
    }
    this.#dirty = new Set(this.#areas.keys());
  }
}

/**
 * Return true if a box of the canvas is in the window.
 * @param {Box} box
 * @param {number} above height of the wall above the window
 * @param {number} ratio
 * @param {number} canvasTop
 */
function isInView(box, above, ratio, canvasTop) {
  const top = box.y / ratio + canvasTop;
  return top < above + innerHeight && top + box.height / ratio > above;
}
