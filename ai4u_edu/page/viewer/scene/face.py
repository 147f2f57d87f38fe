"""Marks on top of bodies: an agent's face, a target's rings. Body frame, metres."""

import numpy as np

from ai4u_edu.page.viewer.scene.geometry import Mesh, cap, circle, flat_mesh, join_meshes
from ai4u_edu.snapshot.marks import EYES, NOSE, PUPILS, RING, RING_CENTRE


def face(radius: float, z: float) -> Mesh:
    """Return the light parts of an agent's face: a nose that points ahead (+x), whites of the eyes.

    Args:
        radius: radius of the disc on which the face is drawn.
        z: height of that disc.
    """
    eyes = [circle(r * radius, x * radius, y * radius, 20) for x, y, r in EYES]
    return join_meshes([cap(outline, z) for outline in (radius * np.array(NOSE), *eyes)])


def pupils(radius: float, z: float) -> Mesh:
    """Return the dark parts of an agent's face: pupils that look ahead."""
    eyes = [circle(r * radius, x * radius, y * radius, 16) for x, y, r in PUPILS]
    return join_meshes([cap(outline, z) for outline in eyes])


def rings(radius: float, z: float) -> Mesh:
    """Return a target's mark, a ring around a disc, which tells targets apart without colour."""
    outer, inner = RING
    ring = flat_mesh(circle(outer * radius), circle(inner * radius)).moved(0, 0, z)
    return join_meshes([ring, cap(circle(RING_CENTRE * radius), z)])
