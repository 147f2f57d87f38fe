"""A tournament that another program shows.

``python -m ai4u_edu.games.tournament.live_process DIR WORK``

It plays the plan in the folder, and writes a line of JSON with the tournament so far when contests
have ended. It ends with all its processes as soon as its input is closed, as when the other program
has ended. The journal, in the folder WORK if there is one, has what was played by then, and the
same command goes on from there.
"""

import json
import os
import signal
import sys
import threading
import time
from pathlib import Path
from typing import Any

import psutil

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.base.process_family import kill_descendants
from ai4u_edu.base.process_priority import lower_priority
from ai4u_edu.games.jobs.processes import ProcessEngine, core_count
from ai4u_edu.games.tournament.contest import ContestResult
from ai4u_edu.games.tournament.plan import TournamentPlan
from ai4u_edu.games.tournament.run import run_tournament, write_results
from ai4u_edu.games.tournament.standings import Standing
from ai4u_edu.games.tournament.tournament import Tournament
from ai4u_edu.locale import join, packed

MIN_SHOW_INTERVAL_S = 0.5
"""Shortest time between two lines: to rate hundreds of contests takes some time."""
BEST_GAMES = 5
LATEST_CONTESTS = 6
POINT_DIGITS = 2


def main() -> None:
    """Play the tournament."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the program that shows it
    # what a library prints is no line of ours, and processes for games inherit this one
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    threading.Thread(target=_end_with, args=[sys.stdin.fileno()], daemon=True).start()
    lower_priority()

    def tell(**fields: Any) -> None:
        out.write(json.dumps(fields).encode() + b"\n")
        out.flush()

    shown_at = -MIN_SHOW_INTERVAL_S

    def show(done: Tournament) -> None:
        nonlocal shown_at
        if time.monotonic() - shown_at >= MIN_SHOW_INTERVAL_S:
            shown_at = time.monotonic()
            tell(view=live_view(done))

    folder, *work = map(Path, sys.argv[1:])
    try:
        with ProcessEngine(_width()) as engine:
            journal = work[0] if work else None
            done = run_tournament(
                TournamentPlan.load(folder), folder, engine, journal=journal, show=show
            )
        write_results(done)
    except (AI4UError, OSError) as error:
        tell(problem=packed(text_of(error)))
    else:
        tell(view=live_view(done), is_over=True)


def _width() -> int:
    """Return the number of games at a time: half of the cores are left to others."""
    return max(1, core_count() // 2)


def _end_with(owner: int) -> None:
    """End this process and those that it has started when the other end is closed."""
    while os.read(owner, 1024):  # not buffered: its lock would be held at the end
        pass
    kill_descendants(psutil.Process())
    os._exit(0)


def live_view(done: Tournament) -> dict[str, Any]:
    """Return a tournament so far as data that JSON can hold.

    Returns:
        ``games`` played and their ``total``; ``is_race``; ``standings``, the best first, with the
        results ``against`` each other entry (won, drawn, lost); the ``latest`` contests, the last
        one first; the ``best`` games to watch; ``refused`` entries with reasons.
        Sentences are :func:`~ai4u_edu.locale.packed`.
    """
    order = done.standings
    latest = [*reversed(done.ended)][:LATEST_CONTESTS]
    return {
        "games": sum(len(each.contest.seatings) for each in done.ended.values()),
        "total": done.plan.games_for(len(done.admitted)),
        "is_race": done.plan.sides.is_race,
        "standings": [_standing(each) for each in order],
        "latest": [_contest(done, place) for place in latest],
        "best": [_game(done, best.place, best.game) for best in done.best_games(order, BEST_GAMES)],
        "refused": {name: packed(reason) for name, reason in done.refused.items()},
    }


def _standing(each: Standing) -> dict[str, Any]:
    return {
        "name": each.name,
        "rating": round(each.mu, 1),
        "range": round(2 * each.sigma, 1),
        "is_provisional": each.is_provisional,
        "won": each.won,
        "drawn": each.drawn,
        "lost": each.lost,
        "failed": each.forfeits,
        "points": round(each.points, POINT_DIGITS),
        "against": each.against,
    }


def _contest(done: Tournament, place: int) -> dict[str, Any]:
    """Return a contest: its entries, the best first, with place and points, and its games."""
    result = done.ended[place]
    order = [] if result.error else _ranked(result)
    return {
        "seed": result.contest.seed,
        "entries": [{"name": name, "rank": rank, "points": points} for rank, name, points in order]
        or [{"name": name, "rank": 0, "points": 0.0} for name in result.contest.names],
        "problem": packed(result.error or _failures(result)),
        "games": [_game(done, place, game) for game, _ in enumerate(done.files.get(place, ()))],
    }


def _ranked(result: ContestResult) -> list[tuple[int, str, float]]:
    names = result.contest.names
    ranks = zip(result.ranks, names, strict=True)
    return sorted((rank, name, round(result.points(name), POINT_DIGITS)) for rank, name in ranks)


def _failures(result: ContestResult) -> str:
    """Return who failed and why; empty if nobody did."""
    names = result.contest.names
    failures = [join([name, why[0]], ": ") for name in names if (why := result.reasons(name))]
    return join(failures, "; ")


def _game(done: Tournament, place: int, game: int) -> dict[str, Any]:
    told = done.files[place][game]
    return {
        "number": place * len(done.files[place]) + game + 1,
        "names": told["entries"],
        "points": [round(each, POINT_DIGITS) for each in told["points"]],
        "seed": told["seed"],
        "file": told["file"],
    }


if __name__ == "__main__":
    main()
