"""Camera poses from above: a very long lens, far away, so that perspective can't be seen."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

Bounds = tuple[tuple[float, float], tuple[float, float]]

FIELD_OF_VIEW_RAD = math.radians(2.0)
"""Vertical field of view, so small that a wall's side covers two pixels at most."""
MARGIN = 0.07
"""Free space around the arena, as a share of its size."""
MAX_PORTRAIT_ASPECT = 0.8
"""Largest aspect (width / height) of a phone's window, whose lower part the panel covers."""
PORTRAIT_UNCOVERED_SHARE = 0.62
"""Upper share of such a window that nothing covers."""
MIN_LANDSCAPE_ASPECT = 1.6
"""Smallest aspect of a window with room for the keys beside the arena."""
UNCOVERED_SHARE_ABOVE_KEYS = 0.9
"""Upper share of a window between the two, whose lower edge the keys cover."""

BANNER_SHARE = 0.06
"""Upper share of a window that is not a phone's, where the goal and how an episode ended stand."""
MAX_BANNER_ASPECT = 2.0
"""Aspect of a phone on its side, from which on they stand beside the arena."""


@dataclass(frozen=True)
class Frame:
    """The part of the world that a camera shows: its centre and height, in metres, world frame."""

    x: float
    y: float
    height: float
    """Distance in the world between the window's upper and lower edge."""

    @property
    def distance(self) -> float:
        """Height of the camera above the ground."""
        return self.height / 2 / math.tan(FIELD_OF_VIEW_RAD / 2)

    @property
    def near(self) -> float:
        """Near clipping distance; leaves room to zoom in."""
        return self.distance / 25

    @property
    def far(self) -> float:
        """Far clipping distance; leaves room to zoom out."""
        return self.distance * 8


TILTED_FIELD_OF_VIEW_RAD = math.radians(38)
"""Vertical field of view of the tilted camera."""
TILT_RAD = math.radians(52)
"""Angle at which it looks down, from the horizon."""
TALL_M = 1.5
"""Height (m) above the arena that it shows, too."""


@dataclass(frozen=True)
class TiltedFrame:
    """The pose of a camera that looks at the arena from the south, tilted."""

    target: tuple[float, float, float]
    distance: float
    """From the target (m)."""

    @property
    def position(self) -> tuple[float, float, float]:
        """Place of the camera."""
        x, y, z = self.target
        south, up = self.distance * math.cos(TILT_RAD), self.distance * math.sin(TILT_RAD)
        return x, y - south, z + up

    def on_screen(self, point: tuple[float, float, float], aspect: float) -> tuple[float, float]:
        """Return a point's place in the window: -1 to 1 to the right, and up."""
        x, y, z = (a - b for a, b in zip(point, self.target, strict=True))
        depth = self.distance + y * math.cos(TILT_RAD) - z * math.sin(TILT_RAD)
        half = math.tan(TILTED_FIELD_OF_VIEW_RAD / 2) * max(depth, 1e-6)
        return x / half / aspect, (y * math.sin(TILT_RAD) + z * math.cos(TILT_RAD)) / half


def frame_tilted(bounds: Bounds, aspect: float) -> TiltedFrame:
    """Return the tilted frame that shows the whole arena in the uncovered part of a window.

    Args:
        bounds: ((left, low), (right, high)) of the arena, in metres.
        aspect: the window's width / height.
    """
    (left, low), (right, high) = bounds
    corners = [(x, y, z) for x in (left, right) for y in (low, high) for z in (0.0, TALL_M)]
    free, size = uncovered_share(aspect), max(right - left, high - low, 1.0)
    middle, limit = _middle(aspect), 1.0 - 2 * MARGIN
    y, distance = (low + high) / 2, 2.0 * size
    frame = TiltedFrame(((left + right) / 2, y, 0.0), distance)
    for _ in range(12):  # nearer or farther, and up or down, until it fits
        places = [frame.on_screen(corner, aspect) for corner in corners]
        top, bottom = max(v for _, v in places), min(v for _, v in places)
        wide = max(abs(u) for u, _ in places)
        distance *= max(wide / limit, (top - bottom) / (2 * free * limit))
        off = (top + bottom) / 2 - middle
        y += off * distance * math.tan(TILTED_FIELD_OF_VIEW_RAD / 2) / math.sin(TILT_RAD)
        frame = TiltedFrame(((left + right) / 2, y, 0.0), distance)
    return frame


