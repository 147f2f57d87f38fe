"""Whether two shapes are in each other, and whether a body stands in another one."""

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
            if level and overlap(shape, body._pm, hit, other._pm):
                return other
    return None


def overlap(
    shape: pymunk.Shape, pm: pymunk.Body, hit: pymunk.ShapeQueryInfo, other: pymunk.Body
) -> bool:
    """Whether a body's shape and another body's, which a query found there, are in each other."""
    # for some pairs of shapes the distance comes with the wrong sign, and as 0 for two that lie
    # exactly upon each other
    deepest = max(abs(point.distance) for point in hit.contact_point_set.points)
    return (
        deepest > OVERLAP
        or _depth(hit.shape, pm.local_to_world(shape.center_of_gravity)) > OVERLAP
        or _depth(shape, other.local_to_world(hit.shape.center_of_gravity)) > OVERLAP
    )


def _depth(shape: pymunk.Shape, place: tuple[float, float]) -> float:
    return -shape.point_query(place).distance
