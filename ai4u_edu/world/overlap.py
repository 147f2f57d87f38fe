"""Whether two shapes are in each other, and whether a body stands in another one."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import pymunk

if TYPE_CHECKING:
    from ai4u_edu.world.body import BodyView
    from ai4u_edu.world.world import World

OVERLAP = 1e-3
"""Bodies may be put this far into each other (metres): touching is no overlap."""


def in_the_way(world: "World", body: "BodyView") -> "BodyView | None":
    """The body that another one overlaps, if there is one; what can't move may overlap."""
    for shape in body._shapes:
        for hit in world.space.shape_query(shape):
            other = world.owners.get(hit.shape)
            if other is None or other is body or not (body.moves or other.moves):
                continue
            level = body.z < other.z + other.height and other.z < body.z + body.height
            found = [point.distance for point in hit.contact_point_set.points]
            if level and overlap(shape, body._pm, hit.shape, other._pm, found):
                return other
    return None


def overlap(
    shape: pymunk.Shape,
    pm: pymunk.Body,
    other: pymunk.Shape,
    its_pm: pymunk.Body,
    found: Sequence[float],
) -> bool:
    """Whether two shapes are in each other.

    Args:
        shape: of one body.
        pm: that body.
        other: of another body.
        its_pm: the other body.
        found: the distances at the points where pymunk says that the two touch.
    """
    if not found:
        return False
    # for some pairs of shapes the distance comes with the wrong sign, and as 0 for two that lie
    # exactly upon each other
    return (
        max(map(abs, found)) > OVERLAP
        or _depth(other, pm.local_to_world(shape.center_of_gravity)) > OVERLAP
        or _depth(shape, its_pm.local_to_world(other.center_of_gravity)) > OVERLAP
    )


def _depth(shape: pymunk.Shape, place: tuple[float, float]) -> float:
    return -shape.point_query(place).distance
