"""Poses at which bodies and their shadows are drawn, as arrays. Metres, world frame."""

from typing import NamedTuple

import numpy as np

from ai4u_edu.page.viewer.scene.geometry import Array
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.snapshot import BodyState, Snapshot

SHADOW_DIRECTION = np.array([0.6, -0.8])
"""Unit vector along which shadows fall."""
SHADOW_OFFSET_M = 0.11
"""Distance (m) of the shadow from a body that stands on the ground."""
SHADOW_OFFSET_PER_HEIGHT = 0.5
"""Additional distance for each metre above the ground."""
MIN_FALLING_SCALE = 0.35
"""Scale of a body at the height at which it leaves the world."""


class Poses(NamedTuple):
    """The drawn poses of all bodies, one row for each."""

    positions: Array
    """(n, 3)"""
    wxyzs: Array
    """(n, 4) quaternions w, x, y, z."""
    scales: Array
    """(n,) 1 normally, less while a body falls, 0 for bodies that left the world."""
    depths: Array
    """(n,) 0 on or above the lowest floor, 1 at the height at which a body leaves the world."""
    shadow_positions: Array
    """(n, 3)"""
    shadow_scales: Array
    """(n,) 0 where there is no ground for the shadow."""


def compute_poses(snapshot: Snapshot, layers: Layers) -> Poses:
    """Return the drawn poses of all bodies of a snapshot.

    It runs in every frame, mostly for few bodies: so it makes few calls of numpy.
    """
    bodies, static_scene = snapshot.bodies, snapshot.static_scene
    grounds = [_ground(snapshot, body) for body in bodies]
    numbers = np.array(
        [(b.x, b.y, b.z, b.heading, g or 0.0) for b, g in zip(bodies, grounds, strict=True)]
    ).reshape(-1, 5)
    heights, half_headings, ground_heights = numbers[:, 2], numbers[:, 3] / 2, numbers[:, 4]
    is_gone = np.array([body.fallen for body in bodies], dtype=bool)
    is_void = np.array([ground is None for ground in grounds], dtype=bool)
    lowest = static_scene.lowest_floor
    reach = max(lowest - static_scene.settings.fall_threshold, 0.1)
    depths = np.minimum(np.maximum((lowest - heights) / reach, 0.0), 1.0)
    scales = 1 - (1 - MIN_FALLING_SCALE) * depths
    scales[is_gone] = 0.0
    rise = np.maximum(heights - ground_heights, 0.0)
    rise[is_void] = 0.0
    positions = numbers[:, :3] + (0.0, 0.0, layers.body)
    wxyzs = np.zeros((len(bodies), 4))
    wxyzs[:, 0], wxyzs[:, 3] = np.cos(half_headings), np.sin(half_headings)
    shadow_positions = np.empty((len(bodies), 3))
    offset = SHADOW_OFFSET_M + SHADOW_OFFSET_PER_HEIGHT * rise
    shadow_positions[:, :2] = numbers[:, :2] + offset[:, None] * SHADOW_DIRECTION
    shadow_positions[:, 2] = ground_heights + layers.shadow
    shadow_scales = np.ones(len(bodies))
    shadow_scales[is_void | is_gone] = 0.0
    return Poses(positions, wxyzs, scales, depths, shadow_positions, shadow_scales)


def _ground(snapshot: Snapshot, body: BodyState) -> float | None:
    """Return the height of the ground under a body; None over the void."""
    if body.on_ground:
        return body.z
    return snapshot.static_scene.floor_under(body.x, body.y, body.z)
