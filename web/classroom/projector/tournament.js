/** The tournament on the projector page: standings, the cross table, and the match that was played last. */

/** @import { ClassState, Results, Tournament } from "../../types/class.js" */

import { element, setText } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";
import { Podium } from "./podium.js";
import { contestLine, dot, standingsTable } from "../tournament/tables.js";

/** Entries up to which there is a table with ratings; more have a list in columns. */
const MAX_ROWS = 10;
const MAX_LISTED = 36;
const PODIUM_PLACES = 3;

export class ProjectedTournament {
  #place;
  #title = element("h1");
  #state = element("p", { className: "ai4u-course" });
  #last = element("p", { className: "ai4u-last", role: "status" });
  #podium = new Podium();
  #tables = element("div", { className: "ai4u-tables" });
  #told = "";

  /** @param {HTMLElement} place */
  constructor(place) {
    this.#place = place;
    place.append(this.#title, this.#state, this.#last, this.#podium.element, this.#tables);
  }

  /** @param {ClassState} state */
  show({ tournament }) {
    setText(this.#title, tournament ? t("Tournament: {scene}", { scene: tournament.title }) : t("No tournament now"));
    setText(this.#state, tournament ? courseOf(tournament) : "");
    const results = tournament?.results ?? null;
    const told = JSON.stringify([results, tournament?.phase]);
    if (told === this.#told) return;
    this.#told = told;
    const isOver = results !== null && tournament.phase === "over";
    const winners = isOver ? results.standings.slice(0, PODIUM_PLACES) : [];
    this.#podium.show(tournament?.id, winners.map((row) => ({ name: row.name, colour: row.colour, text: `${row.won} – ${row.drawn} – ${row.lost}` })));
    const last = isOver ? null : results?.latest[0];
    this.#last.replaceChildren(...(last ? [contestLine(last)] : []));
    this.#place.dataset.size = results && results.standings.length > MAX_ROWS ? "many" : "few";
    this.#tables.replaceChildren(...(results ? tablesOf(results) : []));
  }
}

/** @param {Tournament} tournament */
function courseOf({ phase, players, results }) {
  if (phase === "open") return players ? tn("{n} player so far. Hand in your network!", "{n} players so far. Hand in your network!", players) : t("Hand in your network!");
  const played = results ? tn("{games} of {n} game", "{games} of {n} games", results.total, { games: results.games }) : t("It begins…");
  return {
    running: played,
    over: t("{played}. It is over.", { played }),
    cancelled: t("{played}. It was stopped.", { played }),
    failed: t("{played}. It was interrupted.", { played }),
  }[phase];
}

/** @param {Results} results */
function tablesOf(results) {
  if (results.standings.length > MAX_ROWS) return [listOf(results)];
  return [standingsTable(results, { isShort: true })];
}

/**
 * Return the standings of many as a list in columns.
 * @param {Results} results
 */
function listOf({ standings }) {
  const items = standings.slice(0, MAX_LISTED).map((row, index) =>
    element(
      "li",
      {},
      element("span", { className: "ai4u-place", textContent: index + 1 }),
      dot(row),
      element("span", { className: "ai4u-name", textContent: row.name }),
      element("span", { className: "ai4u-score", textContent: `${row.won} – ${row.drawn} – ${row.lost}` }),
    ),
  );
  const rest = standings.length - items.length;
  return element("div", {}, element("ol", { className: "ai4u-ranks", "aria-label": t("Standings: won, drawn, lost") }, ...items), rest > 0 && element("p", { textContent: tn("and {n} more", "and {n} more", rest) }));
}
