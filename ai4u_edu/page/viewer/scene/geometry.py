"""Meshes and line segments from outlines; all lengths in metres, outlines counter-clockwise."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.snapshot.marks import edge_normals

Array = npt.NDArray[np.float64]
Outline = Sequence[tuple[float, float]] | Array


class Mesh(NamedTuple):
    """A triangle mesh: (v, 3) vertices and (f, 3) indices, counter-clockwise seen from outside."""

    vertices: Array
    faces: npt.NDArray[np.int64]

    def moved(self, x: float, y: float, z: float = 0.0) -> "Mesh":
        """Return the mesh translated by (x, y, z)."""
        return Mesh(self.vertices + np.array([x, y, z]), self.faces)


def rotate(points: Array, angle: float) -> Array:
    """Rotate (n, 2) points around the origin by an angle in radians."""
    c, s = math.cos(angle), math.sin(angle)
    rotated: Array = points @ np.array([[c, s], [-s, c]])
    return rotated


def heading_wxyz(heading: float) -> tuple[float, float, float, float]:
    """Return the quaternion w, x, y, z of a rotation around z by an angle in radians."""
    return math.cos(heading / 2), 0.0, 0.0, math.sin(heading / 2)


def grow(outline: Outline, by: float) -> Array:
    """Move the edges of a convex outline outwards by a distance; inwards if it is negative.

    >>> grow([(1, 1), (-1, 1), (-1, -1), (1, -1)], 0.5).tolist()
    [[1.5, 1.5], [-1.5, 1.5], [-1.5, -1.5], [1.5, -1.5]]
    """
    corners = np.asarray(outline, np.float64)
    normals = edge_normals(corners)
    before = np.roll(normals, 1, axis=0)
    # bounded, because the tip of a sharp corner would move very far
    stretch = np.maximum(1.0 + (normals * before).sum(axis=1, keepdims=True), 0.25)
    moved: Array = corners + by * (normals + before) / stretch
    return moved


def cap(outline: Outline, z: float = 0.0) -> Mesh:
    """Return a flat, convex mesh that faces up."""
    corners = np.asarray(outline, np.float64)
    n = len(corners)
    second = np.arange(1, n - 1)
    fan = np.stack([np.zeros_like(second), second, second + 1], axis=1)
    return Mesh(np.column_stack([corners, np.full(n, z)]), fan)


def band(low: Outline, low_z: float, high: Outline, high_z: float) -> Mesh:
    """Return the strip between two outlines with the same number of corners.

    It faces outwards and up if ``low`` lies around ``high`` or right below it.
    """
    n = len(low)
    i = np.arange(n)
    j = (i + 1) % n
    corners = np.concatenate(
        [np.column_stack([low, np.full(n, low_z)]), np.column_stack([high, np.full(n, high_z)])]
    )
    faces = np.concatenate([np.stack([i, j, n + j], axis=1), np.stack([i, n + j, n + i], axis=1)])
    return Mesh(corners, faces)


def flat_mesh(outline: Outline, hole: Outline | None = None, z: float = 0.0) -> Mesh:
    """Return a flat mesh that faces up. A hole needs as many corners as the outline."""
    return cap(outline, z) if hole is None else band(outline, z, hole, z)


def join_meshes(meshes: Sequence[Mesh]) -> Mesh:
    """Join meshes into one, drawn in the given order."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([m.faces + start for m, start in zip(meshes, starts, strict=False)]),
    )


def prism(outline: Outline, height: float, rim: float) -> Mesh:
    """Extrude a convex outline from z = 0 to ``height``, open below.

    The upper edge is bevelled by ``rim`` (its width in metres, seen from above). The bevel gets
    less light than the top, so it appears as the outline. The parts share no vertices, because
    shading would be smoothed across shared ones.
    """
    inner = grow(outline, -rim)
    shoulder = height - min(3.0 * rim, 0.5 * height)
    side = band(outline, 0.0, outline, shoulder)
    edge = band(outline, shoulder, inner, height)
    return join_meshes([side, edge, cap(inner, height)])


