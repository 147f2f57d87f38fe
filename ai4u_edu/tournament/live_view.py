"""A tournament so far as data, for pages that show it while it is played."""

from typing import Any

from ai4u_edu.tournament.best_games import best_games
from ai4u_edu.tournament.contest import ContestResult
from ai4u_edu.tournament.run import Tournament
from ai4u_edu.tournament.standings import Standing

BEST_GAMES = 5
LATEST_CONTESTS = 6
POINT_DIGITS = 2


def live_view(done: Tournament) -> dict[str, Any]:
    """Return a tournament so far as data that JSON can hold.

    Returns:
        ``games`` played and their ``total``; ``is_race``; ``standings``, the best first, with the
        results ``against`` each other entry (won, drawn, lost); the ``latest`` contests, the last
        one first; the ``best`` games to watch; ``refused`` entries with reasons.
    """
    order = done.standings
    latest = [*reversed(done.ended)][:LATEST_CONTESTS]
    return {
        "games": sum(len(each.contest.seatings) for each in done.ended.values()),
        "total": done.plan.games_for(len(done.admitted)),
        "is_race": done.plan.sides.is_race,
        "standings": [_standing(each) for each in order],
        "latest": [_contest(done, place) for place in latest],
        "best": [
            _game(done, each.place, each.game) for each in best_games(done.ended, order, BEST_GAMES)
        ],
        "refused": done.refused,
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
        "problem": result.error or _failures(result),
        "games": [_game(done, place, game) for game, _ in enumerate(done.files.get(place, ()))],
    }


def _ranked(result: ContestResult) -> list[tuple[int, str, float]]:
    names = result.contest.names
    ranks = zip(result.ranks, names, strict=True)
    return sorted((rank, name, round(result.points(name), POINT_DIGITS)) for rank, name in ranks)


def _failures(result: ContestResult) -> str:
    """Return who failed and why; empty if nobody did."""
    names = result.contest.names
    return "; ".join(f"{name}: {why[0]}" for name in names if (why := result.reasons(name)))


def _game(done: Tournament, place: int, game: int) -> dict[str, Any]:
    told = done.files[place][game]
    return {
        "number": place * len(done.files[place]) + game + 1,
        "names": told["entries"],
        "points": [round(each, POINT_DIGITS) for each in told["points"]],
        "seed": told["seed"],
        "file": told["file"],
    }
