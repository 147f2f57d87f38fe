/** The map between a picture of the world and its ground, without elements. */

/** @typedef {{x: number, y: number}} Point in the world (m), or in the picture (px) */
/** @typedef {{left: number, top: number, width: number, height: number}} Rect the picture's place in the window (px) */

export class Ground {
  #toGround;
  #toPicture;
  #rect;

  /**
   * @param {number[]} matrix takes (across, down, 1), shares of the picture's width and height, to (w x, w y, w); row by row
   * @param {Rect} rect
   */
  constructor(matrix, rect) {
    this.#toGround = matrix;
    this.#toPicture = inverse(matrix);
    this.#rect = rect;
  }

  /**
   * Return the point of the ground (m) that a point of the window (px) shows; null for the sky.
   * @param {Point} place
   * @returns {Point | null}
   */
  at({ x, y }) {
    const { left, top, width, height } = this.#rect;
    return mapped(this.#toGround, (x - left) / width, (y - top) / height);
  }

  /**
   * Return the point of the window (px) that shows a point of the ground (m); null for one behind the camera.
   * @param {Point} place
   * @returns {Point | null}
   */
  seen({ x, y }) {
    const share = mapped(this.#toPicture, x, y);
    if (share === null) return null;
    const { left, top, width, height } = this.#rect;
    return { x: left + share.x * width, y: top + share.y * height };
  }

  /**
   * Return how a picture of a thing, seen from above with +x to the right, lies in the window: a CSS matrix() for an
   * element of one pixel for each metre whose middle is in the window's corner. Null for a place behind the camera.
   * @param {Point} place (m)
   * @returns {number[] | null}
   */
  matrixAt({ x, y }) {
    const [here, right, up] = [this.seen({ x, y }), this.seen({ x: x + 0.01, y }), this.seen({ x, y: y + 0.01 })];
    if (here === null || right === null || up === null) return null;
    const slope = (/** @type {Point} */ to) => [100 * (to.x - here.x), 100 * (to.y - here.y)];
    const [[ax, ay], [bx, by]] = [slope(right), slope(up)];
    return [ax, ay, -bx, -by, here.x, here.y];
  }
}

/**
 * Return a place on the grid.
 * @param {Point} place (m)
 * @param {number} snap distance of the grid (m); 0 for none
 */
export function onGrid({ x, y }, snap) {
  const step = snap || 0.01;
  const round = (/** @type {number} */ value) => Number((Math.round(value / step) * step).toFixed(3));
  return { x: round(x), y: round(y) };
}

/**
 * @param {number[]} m
 * @param {number} u
 * @param {number} v
 * @returns {Point | null}
 */
function mapped(m, u, v) {
  const w = m[6] * u + m[7] * v + m[8];
  if (!(w > 1e-9)) return null;
  return { x: (m[0] * u + m[1] * v + m[2]) / w, y: (m[3] * u + m[4] * v + m[5]) / w };
}

/**
 * Return the inverse of a 3 x 3 matrix, with the sign that keeps what lies ahead above 0.
 * @param {number[]} matrix
 */
function inverse([a, b, c, d, e, f, g, h, i]) {
  const [A, B, C] = [e * i - f * h, c * h - b * i, b * f - c * e];
  const [D, E, F] = [f * g - d * i, a * i - c * g, c * d - a * f];
  const [G, H, I] = [d * h - e * g, b * g - a * h, a * e - b * d];
  const determinant = a * A + b * D + c * G;
  return [A, B, C, D, E, F, G, H, I].map((number) => number / determinant);
}
