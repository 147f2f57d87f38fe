"""Standings of a tournament: wins, points, and ratings by openskill."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

from ai4u_edu.base.optional_deps import need
from ai4u_edu.games.tournament.contest import ContestResult
from ai4u_edu.locale import gettext as _

MAX_SURE_SIGMA = 6.5
"""Uncertainty of a rating above which it is provisional; a new one has 25/3."""


@dataclass
class Standing:
    """Standing of one entry."""

    name: str
    won: int = 0
    drawn: int = 0
    lost: int = 0
    forfeits: int = 0
    """Games lost by a crash or by time."""
    points: float = 0.0
    """Rewards in all games."""
    mu: float = 25.0
    """Rating: strength."""
    sigma: float = 25.0 / 3.0
    """Rating: uncertainty."""
    against: dict[str, list[int]] = field(default_factory=dict)
    """Won, drawn and lost by the name of the other entry."""

    @property
    def is_provisional(self) -> bool:
        """True until it has played enough for its rating to be sure."""
        return self.sigma > MAX_SURE_SIGMA

    @property
    def score(self) -> float:
        """A point for each contest won, half a point for a draw."""
        return self.won + self.drawn / 2

    @property
    def rating(self) -> str:
        """Rating in words."""
        rating = f"{self.mu:.1f} ± {2 * self.sigma:.1f}"
        return _("{rating} (provisional)", rating=rating) if self.is_provisional else rating


def standings(names: Sequence[str], results: Sequence[ContestResult]) -> list[Standing]:
    """Return the standings after some contests, the best first.

    Args:
        names: of all entries.
        results: of contests, in the order of the schedule; it decides the ratings' last digits.
    """
    need("tournament", "openskill")
    from openskill.models import PlackettLuce

    model: Any = PlackettLuce()
    found = {name: Standing(name) for name in names}
    ratings = {name: model.rating() for name in names}
    for result in results:
        if result.error:
            continue
        members, ranks = result.contest.names, result.ranks
        if len(members) > 1:
            teams = model.rate([[ratings[name]] for name in members], ranks=ranks)
            ratings.update({name: team[0] for name, team in zip(members, teams, strict=True)})
        for name in members:
            found[name].points += result.points(name)
            found[name].forfeits += len(result.reasons(name))
        for (one, first), (other, second) in combinations(zip(members, ranks, strict=True), 2):
            _count(found[one], other, second - first)
            _count(found[other], one, first - second)
    for name, each in found.items():
        each.mu, each.sigma = float(ratings[name].mu), float(ratings[name].sigma)
    return sorted(found.values(), key=lambda each: (-each.mu, -each.score, each.name))


def _count(standing: Standing, other: str, difference: int) -> None:
    cell = standing.against.setdefault(other, [0, 0, 0])
    if difference > 0:
        standing.won += 1
        cell[0] += 1
    elif difference == 0:
        standing.drawn += 1
        cell[1] += 1
    else:
        standing.lost += 1
        cell[2] += 1
