"""Marks on top of bodies: an agent's face, a target's rings. Body frame, metres."""

import numpy as np

from ai4u_edu.viewer.scene.geometry import Mesh, cap, circle, flat_mesh, join_meshes


def face(radius: float, z: float) -> Mesh:
    """Return the light parts of an agent's face: a nose that points ahead (+x), whites of the eyes.

    Args:
        radius: radius of the disc on which the face is drawn.
        z: height of that disc.
    """
    nose = radius * np.array([(0.97, 0.0), (0.52, 0.24), (0.52, -0.24)])
    eyes = [circle(0.23 * radius, 0.34 * radius, side * 0.5 * radius, 20) for side in (1, -1)]
    return join_meshes([cap(outline, z) for outline in (nose, *eyes)])


def pupils(radius: float, z: float) -> Mesh:
    """Return the dark parts of an agent's face: pupils that look ahead."""
    eyes = [circle(0.12 * radius, 0.42 * radius, side * 0.48 * radius, 16) for side in (1, -1)]
    return join_meshes([cap(outline, z) for outline in eyes])


def rings(radius: float, z: float) -> Mesh:
    """Return a target's mark, a ring around a disc, which tells targets apart without colour."""
    ring = flat_mesh(circle(0.72 * radius), circle(0.5 * radius)).moved(0, 0, z)
    return join_meshes([ring, cap(circle(0.22 * radius), z)])
