import assert from "node:assert/strict";
import { test } from "node:test";

import { Ground, onGrid } from "../../../web/panel/world/ground.js";

// a camera 10 m above (3, 4) that looks down and sees 20 m x 10 m
const FROM_ABOVE = [20, 0, -7, 0, -10, 9, 0, 0, 1];
// one that looks ahead along +y and down: the horizon is at the upper edge
const TILTED = [10, 0, -5, 0, 0, 5, 0, 1, 0];
const RECT = { left: 100, top: 50, width: 400, height: 200 };

/** @type {(a: {x: number, y: number}, b: {x: number, y: number}) => void} */
function near(a, b) {
  assert.ok(Math.hypot(a.x - b.x, a.y - b.y) < 1e-6, `${JSON.stringify(a)} is not ${JSON.stringify(b)}`);
}

test("a point of the picture is a point of the ground, and back", () => {
  const ground = new Ground(FROM_ABOVE, RECT);
  near(ground.at({ x: 300, y: 150 }), { x: 3, y: 4 });
  near(ground.at({ x: 100, y: 50 }), { x: -7, y: 9 });
  near(ground.seen({ x: 3, y: 4 }), { x: 300, y: 150 });
  const tilted = new Ground(TILTED, RECT);
  for (const place of [{ x: 300, y: 100 }, { x: 120, y: 240 }]) near(tilted.seen(tilted.at(place)), place);
});

test("the sky and what lies behind the camera are no places", () => {
  const tilted = new Ground(TILTED, RECT);
  assert.equal(tilted.at({ x: 300, y: 50 }), null);
  assert.equal(tilted.at({ x: 300, y: 0 }), null);
  assert.equal(tilted.seen({ x: 0, y: -5 }), null);
});

test("a picture of a thing lies on the ground as the camera sees it", () => {
  const matrix = new Ground(FROM_ABOVE, RECT).matrixAt({ x: 3, y: 4 });
  assert.deepEqual(matrix.map((number) => Math.round(number * 1e6) / 1e6 + 0), [20, 0, 0, 20, 300, 150]);
});

test("a place is rounded to the grid, or to a centimetre", () => {
  assert.deepEqual(onGrid({ x: 1.26, y: -0.7 }, 0.5), { x: 1.5, y: -0.5 });
  assert.deepEqual(onGrid({ x: 1.2649, y: -0.7 }, 0), { x: 1.26, y: -0.7 });
});
