"""Where bodies are drawn: numbers for the page, one row a body. Metres, world frame."""

from typing import NamedTuple

import numpy as np

from ai4u_edu.snapshot import BodyState, Snapshot
from ai4u_edu.viewer.scene.geometry import Array
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.placing import floor_under, lowest_floor

SHADOW = np.array([0.6, -0.8])
"""Which way shadows fall."""
SHADOW_AT_REST = 0.11
"""How far (m) the shadow of what stands on the ground reaches out from under it."""
SHADOW_RISE = 0.5
"""How much farther for every metre above the ground."""
SMALLEST = 0.35
"""What share of its size a body still has when it falls out of the world."""


class Poses(NamedTuple):
    """What the page needs to know of all bodies."""

    places: Array
    """(n, 3)"""
    turns: Array
    """(n, 4) quaternions w, x, y, z."""
    sizes: Array
    """(n,) 1 as described, less while it falls, 0 for what fell out of the world."""
    depths: Array
    """(n,) 0 on or above the lowest floor, 1 at the height at which a body is out."""
    shadows: Array
    """(n, 3) where the shadow lies."""
    shadow_sizes: Array
    """(n,) 0 where nothing catches the shadow."""


def poses(snapshot: Snapshot, layers: Layers) -> Poses:
    """Where all bodies of a snapshot are drawn."""
    bodies, static_scene = snapshot.bodies, snapshot.static_scene
    numbers = np.array([(b.x, b.y, b.z, b.heading, b.fallen) for b in bodies]).reshape(-1, 5)
    places, headings, gone = numbers[:, :3], numbers[:, 3] / 2, numbers[:, 4] > 0
    lowest = lowest_floor(static_scene)
    reach = max(lowest - static_scene.settings.fall_threshold, 0.1)
    depths = np.clip((lowest - places[:, 2]) / reach, 0.0, 1.0)
    sizes = np.where(gone, 0.0, 1 - (1 - SMALLEST) * depths)
    grounds = np.array([_ground(snapshot, body) for body in bodies])
    rise = np.maximum(places[:, 2] - grounds, 0.0)
    offset = (SHADOW_AT_REST + SHADOW_RISE * np.nan_to_num(rise))[:, None] * SHADOW
    none = np.zeros(len(bodies))
    return Poses(
        places=places + np.array([0, 0, layers.body]),
        turns=np.stack([np.cos(headings), none, none, np.sin(headings)], axis=1),
        sizes=sizes,
        depths=depths,
        shadows=np.column_stack([places[:, :2] + offset, np.nan_to_num(grounds) + layers.shadow]),
        shadow_sizes=np.where(np.isnan(grounds) | gone, 0.0, 1.0),
    )


def _ground(snapshot: Snapshot, body: BodyState) -> float:
    """The height at which a body's shadow falls; NaN over the void."""
    if body.on_ground:
        return body.z
    under = floor_under(snapshot.static_scene, body.x, body.y, body.z)
    return np.nan if under is None else under
