"""What there is to stand on, by height."""

from collections.abc import Iterable

from ai4u_edu.world.region import Region

SAME = 1e-9
"""Heights closer than this (metres) are the same."""


class Ground:
    """Floors, to be asked for the highest one at a place; without any, endless ground at height 0.

    Args:
        floors: the top of each (metres), and where it lies.
    """

    def __init__(self, floors: Iterable[tuple[float, Region]] = ()) -> None:
        self.floors = sorted(floors, key=lambda pair: -pair[0])

    def at(self, x: float, y: float, below: float = float("inf")) -> float | None:
        """The highest floor at a place that is not above ``below``; None over the void."""
        if not self.floors:
            return 0.0 if below >= -SAME else None
        for top, region in self.floors:
            if top <= below + SAME and region.contains(x, y):
                return top
        return None
