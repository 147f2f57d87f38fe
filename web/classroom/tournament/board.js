/** The tournament on the teacher's page: who handed in what, its start and end, and its results. */

/** @import { ClassState, Contest, Entry, Game, Network, Results, Seat, Tournament } from "../../types/class.js" */
/** @import { RealNames } from "../teacher/real_names.js" */

import { commandOrTell } from "../teacher/command.js";
import { element, keyed, setText, tableHead, unlessPressed } from "../../shared/dom.js";
import { t, tn } from "../../shared/text.js";
import { showBegin, showStart } from "./dialogs.js";
import { contestLine, dot, standingsTable } from "./tables.js";

const HOW =
  t("No tournament yet. Choose its scene; then students hand in networks that they have trained: with “Hand in” above their world, or with submit(…) in a notebook. Here you see who did, and start the games.");
const VERDICTS = {
  open: { sign: "…", text: t("is being checked") },
  right: { sign: "✓", text: t("can play") },
  refused: { sign: "×", text: t("refused") },
};
const PHASES = {
  open: t("Students hand in networks."),
  running: t("The games are played."),
  over: t("All games were played."),
  cancelled: t("It was cancelled."),
  failed: t("It was interrupted."),
};

/** Titles of the lists of results. */
const LISTS = [t("Played last"), t("Best games to watch"), t("Taken out: they could not play against themselves")];

