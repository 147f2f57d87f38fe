"""Where the camera must be: a very long lens far above, which looks as if it had no perspective."""

import math
from dataclasses import dataclass

Bounds = tuple[tuple[float, float], tuple[float, float]]

FIELD_OF_VIEW = math.radians(2.0)
"""Vertical. So long a lens shows a wall's side by a pixel or two at most."""
MARGIN = 0.07
"""Free space around the arena, as a share of its size."""
PORTRAIT = 0.8
"""A window narrower than this (width / height) is a phone's: the panel covers its lower part."""
FREE_IN_PORTRAIT = 0.62
"""The upper share of such a window that stays free."""
LANDSCAPE = 1.6
"""A window wider than this has room for the keys beside the arena."""
FREE_ABOVE_KEYS = 0.9
"""The upper share of a window in between; the keys lie at its lower edge."""


@dataclass(frozen=True)
class Frame:
    """What a camera shows: metres, in the world's frame."""

    x: float
    y: float
    height: float
    """How much of the world fits between the window's upper and lower edge."""

    @property
    def distance(self) -> float:
        """How far above the ground the camera is."""
        return self.height / 2 / math.tan(FIELD_OF_VIEW / 2)

    @property
    def near(self) -> float:
        """What is closer to the camera than this isn't drawn; leaves room to zoom in."""
        return self.distance / 25

    @property
    def far(self) -> float:
        """What is farther from the camera than this isn't drawn; leaves room to zoom out."""
        return self.distance * 8


def visible_height(distance: float) -> float:
    """How much of the world fits between the window's edges from a distance; both in metres."""
    return 2 * distance * math.tan(FIELD_OF_VIEW / 2)


def free_part(aspect: float) -> float:
    """The upper share of a window of that aspect which nothing covers."""
    if aspect < PORTRAIT:
        return FREE_IN_PORTRAIT
    return FREE_ABOVE_KEYS if aspect < LANDSCAPE else 1.0


def frame(bounds: Bounds, aspect: float) -> Frame:
    """The frame that has a whole arena in the free part of a window.

    Args:
        bounds: ((left, low), (right, high)) of the arena.
        aspect: the window's width / height.
    """
    (left, low), (right, high) = bounds
    free = free_part(aspect)
    size = max(right - left, high - low, 1.0)
    wide, tall = right - left + 2 * MARGIN * size, high - low + 2 * MARGIN * size
    height = max(tall / free, wide / aspect)
    return centred((left + right) / 2, (low + high) / 2, height, aspect)


def centred(x: float, y: float, height: float, aspect: float) -> Frame:
    """The frame that has a point in the middle of the free part of a window."""
    return Frame(x, y - (1 - free_part(aspect)) / 2 * height, height)
