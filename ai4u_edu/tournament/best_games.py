"""Games of a tournament that are worth watching."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from ai4u_edu.tournament.contest import ContestResult
from ai4u_edu.tournament.standings import Standing


class BestGame(NamedTuple):
    """A finished game."""

    place: int
    """Place of its contest in the schedule."""
    result: ContestResult
    """Result of its contest."""
    game: int
    """Index of the game in the contest."""


Ended = Mapping[int, ContestResult]


def best_games(ended: Ended, order: Sequence[Standing], count: int) -> list[BestGame]:
    """Return finished games between strong entries, a different pair each, the best first.

    Args:
        ended: results of the contests so far, by place in the schedule.
        order: its standings.
        count: number of games, or fewer.
    """
    found: dict[tuple[str, ...], BestGame] = {}
    for each in _candidates(ended, order):
        names, contest = each.result.contest.names, each.result.contest
        key = (names[each.game], str(contest.seed)) if contest.is_race else names
        found.setdefault(key, each)
        if len(found) == count:
            break
    return [*found.values()]


def _candidates(ended: Ended, order: Sequence[Standing]) -> Iterator[BestGame]:
    strength = {each.name: each.mu for each in order}
    clean = [(place, ended[place]) for place in sorted(ended)]
    clean = [(place, each) for place, each in clean if not each.error and _is_clean(each)]
    clean.sort(
        key=lambda found: (
            len(set(found[1].ranks)) == 1,  # a game that somebody wins is better to watch
            -sum(sorted(strength[name] for name in found[1].contest.names)[-2:]),
        )
    )
    for place, each in clean:
        game = each.ranks.index(0) if each.contest.is_race else _clearer_game(each)
        yield BestGame(place, each, game)


def _clearer_game(result: ContestResult) -> int:
    """Return the index of a duel's game with the larger difference of points."""
    differences = [abs(told["points"][0] - told["points"][1]) for told in result.games]
    return differences.index(max(differences))


def _is_clean(result: ContestResult) -> bool:
    return all(told["forfeit"] < 0 and told["episode"] for told in result.games)
