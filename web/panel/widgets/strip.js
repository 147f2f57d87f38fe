/** Many numbers side by side as a strip of bars, drawn on a canvas; its older readings above, smaller. */

/** @import { ReadingStrip } from "../../generated/messages.js" */
import { element, setText } from "../../shared/dom.js";

const HEIGHT = 40;
const OLDER_HEIGHT = 14;
/** Width of the drawing in CSS pixels; the page stretches it. */
const WIDTH = 280;

/** @typedef {HTMLElement & {drawn?: string}} Strip with what was drawn last, as JSON */

/** @returns {Strip} */
export function makeStrip() {
  return element("figure", {}, element("div"), element("figcaption"));
}

/**
 * Draw the bars of a strip.
 * @param {Strip} figure
 * @param {ReadingStrip} strip
 */
export function drawStrip(figure, { caption, zeros, shares, colours, older = [] }) {
  const accent = getComputedStyle(document.querySelector(".ai4u-panel")).getPropertyValue("--accent");
  const key = JSON.stringify([shares, colours, older, accent]);
  const [drawings, words] = figure.children;
  setText(words, caption);
  if (figure.drawn === key) return;
  figure.drawn = key;
  while (drawings.children.length > older.length + 1) drawings.lastChild.remove();
  while (drawings.children.length <= older.length) drawings.append(element("canvas", { ariaHidden: "true" }));
  const canvases = /** @type {HTMLCollectionOf<HTMLCanvasElement>} */ (drawings.children);
  for (const [index, earlier] of older.entries()) draw(canvases[index], earlier, zeros, null, accent, OLDER_HEIGHT);
  draw(canvases[older.length], shares, zeros, colours, accent, HEIGHT);
}

/**
 * @param {HTMLCanvasElement} canvas
 * @param {number[]} shares position of each number in its range, 0 to 1
 * @param {number[]} zeros position of zero in each range
 * @param {string[] | null} colours of the bars; null for one colour
 * @param {string} accent that colour
 * @param {number} height in CSS pixels
 */
function draw(canvas, shares, zeros, colours, accent, height) {
  const scale = devicePixelRatio;
  canvas.width = WIDTH * scale; // assigning also clears it
  canvas.height = height * scale;
  canvas.style.height = `${height}px`;
  const context = canvas.getContext("2d");
  context.scale(scale, scale);
  const width = WIDTH / shares.length;
  const gap = width > 3 ? 1 : 0;
  for (const [index, share] of shares.entries()) {
    context.fillStyle = colours?.[index] ?? accent;
    const [from, to] = [zeros[index], share].sort((one, other) => one - other);
    const size = Math.max((to - from) * height, colours ? 3 : 1); // a thin line shows the colour of what is at zero
    context.fillRect(index * width, Math.min(height - to * height, height - size), width - gap, size);
  }
}
