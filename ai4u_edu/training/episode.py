"""How an episode went, and how sure a share of episodes is."""

import math
from typing import NamedTuple


class Episode(NamedTuple):
    """How one episode went."""

    seed: int
    success: bool
    reward: float
    """Of all its decisions together."""
    length: int
    """Decisions."""
    terminated: bool
    """Whether it ended by what happened; else it was cut off."""


def wilson(successes: int, trials: int, z: float = 1.959964) -> tuple[float, float]:
    """Between which shares the true one lies, 19 times out of 20.

    Wilson's interval: unlike the plain one (share plus or minus its error) it stays within 0..1 and
    says something sensible when all trials succeeded, or none.

    Args:
        successes: how many.
        trials: of how many, at least 1.
        z: how many standard deviations to each side; 1.96 for 95%.

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
