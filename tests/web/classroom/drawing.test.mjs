import assert from "node:assert/strict";
import { test } from "node:test";

globalThis.Path2D = class {
  arc() {}
  lineTo() {}
  closePath() {}
};
const { Drawing } = await import("../../../web/classroom/wall/drawing.js");

const SHAPE = { colour: "red", radius: 0.2, points: [0, 0] };
const BOX = { x: 0, y: 0, width: 400, height: 200 };
/** Pixels of a metre, and where the world's origin is, in this box. */
const [SCALE, X, Y] = [97, 6, 197];

function drawing(isAgent = false) {
  return new Drawing({ number: 1, bounds: [0, 0, 4, 2], ground: [], bodies: [{ is_agent: isAgent, shapes: [SHAPE] }] });
}

/** Return the poses in which bodies are drawn at a time: [x, y, heading]; and how many edges are drawn. */
function drawn(it, now) {
  const poses = [];
  let [transform, edges] = [[], 0];
  const context = {
    ...{ save() {}, restore() {}, beginPath() {}, rect() {}, clip() {} },
    setTransform: (...to) => (transform = to),
    stroke: () => (edges += 1),
    fill() {
      const [a, b, , , x, y] = transform;
      poses.push([(x - X) / SCALE, (Y - y) / SCALE, Math.atan2(-b, a)].map((value) => Math.round(1000 * value) / 1000));
    },
  };
  it.draw(context, BOX, now);
  return { poses, edges };
}

test("a body stands where its pose is, and one that fell is not drawn", () => {
  const it = drawing();
  assert.deepEqual(drawn(it, 0).poses, []);
  it.setPoses([1, 0.5, 0.7, 1], 0, true);
  assert.deepEqual(drawn(it, 0).poses, [[1, 0.5, 0.7]]);
  it.setPoses([1, 0.5, 0.7, 0], 0, false);
  assert.deepEqual(drawn(it, 0).poses, []);
});

test("a body glides from one pose to the next", () => {
  const it = drawing();
  it.setPoses([1, 1, 0, 1], 0, true);
  it.setPoses([1.4, 1.2, 0.8, 1], 1000, true);
  assert.deepEqual([1000, 1125, 1250, 9000].map((now) => drawn(it, now).poses[0]), [[1, 1, 0], [1.2, 1.1, 0.4], [1.4, 1.2, 0.8], [1.4, 1.2, 0.8]]);
  assert.deepEqual([1125, 1250].map((now) => it.isMoving(now)), [true, false]);
});

test("a pose that comes on the way is reached from there", () => {
  const it = drawing();
  it.setPoses([1, 1, 0, 1], 0, true);
  it.setPoses([1.4, 1, 0, 1], 1000, true);
  it.setPoses([1, 1, 0, 1], 1125, true);
  assert.deepEqual([1125, 1250].map((now) => drawn(it, now).poses[0][0]), [1.2, 1.1]);
});

test("a body turns the shorter way round", () => {
  const it = drawing();
  it.setPoses([1, 1, 3, 1], 0, true);
  it.setPoses([1, 1, -2.9, 1], 1000, true);
  const [[, , heading]] = drawn(it, 1125).poses;
  assert.equal(heading, -3.092); // past the half turn, not through 0
});

test("a body that was put elsewhere, or must not glide, is there at once", () => {
  const it = drawing();
  it.setPoses([0.5, 1, 0, 1], 0, true);
  it.setPoses([3.5, 1, 0, 1], 1000, true);
  assert.deepEqual(drawn(it, 1000).poses, [[3.5, 1, 0]]);
  it.setPoses([3.6, 1, 0, 1], 2000, false);
  assert.deepEqual([drawn(it, 2000).poses, it.isMoving(2000)], [[[3.6, 1, 0]], false]);
});

test("agents alone have an edge", () => {
  const edges = [false, true].map((isAgent) => {
    const it = drawing(isAgent);
    it.setPoses([1, 1, 0, 1], 0, true);
    return drawn(it, 0).edges;
  });
  assert.deepEqual(edges, [0, 1]);
});
