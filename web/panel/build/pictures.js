/** Small pictures for the gallery of blocks: a robot seen from above, and what a block does for it. */

import { icon } from "../../shared/icons.js";

const SVG = "http://www.w3.org/2000/svg";

/** @typedef {[kind: string, data: string]} Stroke a class of styles/panel/build.css, and path data on a grid of 96 x 60 */

/** @type {(x: number, y: number, r: number) => string} */
const circle = (x, y, r) => `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`;
/** @type {Stroke} */
const ROBOT = ["robot", circle(22, 30, 10)];
/** @type {Stroke} */
const NOSE = ["nose", "M22 30h9"];
/** @type {Stroke} */
const BALL = ["thing", circle(76, 16, 7)];
/** @type {Stroke} */
const WALL = ["thing", "M80 6h8v48h-8z"];

/**
 * Strokes by name.
 * @type {Record<string, Stroke[]>}
 */
const PICTURES = {
  bearing: [BALL, ["hot", "M32 27L66 18M58 15l9 3-6 7"]],
  smell: [BALL, ["hot", "M62 22c-6-4-8 6-14 2s-8 6-12 3M64 30c-6-4-8 6-14 2s-8 6-12 3"]],
  presence: [BALL, ["hot", "M40 32l7 8 14-16"], ["soft", circle(76, 46, 7)]],
  rays: [WALL, ["hot", "M32 26L80 12M32 29l48-5M32 32l48 4M32 34l48 14"]],
  picture: [WALL, ["hot", "M32 26L80 8M32 34l48 18M46 22v18M60 18v26"], ["soft", "M46 28h14M46 34h14"]],
  map: [["soft", "M44 6h46v48H44zM55.5 6v48M67 6v48M78.5 6v48M44 18h46M44 30h46M44 42h46"], ["thing", "M67 18h11.5v12H67z"]],
  lamp: [["lamp", circle(76, 30, 7)], ["hot", "M66 30h-8M69 23l-6-5M69 37l-6 5M76 20v-6M76 40v6"]],
  line: [["line", "M4 50C30 50 30 12 58 12h34"], ["hot", "M36 34v.1M40 30v.1M44 26v.1"]],
  eye: [["soft", "M42 34h48v16H42z"], ["thing", "M58 34h16v16H58z"], ["hot", "M66 6v20M60 20l6 6 6-6"]],
  hear: [["thing", circle(82, 30, 8)], ["hot", "M68 20c-5 6-5 14 0 20M60 14c-8 9-8 23 0 32M52 8c-11 12-11 32 0 44"]],
  speak: [["hot", "M40 20c5 6 5 14 0 20M48 14c8 9 8 23 0 32M56 8c11 12 11 32 0 44"], ["soft", circle(82, 30, 8)]],
  pen: [["hot", "M38 44c8-30 16 12 24-8s10-14 18-4"], ["fill", "M78 34l3-10 10-12 6 5-10 12z"]],
  touch: [["thing", "M33 12h14v36H33z"], ["hot", "M52 18l8-6M54 30h10M52 42l8 6"]],
  ground: [["soft", "M4 44h56v10H4zM60 44v10"], ["hot", "M22 42v8M16 46l6 6 6-6"]],
  compass: [["soft", circle(70, 30, 20)], ["hot", "M62 42l5-15 11-9-5 15z"], ["soft", "M70 4v6"]],
  position: [["soft", "M44 54V8M44 54h46M44 38h46M60 54V8M76 54V8"], ["hot", "M76 38c-5-7-7-10-7-14a7 7 0 0 1 14 0c0 4-2 7-7 14"]],
  cell: [["soft", "M6 8h84v44H6zM34 8v44M62 8v44M6 30h84"], ["hot", "M34 30h28v22H34z"]],
  speed: [["hot", "M38 30h34M62 22l10 8-10 8"], ["soft", "M4 22h6M2 30h6M4 38h6"]],
  need: [["soft", "M48 14h40v10H48zM48 36h40v10H48z"], ["fill", "M48 14h28v10H48zM48 36h12v10H48z"]],
  memory: [["soft", "M42 30a22 22 0 1 0 8-17M50 6v8h8"], ["hot", "M64 18v12l8 6"]],
  star: [["lamp", "M68 10l6 13 14 1.5-10.5 9.5 3 14L68 41l-12.5 7 3-14L48 24.5 62 23z"]],
  clock: [["soft", circle(68, 30, 21)], ["hot", "M68 16v14l9 6"]],
  end: [["soft", "M52 54V6"], ["fill", "M52 8h12v8h12v8H64v-8H52zM64 8h12v8H64zM52 24h12v-8H52z"]],
  text: [["soft", "M44 16h44v28H44z"], ["hot", "M52 30h28M52 37h18M52 23h22"]],
  script: [["soft", "M44 8h44v44H44z"], ["hot", "M58 22l-8 8 8 8M74 22l8 8-8 8M68 20l-4 20"]],
  row: [["soft", "M42 18h14v24H42zM60 18h14v24H60zM78 18h14v24H78z"], ["hot", "M46 36v-8M50 36v-4M64 36v-14M68 36v-6M82 36v-4M86 36v-10"]],
  drive: [["hot", "M36 30h26M54 22l9 8-9 8M22 16V6M17 10l5-5 5 5M22 44v10M17 50l5 5 5-5"]],
  wheels: [["fill", "M13 16h18v4H13zM13 40h18v4H13z"], ["hot", "M38 20h22M54 15l7 5-7 5M38 42h12M45 37l7 5-7 5"]],
  car: [["soft", "M40 20h44v20H40z"], ["fill", "M46 15h9v5h-9zM46 40h9v5h-9zM72 14l8 3-1.5 4-8-3zM72 44l8-3-1.5-4-8 3z"], ["hot", "M86 24c6-2 8-6 8-12"]],
  grab: [["hot", "M32 22h10v-4M32 38h10v4"], ["thing", "M42 22h16v16H42z"]],
  collect: [["thing", circle(48, 18, 4)], ["thing", circle(62, 32, 4)], ["thing", circle(78, 22, 4)], ["hot", "M76 44c-10 8-24 8-34 2M46 40l-6 6 6 6"]],
  target: [["hot", circle(72, 30, 20)], ["hot", circle(72, 30, 11)], ["fill", circle(72, 30, 3)]],
  area: [["dashed", "M52 8h38v44H52z"], ["thing", "M63 22h16v16H63z"]],
  route: [["hot", "M32 30h8c10 0 6-16 16-16s6 32 16 32h12"], ["fill", circle(56, 14, 3)], ["fill", circle(72, 46, 3)]],
  fall: [["soft", "M4 42h42v14M46 42v14"], ["hot", "M34 26c16-4 26 4 28 20M56 40l6 8 7-7"]],
  closer: [BALL, ["hot", "M34 38h30M56 31l9 7-9 7"], ["soft", "M34 50h30"]],
  still: [["soft", "M8 48h28"], ["hot", "M52 20v20M62 20v20"]],
  check: [["soft", "M46 10h40v40H46z"], ["hot", "M54 30l8 9 16-18"]],
  brain: [["soft", "M52 30h6M52 18h6M52 42h6M84 30h6"], ["hot", "M60 12h24v36H60z"], ["soft", "M66 20h12M66 28h12M66 36h8"]],
  keys: [["soft", "M60 8h14v14H60zM43 25h14v14H43zM60 25h14v14H60zM77 25h14v14H77z"], ["hot", "M67 18v-6M64 15l3-3 3 3"]],
  network: [["soft", "M52 14l16 10M52 30l16-6M52 46l16-22M52 14l16 24M52 30l16 8M52 46l16-8M68 24l16 6M68 38l16-8"], ["fill", circle(52, 14, 3)], ["fill", circle(52, 30, 3)], ["fill", circle(52, 46, 3)], ["fill", circle(68, 24, 3)], ["fill", circle(68, 38, 3)], ["fill", circle(84, 30, 3)]],
};
/** Pictures without the robot: it would be in the way. */
const WITHOUT_ROBOT = new Set(["cell"]);

/**
 * Return a picture of 96 x 60; an icon if there is no picture of that name.
 * @param {string} name
 */
export function picture(name) {
  const strokes = PICTURES[name];
  if (strokes === undefined) return icon(name, 32);
  const svg = document.createElementNS(SVG, "svg");
  const attributes = { viewBox: "0 0 96 60", width: 96, height: 60, "aria-hidden": "true", class: "ai4u-picture" };
  for (const [key, value] of Object.entries(attributes)) svg.setAttribute(key, String(value));
  for (const [kind, data] of WITHOUT_ROBOT.has(name) ? strokes : [...strokes, ROBOT, NOSE]) {
    const path = document.createElementNS(SVG, "path");
    path.setAttribute("class", kind);
    path.setAttribute("d", data);
    svg.append(path);
  }
  return svg;
}
