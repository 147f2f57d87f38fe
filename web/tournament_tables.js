/** Tables of a tournament's results, for the teacher's page and the projector page. */

import { element } from "./dom.js";

/** Most entries of a cross table that can be read. */
const MAX_CROSSED = 16;

/** Return the table of standings. */
export function standingsTable({ standings, is_race: isRace }, nameOf = ({ name }) => name) {
  const heads = ["Place", "Name", "Rating", "Won", "Drawn", "Lost", isRace ? "Reward" : "Points"];
  const rows = standings.map((row, index) =>
    element(
      "tr",
      {},
      cell(index + 1),
      element("th", { scope: "row" }, dot(row), nameOf(row)),
      element("td", { title: row.is_provisional ? "Not sure yet: it has played few games" : "" }, `${row.rating.toFixed(1)} ± ${row.range.toFixed(1)}${row.is_provisional ? "?" : ""}`),
      ...[row.won, row.drawn, row.lost].map(cell),
      cell(row.points.toFixed(1)),
    ),
  );
  return table("Standings", heads, rows, "ai4u-standings");
}

/** Return the table of who won how often against whom; null if it would be too large, or has nothing. */
export function crossTable({ standings }, nameOf = ({ name }) => name) {
  if (standings.length > MAX_CROSSED || standings.every(({ against }) => against.every((each) => !each))) return null;
  const heads = ["", ...standings.map((_, index) => String(index + 1))];
  const rows = standings.map((row, index) => {
    const cells = row.against.map((counts, other) => {
      if (other === index) return element("td", { className: "ai4u-own", "aria-label": "itself" });
      return element("td", { title: counts ? against(row, standings[other], counts) : "" }, counts ? score(counts) : "");
    });
    return element("tr", {}, element("th", { scope: "row" }, `${index + 1} `, dot(row), nameOf(row)), ...cells);
  });
  return table("Row against column: a point for each match won, ½ for a draw", heads, rows, "ai4u-cross");
}

/** Return a contest in words and numbers: who played, the points, and who won. */
export function contestLine({ entries, has_failed: hasFailed }, count = 5) {
  const shown = entries.slice(0, count);
  const isDrawn = entries.every(({ rank }) => rank === entries[0].rank);
  const parts = shown.flatMap((entry, index) => [
    index > 0 && element("span", { className: "ai4u-versus", textContent: shown.length === 2 ? "–" : "" }),
    element(
      "span",
      { className: "ai4u-contestant", dataset: entry.rank === 0 && !isDrawn ? { winner: "" } : {} },
      dot(entry),
      element("span", { className: "ai4u-name", textContent: entry.name }),
      element("span", { className: "ai4u-points", textContent: entry.points.toFixed(1) }),
    ),
  ]);
  const end = hasFailed ? "a network failed" : isDrawn ? "a draw" : `${entries[0].name} wins`;
  return element("span", { className: "ai4u-contest" }, ...parts, element("span", { className: "ai4u-end", textContent: end }));
}

/** Return a seat's colour as a dot. */
export function dot({ colour }) {
  const made = element("span", { className: "ai4u-dot", "aria-hidden": "true" });
  made.style.background = colour;
  return made;
}

/** Return points as in chess: "2½". */
export function score([won, drawn]) {
  const halves = 2 * won + drawn;
  return `${halves > 1 || halves === 0 ? Math.floor(halves / 2) : ""}${halves % 2 ? "½" : ""}`;
}

function against(row, other, [won, drawn, lost]) {
  return `${row.name} against ${other.name}: ${won} won, ${drawn} drawn, ${lost} lost`;
}

function cell(text) {
  return element("td", { textContent: text });
}

function table(caption, heads, rows, className) {
  const head = element("tr", {}, ...heads.map((text) => (text ? element("th", { scope: "col", textContent: text }) : element("td"))));
  return element("table", { className }, element("caption", { textContent: caption }), element("thead", {}, head), element("tbody", {}, ...rows));
}
