"""Meshes and line segments from outlines; all lengths in metres, outlines counter-clockwise."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Outline = Sequence[tuple[float, float]] | Array


class Mesh(NamedTuple):
    """Triangles: (v, 3) corners and (f, 3) indices into them, counter-clockwise from outside."""

    vertices: Array
    faces: npt.NDArray[np.int64]

    def moved(self, x: float, y: float, z: float = 0.0) -> "Mesh":
        """The same mesh elsewhere."""
        return Mesh(self.vertices + np.array([x, y, z]), self.faces)


def turn(points: Array, angle: float) -> Array:
    """(n, 2) points turned around the origin by an angle in radians."""
    c, s = math.cos(angle), math.sin(angle)
    turned: Array = points @ np.array([[c, s], [-s, c]])
    return turned


def grow(outline: Outline, by: float) -> Array:
    """A convex outline whose edges have moved outwards; inwards for a negative ``by``.

    >>> grow([(1, 1), (-1, 1), (-1, -1), (1, -1)], 0.5).tolist()
    [[1.5, 1.5], [-1.5, 1.5], [-1.5, -1.5], [1.5, -1.5]]
    """
    corners = np.asarray(outline, np.float64)
    normals = _normals(corners)
    before = np.roll(normals, 1, axis=0)
    # a sharp corner's tip would fly far away, hence the bound
    stretch = np.maximum(1.0 + (normals * before).sum(axis=1, keepdims=True), 0.25)
    moved: Array = corners + by * (normals + before) / stretch
    return moved


def half_width(outline: Outline) -> float:
    """Half the width of a convex outline where it is narrowest: the thickness of a wall, halved."""
    corners = np.asarray(outline, np.float64)
    depths = _normals(corners) @ corners.T
    return float(np.ptp(depths, axis=1).min() / 2)


def cap(outline: Outline, z: float = 0.0) -> Mesh:
    """A flat convex sheet that faces up."""
    corners = np.asarray(outline, np.float64)
    n = len(corners)
    second = np.arange(1, n - 1)
    fan = np.stack([np.zeros_like(second), second, second + 1], axis=1)
    return Mesh(np.column_stack([corners, np.full(n, z)]), fan)


def band(low: Outline, low_z: float, high: Outline, high_z: float) -> Mesh:
    """The strip between two outlines of the same number of corners.

    It faces outwards and up where ``low`` lies outside of ``high``, or right below it.
    """
    n = len(low)
    i = np.arange(n)
    j = (i + 1) % n
    corners = np.concatenate(
        [np.column_stack([low, np.full(n, low_z)]), np.column_stack([high, np.full(n, high_z)])]
    )
    faces = np.concatenate([np.stack([i, j, n + j], axis=1), np.stack([i, n + j, n + i], axis=1)])
    return Mesh(corners, faces)


def sheet(outline: Outline, hole: Outline | None = None, z: float = 0.0) -> Mesh:
    """A flat sheet that faces up; with a hole, both outlines have as many corners."""
    return cap(outline, z) if hole is None else band(outline, z, hole, z)


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Several meshes as one; drawn in this order."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([m.faces + start for m, start in zip(meshes, starts, strict=False)]),
    )


def prism(outline: Outline, height: float, rim: float) -> Mesh:
    """A convex outline pulled up from z = 0 to ``height``, open below.

    The upper edge is cut off along a steep ``rim`` (metres wide, as seen from above): it catches
    less light than the top, and so draws the outline. The parts share no corners, as corners that
    are shared are shaded softly.
    """
    inner = grow(outline, -rim)
    shoulder = height - min(3.0 * rim, 0.5 * height)
    side = band(outline, 0.0, outline, shoulder)
    edge = band(outline, shoulder, inner, height)
    return joined([side, edge, cap(inner, height)])


def soft(outline: Outline, blur: float, depth: float, sheets: int) -> list[tuple[Array, float]]:
    """A shadow with a soft edge, as sheets on top of each other, each a little smaller.

    Args:
        outline: of what throws it.
        blur: how wide the soft edge is.
        depth: from the lowest sheet, at height 0, to the highest.
        sheets: how many.

    Returns:
        The outline and the height of each sheet.
    """
    shares = np.linspace(0.0, 1.0, sheets).tolist()
    return [(grow(outline, blur * (0.5 - share)), share * depth) for share in shares]


def segments(outline: Outline, z: float = 0.0) -> Array:
    """An outline's edges as (n, 2, 3) line segments."""
    corners = np.asarray(outline, np.float64)
    points = np.column_stack([corners, np.full(len(corners), z)])
    return np.stack([points, np.roll(points, -1, axis=0)], axis=1)


def circle(radius: float, x: float = 0.0, y: float = 0.0, corners: int = 32) -> Array:
    """A circle's outline."""
    angles = np.arange(corners) * (2 * math.pi / corners)
    around = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    outline: Array = np.array([x, y]) + radius * around
    return outline


def _normals(corners: Array) -> Array:
    """The outward unit normal of each edge."""
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1)
    unit: Array = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return unit
