"""The grid on a floor: lines 1 m apart (more on large floors), clipped to the floor's shape."""

import math

import numpy as np

from ai4u_edu.page.viewer.scene.geometry import Array

MAX_LINES_PER_DIRECTION = 60
"""A floor that would need more lines gets a coarser grid."""


def grid_step(width: float) -> float:
    """Return the distance (m) between lines on a floor of a width (m): 1, 2, 5, 10, ...

    >>> [grid_step(width) for width in (10, 60, 100, 250, 1000)]
    [1.0, 1.0, 2.0, 5.0, 20.0]
    """
    step = 1.0
    while width / step > MAX_LINES_PER_DIRECTION:
        step *= 2.5 if str(step)[0] == "2" else 2.0
    return step


def grid_in(outline: Array, hole: Array | None, z: float) -> Array:
    """Return the grid's lines (n, 2, 3) inside a convex outline and outside a convex hole."""
    step = grid_step(float(np.ptp(outline, axis=0).max()))
    vertical = _along_y(outline, hole, step)
    horizontal = _along_y(outline[:, ::-1], None if hole is None else hole[:, ::-1], step)[
        ..., ::-1
    ]
    lines = np.concatenate([vertical, horizontal])
    return np.concatenate([lines, np.full((*lines.shape[:2], 1), z)], axis=2)


def _along_y(outline: Array, hole: Array | None, step: float) -> Array:
    left, right = float(outline[:, 0].min()), float(outline[:, 0].max())
    lines = []
    for number in range(math.floor(left / step) + 1, math.ceil(right / step)):
        x = number * step
        inside = _intersect(outline, x)
        if inside is None:
            continue
        gap = None if hole is None else _intersect(hole, x)
        spans = [inside] if gap is None else [(inside[0], gap[0]), (gap[1], inside[1])]
        lines += [((x, low), (x, high)) for low, high in spans if high > low]
    return np.array(lines, np.float64).reshape(-1, 2, 2)


def _intersect(outline: Array, x: float) -> tuple[float, float] | None:
    """Return the y at which the line at x enters and leaves a convex outline; None if it misses."""
    ax, ay = outline[:, 0], outline[:, 1]
    bx, by = np.roll(ax, -1), np.roll(ay, -1)
    crossing = (ax < x) != (bx < x)
    if not crossing.any():
        return None
    y = ay[crossing] + (x - ax[crossing]) / (bx - ax)[crossing] * (by - ay)[crossing]
    return float(y.min()), float(y.max())
