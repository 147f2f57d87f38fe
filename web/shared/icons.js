/** Icons of the panel: strokes on a grid of 24 x 24, one path each. */

const SVG = "http://www.w3.org/2000/svg";

/** @type {(x: number, y: number, radius: number) => string} */
const circle = (x, y, radius) => `M${x - radius} ${y}a${radius} ${radius} 0 1 0 ${2 * radius} 0a${radius} ${radius} 0 1 0 ${-2 * radius} 0`;

/**
 * Path data by name. The first part is for blocks: ai4u_edu/page/panel/block_words.py names them.
 * @type {Record<string, string>}
 */
const PATHS = {
  bearing: `${circle(6, 18, 3)}M8.5 15.5L19 5M13 5h6v6`,
  smell: "M4 18c3-6 3 2 6-4s3 2 6-4 2 0 4-2M4 11c3-6 3 2 6-4s3 2 6-3",
  presence: `${circle(12, 12, 8)}M8.5 12l2.5 3 4.5-6`,
  rays: `${circle(5, 12, 2)}M8 11L20 4M8 12h13M8 13l12 7`,
  picture: `M3 5h18v14H3zM3 16l5-5 4 4 3-3 6 5${circle(15.5, 9, 1.5)}`,
  map: "M4 4h16v16H4zM4 9.3h16M4 14.6h16M9.3 4v16M14.6 4v16",
  lamp: "M9 18h6M10 21h4M12 3a6 6 0 0 0-3.5 10.8c.4.4.5 1.2.5 2.2h6c0-1 .1-1.8.5-2.2A6 6 0 0 0 12 3",
  line: "M4 20C10 18 6 10 12 9s5-3 8-5M9 21l2-3M14 21l2-3",
  touch: `${circle(9, 12, 5)}M17 6v12M20 9v6`,
  ground: `${circle(12, 9, 4)}M4 17h16M7 17l-2 3M12 17l-2 3M17 17l-2 3`,
  compass: `${circle(12, 12, 9)}M12 5l3 7-3 7-3-7zM9 12h6`,
  position: `M12 21c-4-5-6-8-6-11a6 6 0 0 1 12 0c0 3-2 6-6 11${circle(12, 10, 2)}`,
  cell: `M4 4h16v16H4zM12 4v16M4 12h16${circle(8, 8, 1.5)}`,
  speed: "M4 17a8 8 0 1 1 16 0M12 16l4-6M7 17h.1M17 17h.1M12 9h.1",
  need: "M12 20C5 15 3.5 12 3.5 9A4.3 4.3 0 0 1 12 7a4.3 4.3 0 0 1 8.5 2c0 3-1.5 6-8.5 11",
  memory: "M4 12a8 8 0 1 0 3-6.2M4 4v4h4M12 8v5l3 2",
  star: "M12 3l2.7 6 6.3.6-4.8 4.2 1.5 6.4L12 16.8 6.3 20.2l1.5-6.4L3 9.6 9.3 9z",
  hear: `${circle(18, 12, 3)}M11.5 8a6 6 0 0 0 0 8M7.5 5a11 11 0 0 0 0 14`,
  speak: `${circle(6, 12, 3)}M12.5 8a6 6 0 0 1 0 8M16.5 5a11 11 0 0 1 0 14`,
  sound: "M4 9.5h3.5L12 5v14l-4.5-4.5H4zM15.5 9a4 4 0 0 1 0 6M18 6.5a8 8 0 0 1 0 11",
  mute: "M4 9.5h3.5L12 5v14l-4.5-4.5H4zM16 9.5l5 5M21 9.5l-5 5",
  clock: `${circle(12, 12, 8.5)}M12 7v5l3.5 2`,
  end: "M5 21V4M5 5h13l-3 4 3 4H5",
  text: "M5 6h14M12 6v13M9 19h6",
  script: "M8 7l-5 5 5 5M16 7l5 5-5 5M13.5 5l-3 14",
  row: "M3 9h5v6H3zM9.5 9h5v6h-5zM16 9h5v6h-5z",
  drive: "M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3",
  wheels: `M7 6h10v12H7zM4 8v8M20 8v8M12 6v5M10 8.5l2-2.5 2 2.5`,
  car: `M3 16v-4l3-1 2-4h8l3 4 2 1v4z${circle(8, 16.5, 2)}${circle(16, 16.5, 2)}`,
  pen: "M4 20l1.2-4.8L16 4.4a2 2 0 0 1 2.8 0l.8.8a2 2 0 0 1 0 2.8L8.8 18.8zM14 6.5l3.5 3.5",
  grab: "M6 12V8M10 11V5M14 11V5M18 12V8M6 12v3a6 6 0 0 0 12 0v-3M10 11v1M14 11v1",
  collect: `M4 11h16l-2 9H6zM12 3v6M9.5 6.5L12 9l2.5-2.5`,
  target: `${circle(12, 12, 8.5)}${circle(12, 12, 4.5)}M12 12h.1`,
  area: "M4 8V4h4M16 4h4v4M20 16v4h-4M8 20H4v-4M9 9h6v6H9z",
  route: `${circle(6, 18, 2)}${circle(18, 6, 2)}M8 18h6a3 3 0 0 0 0-6h-4a3 3 0 0 1 0-6h6`,
  fall: "M3 8h8v12M15 6v10M12 13l3 3 3-3M15 20h.1",
  closer: `${circle(19, 12, 2)}M3 12h11M10 8l4 4-4 4`,
  still: "M7 7h10v10H7zM3 21h18",
  check: "M4 5h16v14H4zM8 12l3 3 5-6",
  brain: "M12 5v14M12 5a3 3 0 0 0-5 2 3 3 0 0 0-2 5 3 3 0 0 0 2 5 3 3 0 0 0 5 2M12 5a3 3 0 0 1 5 2 3 3 0 0 1 2 5 3 3 0 0 1-2 5 3 3 0 0 1-5 2",
  keys: "M9 4h6v6H9zM2 13h6v6H2zM9 13h6v6H9zM16 13h6v6h-6z",
  network: `${circle(5, 6, 2)}${circle(5, 18, 2)}${circle(12, 12, 2)}${circle(19, 12, 2)}M6.5 7.4l4 3.3M6.5 16.6l4-3.3M14 12h3`,
  own: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9",

  add: "M12 5v14M5 12h14",
  eye: `M2 12c3-5 6-7 10-7s7 2 10 7c-3 5-6 7-10 7s-7-2-10-7${circle(12, 12, 3)}`,
  up: "M6 15l6-6 6 6",
  down: "M6 9l6 6 6-6",
  trash: "M4 7h16M9 7V4h6v3M6 7l1 13h10l1-13M10 11v5M14 11v5",
  copy: "M8 8h12v12H8zM16 8V4H4v12h4",
  duplicate: "M8 8h12v12H8zM16 8V4H4v12h4M14 11v6M11 14h6",
  paste: "M7 5H5v16h14V5h-2M9 3h6v4H9zM9 12h6M9 16h6",
  align_row: "M3 12h18M5 8h4v8H5zM14 6h5v12h-5z",
  align_column: "M12 3v18M8 5h8v4H8zM6 14h12v5H6z",
  spread: "M3 5v14M21 5v14M9 8h6v8H9z",
  power: "M12 3v8M7 6a8 8 0 1 0 10 0",
  undo: "M8 5L4 9l4 4M4 9h10a5 5 0 0 1 0 10H9",
  redo: "M16 5l4 4-4 4M20 9H10a5 5 0 0 0 0 10h5",
  save: "M5 4h11l3 3v13H5zM8 4v5h7V4M8 20v-6h8v6",
  phone: "M7 3h10v18H7zM10.5 18h3",
  download: "M12 4v11M7 10l5 5 5-5M5 20h14",
  upload: "M12 15V4M7 9l5-5 5 5M5 20h14",
  open: "M3 19V6h6l2 2h8v3M3 19l3-8h16l-3 8z",
  scenes: "M4 4h7v7H4zM13 4h7v7h-7zM4 13h7v7H4zM13 13h7v7h-7z",
  pin: "M9 4h6l-1 6 3 3H7l3-3zM12 13v7",
  play: "M7 5l12 7-12 7z",
  pause: "M8.5 5v14M15.5 5v14",
  stop: "M7 7h10v10H7z",
  back: "M17 5L9 12l8 7zM6 5v14",
  forward: "M7 5l8 7-8 7zM18 5v14",
  live: `${circle(12, 12, 3)}M6 6a8.5 8.5 0 0 0 0 12M18 6a8.5 8.5 0 0 1 0 12`,
  proceed: "M4 6v12M8 6l11 6-11 6z",
  race: "M5 21V3M5 4h14v9H5M12 4v9M5 8.5h14",
  remove: "M6 6l12 12M18 6L6 18",
  person: `${circle(12, 8, 4)}M4 21a8 8 0 0 1 16 0`,
  wall: "M3 7h18v10H3zM3 12h18M9 7v5M15 7v5M12 12v5",
  box: "M5 5h14v14H5z",
  ball: `${circle(12, 12, 8)}M12 4c4 4 4 12 0 16`,
  floor: "M3 15l7-8h11l-6 8zM3 15v3h12l6-8V7",
  agent: `${circle(12, 12, 8)}M12 12l7-1M9 9h.1M9 15h.1`,
};

/**
 * Return an icon. It says nothing to screen readers: the control that has it has a name.
 * @param {string} name one of PATHS; another one gets the icon for blocks of one's own
 */
export function icon(name, size = 18) {
  const svg = document.createElementNS(SVG, "svg");
  const attributes = { viewBox: "0 0 24 24", width: size, height: size, "aria-hidden": "true", class: "ai4u-icon" };
  for (const [key, value] of Object.entries(attributes)) svg.setAttribute(key, String(value));
  const path = document.createElementNS(SVG, "path");
  path.setAttribute("d", PATHS[name] ?? PATHS.own);
  svg.append(path);
  return svg;
}
