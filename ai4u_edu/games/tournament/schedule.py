"""Schedules: round robin, Swiss rounds, and races."""

from collections.abc import Mapping, Sequence
from itertools import combinations

from ai4u_edu.games.tournament.contest import Contest
from ai4u_edu.games.tournament.entry import Entry
from ai4u_edu.games.tournament.standings import Standing


def round_robin(entries: Sequence[Entry], seeds: Sequence[int]) -> list[Contest]:
    """Return a duel of each pair on each seed."""
    return [
        Contest(seed, pair, is_race=False) for seed in seeds for pair in combinations(entries, 2)
    ]


def races(entries: Sequence[Entry], seeds: Sequence[int]) -> list[Contest]:
    """Return a race of all entries on each seed."""
    return [Contest(seed, tuple(entries), is_race=True) for seed in seeds]


def swiss_round(
    entries: Mapping[str, Entry], order: Sequence[Standing], seeds: Sequence[int]
) -> list[Contest]:
    """Return the duels of a round: neighbours in the standings who have not met.

    With an odd number of entries, the lowest one that has played most rests.

    Args:
        entries: by name.
        order: standings, the best first.
        seeds: of each pair's duels.
    """
    by_score = sorted(order, key=lambda each: (-each.score, -each.mu, each.name))
    if len(by_score) % 2:
        most = max(len(each.against) for each in by_score)
        resting = [each for each in by_score if len(each.against) == most][-1]
        by_score.remove(resting)
    pairs = _pairs(by_score) or _neighbours(by_score)
    return [
        Contest(seed, (entries[one.name], entries[other.name]), is_race=False)
        for seed in seeds
        for one, other in pairs
    ]


def _pairs(order: list[Standing]) -> list[tuple[Standing, Standing]]:
    """Pair the first one with the next it has not met, and so on; empty if that can't be done."""
    if not order:
        return []
    first, *others = order
    for other in others:
        if other.name in first.against:
            continue
        left = [each for each in others if each is not other]
        rest = _pairs(left)
        if rest or not left:
            return [(first, other), *rest]
    return []


def _neighbours(order: list[Standing]) -> list[tuple[Standing, Standing]]:
    return list(zip(order[::2], order[1::2], strict=True))
