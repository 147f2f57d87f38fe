/** Tables of a tournament's results, for the teacher's page and the projector page. */

/** @import { Contest, Results, Score, Standing } from "../../types/class.js" */

import { element } from "../../shared/dom.js";
import { t } from "../../shared/text.js";

/** Most entries of a cross table that can be read. */
const MAX_CROSSED = 16;
/** Most entries of a contest in its line. */
const MAX_CONTESTANTS = 5;

/**
 * Return the table of standings; with few entries also wins and losses against each other entry.
 *
 * @param {Results} results
 * @param {object} [options]
 * @param {(row: Standing) => string} [options.nameOf] returns the name of a row
 * @param {boolean} [options.isShort] without the points, for the projector
 */
export function standingsTable({ standings, is_race: isRace }, { nameOf = ({ name }) => name, isShort = false } = {}) {
  const isCrossed = !isRace && standings.length <= MAX_CROSSED;
  const numbers = isCrossed ? standings.map((_, index) => String(index + 1)) : [];
  const heads = ["", t("Name"), ...numbers, t("Won"), t("Drawn"), t("Lost"), ...(isShort ? [] : [isRace ? t("Reward") : t("Points")]), t("Rating")];
  const rows = standings.map((row, index) =>
    element(
      "tr",
      {},
      cell(index + 1),
      element("th", { scope: "row" }, dot(row), nameOf(row)),
      ...(isCrossed ? row.against.map((counts, other) => crossing(row, standings, index, other, counts, nameOf)) : []),
      ...[row.won, row.drawn, row.lost].map(cell),
      !isShort && cell(number(row.points)),
      element("td", { title: row.is_provisional ? t("Not sure yet: it has played few games") : "" }, `${row.rating.toFixed(1)} ± ${row.range.toFixed(1)}${row.is_provisional ? "?" : ""}`),
    ),
  );
  const caption = isCrossed ? t("Standings. Row against column: a point for each match won, ½ for a draw") : t("Standings");
  const head = element("tr", {}, ...heads.map((text) => (text ? element("th", { scope: "col", textContent: text, className: numbers.includes(text) ? "ai4u-crossing" : "" }) : element("td"))));
  return element("table", { className: "ai4u-standings" }, element("caption", { textContent: caption }), element("thead", {}, head), element("tbody", {}, ...rows));
}

/**
 * Return the cell of a row and the column of another entry.
 * @param {Standing} row
 * @param {Standing[]} standings
 * @param {number} index of the row
 * @param {number} other index of the other entry
 * @param {Score | null} counts
 * @param {(row: Standing) => string} nameOf
 */
function crossing(row, standings, index, other, counts, nameOf) {
  if (other === index) return element("td", { className: "ai4u-crossing ai4u-own" });
  const [won, drawn, lost] = counts ?? [];
  const values = { name: nameOf(row), other: nameOf(standings[other]), won, drawn, lost };
  const title = counts ? t("{name} against {other}: {won} won, {drawn} drawn, {lost} lost", values) : "";
  return element("td", { className: "ai4u-crossing", title }, counts ? score(counts) : "");
}

/**
 * Return a contest in words and numbers: who played, the points, and who won.
 * @param {Contest} contest
 */
export function contestLine({ entries, has_failed: hasFailed }) {
  const shown = entries.slice(0, MAX_CONTESTANTS);
  const isDrawn = entries.every(({ rank }) => rank === entries[0].rank);
  const parts = shown.flatMap((entry, index) => [
    index > 0 && element("span", { className: "ai4u-versus", textContent: shown.length === 2 ? "–" : "" }),
    element(
      "span",
      { className: "ai4u-contestant", dataset: entry.rank === 0 && !isDrawn ? { winner: "" } : {} },
      dot(entry),
      element("span", { className: "ai4u-name", textContent: entry.name }),
      element("span", { className: "ai4u-points", textContent: number(entry.points) }),
    ),
  ]);
  const end = hasFailed ? t("a network failed") : isDrawn ? t("a draw") : t("{name} wins", { name: entries[0].name });
  return element("span", { className: "ai4u-contest" }, ...parts, element("span", { className: "ai4u-end", textContent: end }));
}

/**
 * Return a seat's colour as a dot.
 * @param {{colour: string}} seat
 */
export function dot({ colour }) {
  const made = element("span", { className: "ai4u-dot", "aria-hidden": "true" });
  made.style.background = colour;
  return made;
}

/**
 * Return points as in chess: "2½".
 * @param {Score} counts
 */
export function score([won, drawn]) {
  const halves = 2 * won + drawn;
  return `${halves > 1 || halves === 0 ? Math.floor(halves / 2) : ""}${halves % 2 ? "½" : ""}`;
}

/** @param {number | string} text */
function cell(text) {
  return element("td", { textContent: text });
}

/**
 * Return points with a real minus.
 * @param {number} value
 */
function number(value) {
  return value.toFixed(1).replace("-", "−");
}
