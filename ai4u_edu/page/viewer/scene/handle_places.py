"""Places and sizes of the handles of bodies, floors and areas."""

import math

import numpy as np

from ai4u_edu.page.viewer.scene.drags import Thing
from ai4u_edu.page.viewer.scene.geometry import Array
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.resize import outline_of
from ai4u_edu.snapshot import StaticScene
from ai4u_edu.world import AreaDescription, FloorDescription

Region = FloorDescription | AreaDescription


def extent(thing: Thing) -> tuple[Array, Array]:
    """Return the centre and the size of a rectangle around a thing, in its own frame."""
    outline = np.asarray(outline_of(thing.shape))
    low, high = outline.min(axis=0), outline.max(axis=0)
    return (low + high) / 2, high - low


def centre_at(
    centre: Array, x: float, y: float, heading: float, z: float
) -> tuple[float, float, float]:
    """Return the place in the world of a point in the frame of a thing at (x, y)."""
    along, across = centre
    cos, sin = math.cos(heading), math.sin(heading)
    return x + cos * along - sin * across, y + sin * along + cos * across, z


def surface_z(region: Region, static_scene: StaticScene) -> float:
    """Return the height of a floor's surface, or of the surface under an area."""
    if isinstance(region, FloorDescription):
        return region.top
    ground = static_scene.floor_under(*region.position)
    return static_scene.lowest_floor if ground is None else ground


def plate_z(region: Region, static_scene: StaticScene) -> float:
    """Return the height of the invisible plate by which a region is clicked.

    It lies below the surface, since an invisible plate above would hide translucent areas. Areas'
    plates lie above floors', so that areas can be clicked.
    """
    layers = Layers.of(static_scene)
    depth = layers.area_plate if isinstance(region, AreaDescription) else layers.floor_plate
    return surface_z(region, static_scene) + depth