export class TournamentBoard {
  #place;
  #realNames;
  /** @type {ClassState | null} */
  #state = null;
  #parts = {
    head: element("div", { className: "ai4u-tournament-head" }),
    problem: element("p", { className: "ai4u-tournament-problem", role: "alert" }),
    course: element("p", { role: "status" }),
    results: element("div", { className: "ai4u-results" }),
    networks: element("div"),
  };
  /**
   * The facts that each part shows, as text.
   * @type {Map<string, string>}
   */
  #told = new Map();

  /**
   * @param {HTMLElement} place
   * @param {RealNames} realNames
   */
  constructor(place, realNames) {
    this.#place = place;
    this.#realNames = realNames;
    place.append(...Object.values(this.#parts));
  }

  /** @param {ClassState} state */
  show(state) {
    this.#state = state;
    setText(this.#parts.course, state.tournament ? courseOf(state.tournament) : "");
    unlessPressed(this.#place, () => this.#drawParts(state));
  }

  /** @param {ClassState} state */
  #drawParts({ tournament, handed_in: handedIn, seats }) {
    const results = tournament?.results ?? null;
    setText(this.#parts.problem, [handedIn?.missing, tournament?.problem].filter(Boolean).join(" "));
    this.#draw("head", [tournament?.phase, tournament?.title], (part) => part.replaceChildren(...this.#head()));
    const students = seats.filter((seat) => seat.state === "in").map((seat) => [seat.number, seat.name, this.#realNames.of(seat)]);
    this.#draw("networks", [tournament?.scene, handedIn?.networks, students], (part) => part.replaceChildren(...this.#networks()));
    this.#draw("results", [results, students], (part) => this.#drawResults(part, results));
  }

  /**
   * Draw a part again if its facts have changed; the focus stays where it was, or in the part.
   * @param {"head" | "results" | "networks"} name
   * @param {unknown[]} facts
   * @param {(part: HTMLElement) => void} draw
   */
  #draw(name, facts, draw) {
    const part = this.#parts[name];
    const told = JSON.stringify(facts);
    if (this.#told.get(name) === told) return;
    this.#told.set(name, told);
    const focused = part.contains(document.activeElement) ? document.activeElement.textContent : null;
    draw(part);
    if (focused === null || part.contains(document.activeElement)) return;
    const controls = [.../** @type {NodeListOf<HTMLElement>} */ (part.querySelectorAll("button, a"))];
    (controls.find(({ textContent }) => textContent === focused) ?? controls[0])?.focus();
  }

  #head() {
    const { tournament } = this.#state;
    const begin = button(tournament ? t("Another tournament…") : t("Tournament…"), () => showBegin(this.#state), !tournament);
    if (!tournament) return [element("p", { className: "ai4u-empty", textContent: HOW }), element("p", { className: "ai4u-begin" }, begin)];
    const { phase, title } = tournament;
    /** @type {Partial<Record<Tournament["phase"], HTMLElement[]>>} */
    const byPhase = {
      open: [button(t("Start…"), () => showStart(this.#state), true), begin, send(t("Close"), "close tournament")],
      running: [send(t("Cancel"), "cancel tournament")],
    };
    const actions = byPhase[phase] ?? [button(t("Start again…"), () => showStart(this.#state), phase !== "over"), begin, send(t("Close"), "close tournament")];
    const project = button(t("Show on the projector"), () => commandOrTell({ do: "show", kind: "tournament" }));
    const report = phase === "over" && element("a", { className: "ai4u-plain", href: "./teacher/tournament", target: "_blank", rel: "noopener", textContent: t("Report") });
    return [element("h2", { textContent: t("Tournament: {scene}", { scene: title }) }), element("div", { className: "ai4u-actions" }, ...actions, project, report)];
  }

  #networks() {
    const { tournament, handed_in: handedIn, seats, scenes } = this.#state;
    const all = handedIn?.networks ?? [];
    if (!tournament) {
      const titles = new Map(scenes.map(({ name, title }) => [name, title]));
      const names = [...new Set(all.map(({ scene }) => scene))];
      const words = names.map((name) => `${titles.get(name) ?? name}: ${networksText(all.filter(({ scene }) => scene === name).length)}`);
      return words.length ? [element("p", { className: "ai4u-facts ai4u-begin", textContent: t("Handed in already: {networks}.", { networks: words.join(", ") }) })] : [];
    }
    const own = all.filter(({ scene }) => scene === tournament.scene);
    const students = seats.filter((seat) => seat.state === "in");
    const rows = students.flatMap((seat) => own.filter((each) => each.seat === seat.number).map((network) => this.#row(seat, network)));
    const without = students.filter((seat) => !own.some((each) => each.seat === seat.number));
    const names = without.map((seat) => this.#nameOf(seat)).join(", ");
    const rest = element("p", { className: "ai4u-facts", textContent: without.length ? tn("Nothing yet from {n} student: {names}", "Nothing yet from {n} students: {names}", without.length, { names }) : "" });
    if (rows.length === 0) return [rest];
    const caption = element("caption", { textContent: t("Handed in") });
    const head = tableHead(t("Student"), t("Network"), t("Checked"));
    return [element("table", { className: "ai4u-networks" }, caption, head, element("tbody", {}, ...rows)), rest];
  }

  /**
   * @param {Seat} seat
   * @param {Network} network
   */
  #row(seat, { part, file, verdict, reason }) {
    const { sign, text } = VERDICTS[verdict];
    const words = reason ? `${text}: ${reason}` : text;
    return element(
      "tr",
      {},
      element("th", { scope: "row" }, dot(seat), this.#nameOf(seat)),
      element("td", { textContent: part ? `${file} (${part})` : file }),
      element("td", { dataset: { verdict } }, element("span", { "aria-hidden": "true", textContent: `${sign} ` }), words),
    );
  }

  /**
   * Draw the results. What is in a list stays while more games are played, so that a click on it is not lost.
   * @param {HTMLElement} part
   * @param {Results | null} results
   */
  #drawResults(part, results) {
    if (results === null) return part.replaceChildren();
    if (!part.hasChildNodes()) part.append(scrolled(t("Standings")), ...LISTS.map(listed));
    const [standings, latest, best, refused] = part.children;
    const nameOf = (/** @type {Entry} */ row) => this.#nameOf(this.#state.seats.find(({ number }) => number === row.seat) ?? row);
    standings.replaceChildren(standingsTable(results, { nameOf }));
    fill(latest, results.latest, (contest) => [
      contestLine(contest),
      contest.problem && element("p", { className: "ai4u-facts", textContent: contest.problem }),
      ...watched(contest, results).map(watch),
    ]);
    fill(best, results.best, (game) => [game.who.map(({ name }) => name).join(" – "), " ", watch(game), project(game)]);
    fill(refused, results.refused, ({ name, reason }) => [`${name}: ${reason}`]);
  }

  /** @param {Seat | Entry} seat */
  #nameOf(seat) {
    const real = "number" in seat ? this.#realNames.of(seat) : "";
    return real ? `${seat.name} (${real})` : seat.name;
  }
}

/** @param {Tournament} tournament */
function courseOf({ phase, results, players }) {
  const games = results && tn("{games} of {n} game.", "{games} of {n} games.", results.total, { games: results.games });
  return [PHASES[phase], phase === "open" ? tn("{n} player can play.", "{n} players can play.", players) : games].filter(Boolean).join(" ");
}

/** @param {number} count */
function networksText(count) {
  return tn("{n} network", "{n} networks", count);
}

/**
 * Return the games of a contest that are offered to watch: both of a match, and the best drive of a race.
 * @param {Contest} contest
 * @param {Results} results
 */
function watched({ entries, games }, { is_race: isRace }) {
  return isRace ? games.filter(({ who }) => who[0].seat === entries[0].seat).slice(0, 1) : games;
}

/**
 * Return a link to the recording of a game; empty if there is none.
 * @param {Game} game
 */
function watch({ number, who, points }) {
  if (!number) return "";
  const text = t("Watch game {number}", { number });
  const label = `${text}: ${who.map(({ name }, index) => `${name} ${points[index].toFixed(1).replace("-", "−")}`).join(", ")}`;
  return element("a", { className: "ai4u-watch", href: `./teacher/tournament/${number}`, target: "_blank", rel: "noopener", title: label, "aria-label": label, textContent: text });
}

/**
 * Return a button that shows the recording of a game to all.
 * @param {Game} game
 */
function project({ number }) {
  const shown = button(t("To the projector"), () => commandOrTell({ do: "show", kind: "game", game: number }));
  shown.ariaLabel = t("Game {number} to the projector", { number });
  return shown;
}

/** @param {string} title */
function listed(title) {
  return element("section", {}, element("h3", { textContent: title }), element("ol", { className: "ai4u-contests" }));
}

/**
 * @template Item
 * @param {Element} section with a list
 * @param {Item[]} items none of them twice
 * @param {(item: NoInfer<Item>) => (Node | string | false)[]} contentOf
 */
function fill(section, items, contentOf) {
  section.toggleAttribute("hidden", items.length === 0);
  keyed(section.querySelector("ol"), items, JSON.stringify, (item) => element("li", {}, ...contentOf(item)));
}

/** @param {string} label */
function scrolled(label) {
  return element("div", { className: "ai4u-scroll", tabIndex: 0, role: "region", "aria-label": label });
}

/**
 * @param {string} text
 * @param {() => void} onClick
 */
function button(text, onClick, isMain = false) {
  return element("button", { type: "button", className: isMain ? "ai4u-button" : "ai4u-plain", textContent: text, on: { click: onClick } });
}

/**
 * @param {string} text
 * @param {string} wanted a command
 */
function send(text, wanted) {
  return button(text, () => commandOrTell({ do: wanted }));
}
