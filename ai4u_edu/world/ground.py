"""The floors of a world, by height."""

from collections.abc import Iterable

from ai4u_edu.world.region import Region

SAME_HEIGHT_M = 1e-9
"""Heights closer than this (metres) count as equal."""


class Ground:
    """Floors sorted by height; without any, the ground is endless at height 0.

    Args:
        floors: top (metres) and region of each.
    """

    def __init__(self, floors: Iterable[tuple[float, Region]] = ()) -> None:
        self.floors = sorted(floors, key=lambda pair: -pair[0])

    def at(self, x: float, y: float, below: float = float("inf")) -> float | None:
        """Return the highest floor at a place that is not above ``below``; None over the void."""
        if not self.floors:
            return 0.0 if below >= -SAME_HEIGHT_M else None
        for top, region in self.floors:
            if top <= below + SAME_HEIGHT_M and region.contains(x, y):
                return top
        return None
