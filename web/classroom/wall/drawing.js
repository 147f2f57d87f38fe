/** The drawing of one room on the wall: its ground and bodies, with poses interpolated between two messages. */

/** @import { DrawingMessage, Shape } from "../../types/class.js" */
/** @import { Box } from "./canvas.js" */

/** Time between two poses of a room; the class sends 4 a second. */
const STEP_MS = 250;
/** Part of the drawing's size that a body moves in a step only if it was put there. */
const JUMP = 0.2;
/** Color of an agent's edge, which stands out from the ground. */
const EDGE = "#1b2530";
/** Part of a box that a drawing fills. */
const FILLED = 0.97;
const VALUES_PER_BODY = 4; // x, y (m), heading (rad), visibility

/** @typedef {{colour: string, path: Path2D}} Painted */
/** @typedef {{isAgent: boolean, shapes: Painted[]}} Body */

export class Drawing {
  #bounds;
  #ground;
  #bodies;
  #jump;
  /** @type {number[] | null} */
  #from = null;
  /** @type {number[] | null} */
  #to = null;
  #since = -STEP_MS;

  /** @param {DrawingMessage} message */
  constructor({ number, bounds, ground, bodies }) {
    this.number = number;
    this.#bounds = bounds;
    const [left, bottom, right, top] = bounds;
    this.#jump = JUMP * Math.hypot(right - left, top - bottom);
    this.#ground = ground.map(painted);
    this.#bodies = bodies.map((body) => ({
      isAgent: body.is_agent,
      shapes: body.shapes.map(painted),
    }));
  }

  /**
   * Take poses.
   * @param {number[]} values four numbers for each body
   * @param {number} now (ms)
   * @param {boolean} glides else they are shown at once
   */
  setPoses(values, now, glides) {
    this.#from = this.#to && glides ? this.#posesAt(now) : values;
    this.#to = values;
    this.#since = now;
  }

  /**
   * Return true while bodies are between two poses.
   * @param {number} now (ms)
   */
  isMoving(now) {
    return this.#from !== this.#to && now < this.#since + STEP_MS;
  }

  /**
   * Draw into a box of a canvas, as large as fits.
   * @param {CanvasRenderingContext2D} context
   * @param {Box} box
   * @param {number} now (ms)
   */
  draw(context, box, now) {
    const [left, bottom, right, top] = this.#bounds;
    const scale = FILLED * Math.min(box.width / (right - left || 1), box.height / (top - bottom || 1));
    const x = box.x + box.width / 2 - (scale * (left + right)) / 2;
    const y = box.y + box.height / 2 + (scale * (bottom + top)) / 2;
    /** @type {[number, number, number]} */
    const place = [scale, x, y];
    context.save();
    context.beginPath();
    context.rect(box.x, box.y, box.width, box.height);
    context.clip();
    context.setTransform(scale, 0, 0, -scale, x, y); // y points up in the world
    for (const shape of this.#ground) fill(context, shape);
    const poses = this.#posesAt(now) ?? [];
    this.#bodies.forEach((body, index) => {
      const [bodyX = 0, bodyY = 0, heading = 0, isVisible = 0] = poses.slice(index * VALUES_PER_BODY);
      if (isVisible) drawBody(context, body, place, [bodyX, bodyY, heading]);
    });
    context.restore();
  }

  /** @param {number} now (ms) */
  #posesAt(now) {
    const share = Math.max(0, Math.min(1, (now - this.#since) / STEP_MS)); // a frame's time may lie before it
    if (share >= 1 || this.#from === this.#to || this.#from?.length !== this.#to?.length) return this.#to;
    const shown = this.#to.slice();
    for (let at = 0; at + 2 < shown.length; at += VALUES_PER_BODY) {
      const way = [0, 1, 2].map((each) => this.#to[at + each] - this.#from[at + each]);
      if (Math.hypot(way[0], way[1]) > this.#jump) continue;
      way[2] -= 2 * Math.PI * Math.round(way[2] / (2 * Math.PI)); // the shorter way round
      for (const each of [0, 1, 2]) shown[at + each] = this.#from[at + each] + share * way[each];
    }
    return shown;
  }
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Body} body
 * @param {[number, number, number]} place scale, x and y of the drawing
 * @param {[number, number, number]} pose
 */
function drawBody(context, body, [scale, x, y], [bodyX, bodyY, heading]) {
  const cos = scale * Math.cos(heading);
  const sin = scale * Math.sin(heading);
  context.setTransform(cos, -sin, -sin, -cos, x + scale * bodyX, y - scale * bodyY);
  if (body.isAgent) outline(context, body.shapes, EDGE, 3 / scale);
  for (const shape of body.shapes) fill(context, shape);
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Painted[]} shapes
 * @param {string} colour
 * @param {number} width
 */
function outline(context, shapes, colour, width) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.lineJoin = "round";
  for (const { path } of shapes) context.stroke(path);
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Painted} shape
 */
function fill(context, { colour, path }) {
  context.fillStyle = colour;
  context.fill(path);
}

/**
 * @param {Shape} shape
 * @returns {Painted}
 */
function painted({ colour, radius, points }) {
  const path = new Path2D();
  if (radius > 0) path.arc(points[0], points[1], radius, 0, 2 * Math.PI);
  else {
    for (let at = 0; at + 1 < points.length; at += 2) path.lineTo(points[at], points[at + 1]);
    path.closePath();
  }
  return { colour, path };
}
