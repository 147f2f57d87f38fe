"""Report of a tournament as one HTML page, with the best games embedded."""

import base64
import hashlib
from collections.abc import Iterator

from ai4u_edu.base.html_template import render_html
from ai4u_edu.games.tournament.standings import MAX_SURE_SIGMA, Standing
from ai4u_edu.games.tournament.tournament import Tournament
from ai4u_edu.recording import Episode, Replay
from ai4u_edu.recording.episode import decode
from ai4u_edu.recording.exports.html_page import html_of

EMBEDDED_GAMES = 3
MAX_LISTED_GAMES = 500
MAX_LISTED_SEEDS = 20


def page_of(done: Tournament) -> str:
    """Return the page."""
    plan, order = done.plan, done.standings
    failures = [
        (name, reason)
        for result in done.results
        for name in result.contest.names
        for reason in result.reasons(name)
    ]
    return render_html(
        "games/tournament/page.html",
        plan=plan,
        plan_hash=hashlib.sha256(plan.text.encode()).hexdigest(),
        seeds=plan.seeds[:MAX_LISTED_SEEDS],
        entries=len(done.admitted),
        games=done.games[:MAX_LISTED_GAMES],
        played=len(done.games),
        missing=plan.games_for(len(done.admitted)) - len(done.games),
        order=order,
        certain_range=2 * MAX_SURE_SIGMA,
        refused=done.refused,
        best=_best_games(done, order),
        failures=dict.fromkeys(failures),
        errors=[result for result in done.results if result.error],
    )


def _best_games(done: Tournament, order: list[Standing]) -> Iterator[tuple[str, int, str]]:
    """Yield points, seed and player of the best games."""
    for _, result, game in done.best_games(order, EMBEDDED_GAMES):
        contest, told = result.contest, result.games[game]
        episode = decode(Episode, base64.b64decode(told["episode"]), "game")
        points = ", ".join(
            f"{entry.name} ({side}): {points:.2f}"
            for entry, side, points in zip(
                contest.seatings[game], done.plan.sides.names, told["points"], strict=True
            )
        )
        yield points, contest.seed, html_of(Replay(episode))
