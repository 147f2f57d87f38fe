"""Result of an episode, and the confidence interval of a share of episodes."""

import math
from typing import NamedTuple


class EpisodeStats(NamedTuple):
    """Result of one episode."""

    seed: int
    success: bool
    reward: float
    """Sum over all decisions (the return)."""
    length: int
    """Decisions."""
    terminated: bool
    """True if it ended by what happened, False if it was truncated."""
    seconds: float = 0.0
    """Duration (s) in world time; 0 in a check of a training, which does not measure it."""


def wilson(successes: int, trials: int, z: float = 1.959964) -> tuple[float, float]:
    """Return the 95% confidence interval of a share.

    Wilson's interval: unlike the plain one (share plus or minus its error) it stays within 0..1 and
    says something sensible when all trials succeeded, or none.

    Args:
        successes: number of successes.
        trials: number of trials, at least 1.
        z: standard deviations to each side; 1.96 for 95%.

    Source: E. B. Wilson, Journal of the American Statistical Association 22 (1927) 209-212.

    >>> low, high = wilson(100, 100)
    >>> round(low, 3), round(high, 3)
    (0.963, 1.0)
    >>> low, high = wilson(5, 10)
    >>> round(low, 3), round(high, 3)
    (0.237, 0.763)
    """
    share = successes / trials
    weight = 1 + z * z / trials
    middle = (share + z * z / (2 * trials)) / weight
    reach = z / weight * math.sqrt(share * (1 - share) / trials + (z / (2 * trials)) ** 2)
    # rounding may put an end on the wrong side of the share: of 10 in 10 the upper one below 1
    return max(0.0, min(share, middle - reach)), min(1.0, max(share, middle + reach))
