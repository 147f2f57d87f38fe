"""A tournament so far: its results, its standings, and the games that are worth watching."""

import base64
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from ai4u_edu.games.tournament.contest import ContestResult
from ai4u_edu.games.tournament.entry import Entry
from ai4u_edu.games.tournament.plan import TournamentPlan
from ai4u_edu.games.tournament.standings import Standing, standings


class BestGame(NamedTuple):
    """A finished game."""

    place: int
    """Place of its contest in the schedule."""
    result: ContestResult
    """Result of its contest."""
    game: int
    """Index of the game in the contest."""


@dataclass
class Tournament:
    """Results of a tournament so far."""

    plan: TournamentPlan
    folder: Path
    refused: dict[str, str] = field(default_factory=dict)
    """Reasons for which entries take no part, by name."""
    ended: dict[int, ContestResult] = field(default_factory=dict)
    """Results of the contests that ended, by their place in the schedule."""
    files: dict[int, list[dict[str, Any]]] = field(default_factory=dict)
    """File, entries, seed and result of each game, by the place of its contest."""
    is_interrupted: bool = False

    @property
    def results(self) -> list[ContestResult]:
        """Results of the contests that ended, in the order of the schedule."""
        return [self.ended[place] for place in sorted(self.ended)]

    @property
    def games(self) -> list[dict[str, Any]]:
        """File, entries, seed and result of each game, in the order of the schedule."""
        return [game for place in sorted(self.files) for game in self.files[place]]

    @property
    def admitted(self) -> list[Entry]:
        """The entries that take part."""
        return [each for each in self.plan.entries if each.name not in self.refused]

    @property
    def standings(self) -> list[Standing]:
        """The standings, the best first."""
        return standings([each.name for each in self.admitted], self.results)

    def recordings(self, place: int) -> Iterator[tuple[str, bytes]]:
        """Yield name and content of the recordings of a contest's games."""
        for listed, told in zip(self.files.get(place, ()), self.ended[place].games, strict=True):
            if listed["file"]:
                yield listed["file"], base64.b64decode(told["episode"])

    def best_games(self, order: Sequence[Standing], count: int) -> list[BestGame]:
        """Return finished games between strong entries, a different pair each, the best first.

        Args:
            order: the standings; to compute them again takes time.
            count: number of games, or fewer.
        """
        best: dict[tuple[str, ...], BestGame] = {}
        for candidate in self._candidates(order):
            contest = candidate.result.contest
            names = contest.names
            key = (names[candidate.game], str(contest.seed)) if contest.is_race else names
            best.setdefault(key, candidate)
            if len(best) == count:
                break
        return [*best.values()]

    def _candidates(self, order: Sequence[Standing]) -> Iterator[BestGame]:
        strength = {standing.name: standing.mu for standing in order}
        clean = [(place, self.ended[place]) for place in sorted(self.ended)]
        clean = [(place, result) for place, result in clean if _is_clean(result)]
        clean.sort(
            key=lambda pair: (
                len(set(pair[1].ranks)) == 1,  # a game that somebody wins is better to watch
                -sum(sorted(strength[name] for name in pair[1].contest.names)[-2:]),
            )
        )
        for place, result in clean:
            game = result.ranks.index(0) if result.contest.is_race else _clearer_game(result)
            yield BestGame(place, result, game)


def _clearer_game(result: ContestResult) -> int:
    """Return the index of a duel's game with the larger difference of points."""
    differences = [abs(told["points"][0] - told["points"][1]) for told in result.games]
    return differences.index(max(differences))


def _is_clean(result: ContestResult) -> bool:
    return not result.error and all(
        told["forfeit"] < 0 and told["episode"] for told in result.games
    )
