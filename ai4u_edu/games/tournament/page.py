"""HTML pages of a tournament: its report, with the best games embedded, and any single game."""

import base64
import hashlib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from ai4u_edu.base.html_template import render_html
from ai4u_edu.games.tournament.standings import MAX_SURE_SIGMA, Standing
from ai4u_edu.games.tournament.tournament import Tournament
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import Episode, Replay
from ai4u_edu.recording.episode import decode
from ai4u_edu.recording.exports.html_page import html_of

PROJECTED = """<style>
main { display: block; max-width: none; text-align: center; }
section + section, footer, #goal, #about, .bar { display: none; }
h1 { font-size: clamp(22px, 2.8vw, 60px); }
</style>
<script>
set(true);
setInterval(() => {
  if (playing) return;
  time = 0;
  set(true);
}, 3000);
</script>
"""
"""Addition to the page of :mod:`ai4u_edu.recording.exports.html_page` for the projector."""
SYSTEMS = {"race": _("race"), "round-robin": _("round robin"), "swiss": _("Swiss system")}
"""Systems of tournaments in words."""
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
        system=SYSTEMS["race" if plan.sides.is_race else plan.system],
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
    for _place, result, game in done.best_games(order, EMBEDDED_GAMES):
        contest, told = result.contest, result.games[game]
        episode = decode(Episode, base64.b64decode(told["episode"]), "game")
        points = ", ".join(
            f"{entry.name} ({side}): {points:.2f}"
            for entry, side, points in zip(
                contest.seatings[game], done.plan.sides.names, told["points"], strict=True
            )
        )
        yield points, contest.seed, html_of(Replay(episode))


def game_page(path: str, *, is_projected: bool = False) -> str:
    """Return the HTML page that plays a recorded game, with its players in the title.

    Args:
        path: of the episode's file.
        is_projected: True for a page that plays by itself, again and again, and shows the world
            alone.

    Raises:
        RecordingError: it is no episode.
        OSError: it can't be read.
    """
    file = Path(path)
    episode = decode(Episode, file.read_bytes(), file.name)
    scene = episode.scene
    title = f"{scene.title or scene.name}: {_players(episode)}"
    page = html_of(Replay(replace(episode, scene=scene.model_copy(update={"title": title}))))
    return page.replace("</body>", f"{PROJECTED}</body>") if is_projected else page


def _players(episode: Episode) -> str:
    """Return the entries of a game, each with its side if there are two."""
    sides: dict[str, str] = {}
    for agent in episode.agents:
        sides.setdefault(agent.id.partition("_")[0], agent.driver)
    if len(sides) == 1:
        return next(iter(sides.values()))
    return " – ".join(f"{driver} ({side})" for side, driver in sides.items())  # noqa: RUF001  # a dash