def dome(outline: Outline, low: float, high: float, top: float) -> Mesh:
    """Return a solid over a convex outline around the origin, open below, whose top is rounded.

    Args:
        outline: outline of its lower edge.
        low: height of that edge.
        high: height of its flat top.
        top: size of the flat top, as a share of the outline's.
    """
    corners = np.asarray(outline, np.float64)
    shoulder = high - min(DOME_RATIO * (1.0 - top) * float(np.abs(corners).max()), high - low)
    angles = np.linspace(0.0, math.pi / 2, DOME_STEPS + 1)
    sizes = 1.0 - (1.0 - top) * (1.0 - np.cos(angles))
    levels = shoulder + (high - shoulder) * np.sin(angles)
    steps = list(zip(sizes.tolist(), levels.tolist(), strict=True))
    bands = [
        band(corners * size, z, corners * next_size, next_z)
        for (size, z), (next_size, next_z) in pairwise([(1.0, low), *steps])
    ]
    return join_meshes([*bands, cap(corners * top, high)])


def cylinder(radius: float, width: float, corners: int = 20) -> Mesh:
    """Return a closed cylinder around the origin, whose axis is along y."""
    edge = circle(radius, corners=corners)
    end = cap(edge, width / 2)
    other = Mesh(end.vertices * (1, 1, -1), end.faces[:, ::-1])
    return _laid(join_meshes([band(edge, -width / 2, edge, width / 2), end, other]))


def cylinder_bars(radius: float, width: float, count: int, angle: float) -> Mesh:
    """Return bars around such a cylinder: flat strips along its axis, each an angle (rad) wide."""
    turns = np.arange(count) * (2 * math.pi / count)
    bars = []
    for turn in turns.tolist():
        ends = radius * np.array(
            [(math.sin(turn + by), math.cos(turn + by)) for by in (angle / 2, -angle / 2)]
        )
        (x, z), (far_x, far_z) = ends.tolist()
        half = width / 2
        corners = [(x, half, z), (far_x, half, far_z), (far_x, -half, far_z), (x, -half, z)]
        bars.append(Mesh(np.array(corners), np.array([[0, 1, 2], [0, 2, 3]])))
    return join_meshes(bars)


def _laid(mesh: Mesh) -> Mesh:
    """Return a mesh with its z axis laid along y."""
    return Mesh(mesh.vertices[:, [0, 2, 1]] * (1, -1, 1), mesh.faces)


DOME_STEPS = 4
"""Bands of a rounded top."""
DOME_RATIO = 1.5
"""Height of a rounded top for each metre of its width."""


def soft_shadow(
    outline: Outline, blur: float, depth: float, count: int
) -> list[tuple[Array, float]]:
    """Return a shadow with a soft edge, as stacked translucent layers, each a little smaller.

    Args:
        outline: outline of the body that casts the shadow.
        blur: width of the soft edge.
        depth: height of the highest layer above the lowest one, which is at 0.
        count: number of layers.

    Returns:
        The outline and the height of each layer.
    """
    shares = np.linspace(0.0, 1.0, count).tolist()
    return [(grow(outline, blur * (0.5 - share)), share * depth) for share in shares]


def segments(outline: Outline, z: float = 0.0) -> Array:
    """Return an outline's edges as (n, 2, 3) line segments."""
    corners = np.asarray(outline, np.float64)
    points = np.column_stack([corners, np.full(len(corners), z)])
    return np.stack([points, np.roll(points, -1, axis=0)], axis=1)


def circle(radius: float, x: float = 0.0, y: float = 0.0, corners: int = 32) -> Array:
    """Return a circle's outline."""
    angles = np.arange(corners) * (2 * math.pi / corners)
    around = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    outline: Array = np.array([x, y]) + radius * around
    return outline
