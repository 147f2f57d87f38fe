"""Report of a tournament as one HTML page, with the best games embedded."""

import base64
import hashlib
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING

from ai4u_edu.base.html_report import html_page, html_table
from ai4u_edu.recording import Episode, Replay
from ai4u_edu.recording.episode import decode
from ai4u_edu.recording.exports.html_page import html_of
from ai4u_edu.tournament.best_games import best_games
from ai4u_edu.tournament.standings import MAX_SURE_SIGMA, Standing

if TYPE_CHECKING:
    from ai4u_edu.tournament.run import Tournament

EMBEDDED_GAMES = 3
MAX_LISTED_GAMES = 500
POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:"
STYLE = """
iframe{width:100%;height:42rem;border:1px solid var(--line);border-radius:6px}
@media(max-width:52rem){iframe{height:70rem}}
summary{cursor:pointer;padding:.3em 0}
"""


def page_of(done: "Tournament") -> str:
    """Return the page."""
    title = f"Tournament: {done.plan.title}"
    return html_page(title, _parts(done), policy=POLICY, style=STYLE)


def _parts(done: "Tournament") -> Iterator[str]:
    order = done.standings
    plan = done.plan
    kind = "race" if plan.sides.is_race else plan.system.replace("-", " ")
    total = plan.games_for(len(done.admitted))
    missing = total - len(done.games)
    rest = f" {missing} games have not been played." if missing > 0 else ""
    seeds = ", ".join(map(str, plan.seeds[:20])) + (" …" if len(plan.seeds) > 20 else "")
    yield f"<p>{len(done.admitted)} entries, {len(done.games)} games ({kind}).{rest}</p>"
    how = (
        "Each drives alone on each seed; who reaches the goal sooner wins."
        if plan.sides.is_race
        else "Each duel is two games on one seed, in which the entries change sides; the rewards "
        "of both decide."
    )
    yield f'<p class="soft">{how} Seeds: {escape(seeds)}.</p>'
    yield "<h2>Standings</h2>"
    yield html_table(
        ["place", "entry", "rating", "won", "drawn", "lost", "failed games", "points"],
        [
            [
                *(place, each.name, each.rating, each.won, each.drawn, each.lost),
                each.forfeits or "",
                f"{each.points:.2f}",
            ]
            for place, each in enumerate(order, 1)
        ],
        text_columns=(1, 2),
        marked=(0,),
    )
    yield (
        '<p class="soft">Ratings by openskill (Plackett-Luce) with their 95% range; provisional '
        f"until it is narrower than ±{2 * MAX_SURE_SIGMA:g}. A crash or a time-out loses, and its "
        "points do not count.</p>"
    )
    if done.refused:
        yield "<h2>Refused: they could not play against themselves</h2>"
        yield html_table(["entry", "reason"], [*done.refused.items()], text_columns=(0, 1))
    yield "<h2>Row against column: won, drawn, lost</h2>"
    yield _cross_table(order)
    yield "<h2>Best games</h2>"
    yield from _best_games(done, order)
    failed = [
        (name, why)
        for each in done.results
        for name in each.contest.names
        for why in each.reasons(name)
    ]
    if failed:
        yield "<h2>Games lost by a failure</h2>"
        yield html_table(["entry", "reason"], dict.fromkeys(failed), text_columns=(0, 1))
    errors = [each for each in done.results if each.error]
    if errors:
        yield "<h2>Not played</h2>"
        yield html_table(
            ["entries", "seed", "reason"],
            [[" - ".join(each.contest.names), each.contest.seed, each.error] for each in errors],
            text_columns=(0, 2),
        )
    yield _games(done)


def _cross_table(order: list[Standing]) -> str:
    def cell(one: Standing, other: Standing) -> str:
        if one is other:
            return "·"
        return " - ".join(map(str, one.against.get(other.name, []))) or ""

    return html_table(
        ["", *(str(place) for place in range(1, len(order) + 1))],
        [
            [f"{place}  {one.name}", *(cell(one, other) for other in order)]
            for place, one in enumerate(order, 1)
        ],
    )


def _best_games(done: "Tournament", order: list[Standing]) -> Iterator[str]:
    """Yield players for the best games."""
    found = best_games(done.ended, order, EMBEDDED_GAMES)
    for _, result, game in found:
        contest, told = result.contest, result.games[game]
        episode = decode(Episode, base64.b64decode(told["episode"]), "game")
        points = ", ".join(
            f"{entry.name} ({side}): {points:.2f}"
            for entry, side, points in zip(
                contest.seatings[game], done.plan.sides.names, told["points"], strict=True
            )
        )
        player = escape(html_of(Replay(episode)))
        yield (
            f"<details><summary>{escape(points)}; seed {contest.seed}</summary>"
            f'<iframe title="{escape(points)}" loading="lazy" srcdoc="{player}"></iframe></details>'
        )
    if not found:
        yield "<p>No game has been finished.</p>"


def _games(done: "Tournament") -> str:
    rows = [
        [
            number,
            " - ".join(each["entries"]),
            each["seed"],
            " : ".join(f"{points:.2f}" for points in each["points"]),
            f"{each['entries'][each['forfeit']]} failed" if each["forfeit"] >= 0 else "",
            each["file"],
        ]
        for number, each in enumerate(done.games[:MAX_LISTED_GAMES], 1)
    ]
    more = len(done.games) - len(rows)
    note = f"<p>{more} more are in games.json.</p>" if more else ""
    plan = hashlib.sha256(done.plan.text.encode()).hexdigest()
    return (
        "<h2>All games</h2><details><summary>Show</summary>"
        + html_table(
            ["game", "entries", "seed", "points", "", "file"], rows, text_columns=(1, 4, 5)
        )
        + f"{note}<p>Watch one: <code>ai4u-edu replay FILE</code>; play all again and compare: "
        "<code>ai4u-edu tournament verify FOLDER</code></p>"
        f"<p>SHA-256 of the plan (tournament.json): <code>{plan}</code></p></details>"
    )
