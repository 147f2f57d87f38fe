"""Contests: games that are compared with each other, and who won them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ai4u_edu.games.jobs import Job
from ai4u_edu.games.tournament.entry import Entry
from ai4u_edu.games.tournament.game import game
from ai4u_edu.locale import unpacked


@dataclass(frozen=True)
class Contest:
    """Games on one seed whose results are compared.

    A duel is two games, in which the entries change sides; in a race each entry drives alone.
    """

    seed: int
    entries: tuple[Entry, ...]
    is_race: bool

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the entries."""
        return tuple(each.name for each in self.entries)

    @property
    def seatings(self) -> list[tuple[Entry, ...]]:
        """The entries of each game, by side."""
        if self.is_race:
            return [(each,) for each in self.entries]
        first, second = self.entries
        return [(first, second), (second, first)]

    def jobs(self, scene: Mapping[str, Any]) -> list[Job]:
        """Return a job for each game."""
        return [game_job(scene, self.seed, seating) for seating in self.seatings]


@dataclass(frozen=True)
class ContestResult:
    """Result of a contest."""

    contest: Contest
    games: tuple[dict[str, Any], ...]
    """Results of :func:`~ai4u_edu.games.tournament.game.game`; none if one failed."""
    error: str = ""
    """Sentence on why a game could not be played, through no fault of an entry."""

    def reasons(self, name: str) -> list[str]:
        """Return why an entry lost games by failing."""
        found = []
        for seating, told in zip(self.contest.seatings, self.games, strict=False):
            if told["forfeit"] >= 0 and seating[told["forfeit"]].name == name:
                found.append(unpacked(told["reason"]))
        return found

    def points(self, name: str) -> float:
        """Return an entry's points in all its games."""
        return sum(
            float(told["points"][side])
            for seating, told in zip(self.contest.seatings, self.games, strict=False)
            for side, entry in enumerate(seating)
            if entry.name == name
        )

    @property
    def ranks(self) -> list[int]:
        """Ranks of the entries, from 0; equal ones are a draw.

        Who failed ranks last, whatever the points. In a race to a goal, who reaches it sooner wins.
        """
        keys = [self._key(place, each.name) for place, each in enumerate(self.contest.entries)]
        order = sorted(set(keys), reverse=True)
        return [order.index(key) for key in keys]

    def _key(self, place: int, name: str) -> tuple[float, ...]:
        failed = -float(len(self.reasons(name)) > 0)
        if self.contest.is_race:
            told = self.games[place]
            if told["goal"][0]:
                return failed, 1.0, -float(told["ticks"])
            return failed, 0.0, round(self.points(name), 9)
        if any(told["forfeit"] >= 0 for told in self.games):
            return (failed,)  # the game was not finished, so its points say nothing
        return failed, round(self.points(name), 9)


def game_job(scene: Mapping[str, Any], seed: int, seating: Sequence[Entry]) -> Job:
    """Return the job of a game."""
    return Job.of(
        game,
        scene=dict(scene),
        seed=seed,
        entries=[each.model_dump(mode="json") for each in seating],
    )
