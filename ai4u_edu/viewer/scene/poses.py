"""Poses at which bodies and their shadows are drawn, as arrays. Metres, world frame."""

from typing import NamedTuple

import numpy as np

from ai4u_edu.snapshot import BodyState, Snapshot
from ai4u_edu.viewer.scene.arena import floor_under, lowest_floor
from ai4u_edu.viewer.scene.geometry import Array
from ai4u_edu.viewer.scene.layers import Layers

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
    """Return the drawn poses of all bodies of a snapshot."""
    bodies, static_scene = snapshot.bodies, snapshot.static_scene
    numbers = np.array([(b.x, b.y, b.z, b.heading, b.fallen) for b in bodies]).reshape(-1, 5)
    positions, half_headings, gone = numbers[:, :3], numbers[:, 3] / 2, numbers[:, 4] > 0
    lowest = lowest_floor(static_scene)
    reach = max(lowest - static_scene.settings.fall_threshold, 0.1)
    depths = np.clip((lowest - positions[:, 2]) / reach, 0.0, 1.0)
    scales = np.where(gone, 0.0, 1 - (1 - MIN_FALLING_SCALE) * depths)
    grounds = np.array([_ground(snapshot, body) for body in bodies])
    is_void = np.isnan(grounds)
    grounds = np.where(is_void, 0.0, grounds)
    rise = np.where(is_void, 0.0, np.maximum(positions[:, 2] - grounds, 0.0))
    offset = (SHADOW_OFFSET_M + SHADOW_OFFSET_PER_HEIGHT * rise)[:, None] * SHADOW_DIRECTION
    zeros = np.zeros(len(bodies))
    return Poses(
        positions=positions + np.array([0, 0, layers.body]),
        wxyzs=np.stack([np.cos(half_headings), zeros, zeros, np.sin(half_headings)], axis=1),
        scales=scales,
        depths=depths,
        shadow_positions=np.column_stack([positions[:, :2] + offset, grounds + layers.shadow]),
        shadow_scales=np.where(is_void | gone, 0.0, 1.0),
    )


def _ground(snapshot: Snapshot, body: BodyState) -> float:
    """Return the height of the ground under a body; NaN over the void."""
    if body.on_ground:
        return body.z
    under = floor_under(snapshot.static_scene, body.x, body.y, body.z)
    return np.nan if under is None else under
