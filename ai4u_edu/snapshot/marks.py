"""Marks on bodies: an agent's face and a target's rings, in radii of a disc on the body."""

import numpy as np
import numpy.typing as npt

from ai4u_edu.snapshot.theme import Rgb

Disc = tuple[float, float, float]
"""A disc's centre, ahead (+x) and to the left (+y), and its radius."""

NOSE = ((0.97, 0.0), (0.52, 0.24), (0.52, -0.24))
"""Corners of the nose, which points ahead."""
EYES: tuple[Disc, ...] = ((0.34, 0.5, 0.23), (0.34, -0.5, 0.23))
"""Whites of the eyes."""
PUPILS: tuple[Disc, ...] = ((0.42, 0.48, 0.12), (0.42, -0.48, 0.12))
RING = 0.72, 0.5
"""Outer and inner radius of a target's ring, which tells targets apart without colour."""
RING_CENTRE = 0.22
"""Radius of the disc in the middle of the ring."""
LIGHT: Rgb = (240, 243, 246)
DARK: Rgb = (24, 28, 34)


def half_width(outline: npt.ArrayLike) -> float:
    """Return half the smallest width of a convex outline: half a wall's thickness.

    >>> half_width([(2, 1), (-2, 1), (-2, -1), (2, -1)])
    1.0
    """
    corners = np.asarray(outline, np.float64)
    depths = edge_normals(corners) @ corners.T
    return float(np.ptp(depths, axis=1).min() / 2)


def edge_normals(corners: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return the outward unit normal of each edge of a counter-clockwise outline (n, 2)."""
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1)
    unit: npt.NDArray[np.float64] = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return unit