def visible_height(distance: float) -> float:
    """Return the height of the visible part of the world, from a camera's distance (both in m)."""
    return 2 * distance * math.tan(FIELD_OF_VIEW_RAD / 2)


def uncovered_share(aspect: float) -> float:
    """Return the share of a window's height that neither panel nor keys nor banner cover."""
    return _uncovered_above(aspect) - _banner_share(aspect)


def _uncovered_above(aspect: float) -> float:
    """Return the upper share of a window that neither panel nor keys cover."""
    if aspect < MAX_PORTRAIT_ASPECT:
        return PORTRAIT_UNCOVERED_SHARE
    return UNCOVERED_SHARE_ABOVE_KEYS if aspect < MIN_LANDSCAPE_ASPECT else 1.0


def _banner_share(aspect: float) -> float:
    return BANNER_SHARE if MAX_PORTRAIT_ASPECT <= aspect < MAX_BANNER_ASPECT else 0.0


def _middle(aspect: float) -> float:
    """Return the place of the uncovered part's middle in a window, from -1 (low) to 1 (high)."""
    return 1.0 - _uncovered_above(aspect) - _banner_share(aspect)


def frame_arena(bounds: Bounds, aspect: float) -> Frame:
    """Return the frame that shows the whole arena in the uncovered part of a window.

    Args:
        bounds: ((left, low), (right, high)) of the arena, in metres.
        aspect: the window's width / height.
    """
    (left, low), (right, high) = bounds
    free = uncovered_share(aspect)
    size = max(right - left, high - low, 1.0)
    wide, tall = right - left + 2 * MARGIN * size, high - low + 2 * MARGIN * size
    height = max(tall / free, wide / aspect)
    return frame_point((left + right) / 2, (low + high) / 2, height, aspect)


def frame_point(x: float, y: float, height: float, aspect: float) -> Frame:
    """Return the frame that shows a point in the middle of the uncovered part of a window."""
    return Frame(x, y - _middle(aspect) / 2 * height, height)


def ground_at_center(position: Iterable[float], look_at: Iterable[float]) -> tuple[float, float]:
    """Return the point (x, y) of the ground in the middle of a camera's picture.

    For a camera that looks almost horizontally, as from an agent's eye, that point is far away;
    then return the point below the camera's target.

    >>> ground_at_center((3, 4, 10), (3, 4, 5))
    (3.0, 4.0)
    >>> ground_at_center((0, 0, 10), (2, 0, 5))
    (4.0, 0.0)
    >>> ground_at_center((0, 0, 1), (2, 0, 0.99))
    (2.0, 0.0)
    """
    (x, y, z), (target_x, target_y, target_z) = position, look_at
    dx, dy, down = target_x - x, target_y - y, z - target_z
    share = z / down if down > 0.2 * math.hypot(dx, dy) else 1.0
    return float(x + share * dx), float(y + share * dy)


def ground_matrix(
    position: Iterable[float], wxyz: Iterable[float], fov: float, aspect: float, z: float
) -> tuple[float, ...]:
    """Return the map from a camera's picture to the ground, as a 3 x 3 matrix, row by row.

    The matrix times (across, down, 1) is (w x, w y, w): (x, y) is the point of the ground (m) that
    is seen at these shares of the picture's width and height; w is above 0 if it lies ahead.

    Args:
        position: of the camera (m).
        wxyz: its orientation as a quaternion: x to the right, y down, z ahead.
        fov: vertical field of view (radians).
        aspect: width / height of the picture.
        z: height of the ground (m).

    >>> matrix = ground_matrix((3, 4, 10), (0, 1, 0, 0), 2 * math.atan(0.5), 2.0, 0.0)
    >>> [round(number, 6) + 0.0 for number in matrix]
    [20.0, 0.0, -7.0, 0.0, -10.0, 9.0, 0.0, 0.0, 1.0]
    """
    w, i, j, k = wxyz
    (x, y, height), tangent = position, math.tan(fov / 2)
    turn = (
        (1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w)),
        (2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w)),
        (2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j)),
    )
    # direction of the ray through (across, down), times (across, down, 1)
    right, below, ahead = (
        [
            2 * tangent * aspect * row[0],
            2 * tangent * row[1],
            row[2] - tangent * (aspect * row[0] + row[1]),
        ]
        for row in turn
    )
    depth = height - z
    rows = (
        [depth * a - x * c for a, c in zip(right, ahead, strict=True)],
        [depth * b - y * c for b, c in zip(below, ahead, strict=True)],
        [-c for c in ahead],
    )
    return tuple(float(number) for row in rows for number in row)
