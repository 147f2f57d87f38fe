"""Whether two shapes are in each other, and whether a body stands in another one."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import pymunk

from ai4u_edu.world.native import IS_NATIVE, contact_distances

if TYPE_CHECKING:
    from ai4u_edu.world.body import BodyView
    from ai4u_edu.world.world import World

OVERLAP = 1e-3
"""Bodies may be put this far into each other (metres): touching is no overlap."""


def in_the_way(world: "World", body: "BodyView") -> "BodyView | None":
    """The body that another one overlaps, if there is one; what can't move may overlap."""
    if not body.moves and IS_NATIVE:
        return _mover_in_the_way(world, body)
    for shape in body._shapes:
        for hit in world.space.shape_query(shape):
            other = world.owners.get(hit.shape)
            if other is None or other is body or not (body.moves or other.moves):
                continue
            found = [point.distance for point in hit.contact_point_set.points]
            if _level(body, other) and overlap(shape, body._pm, hit.shape, other._pm, found):
                return other
    return None


def _mover_in_the_way(world: "World", body: "BodyView") -> "BodyView | None":
    """The body that can move, and that one overlaps which can't.

    A query of the space would answer with all that can't move either: with hundreds of walls upon
    each other, that took seconds (``python -m tests.benchmarks.many_walls``).
    """
    x, y = body.position
    for other in world._bodies.values():
        if not other.moves or other is body or other.fallen:
            continue
        reach = body.sampled.shape.reach + other.sampled.shape.reach + OVERLAP
        if math.dist((x, y), other.position) > reach or not _level(body, other):
            continue
        for shape in body._shapes:
            for its in other._shapes:
                if _pass_through(shape.filter, its.filter):
                    continue
                found = contact_distances(shape, its, other._pm)
                if overlap(shape, body._pm, its, other._pm, found):
                    return other
    return None


def _level(body: "BodyView", other: "BodyView") -> bool:
    """Return True if neither of two bodies is above the other one."""
    return body.z < other.z + other.height and other.z < body.z + body.height


def _pass_through(one: pymunk.ShapeFilter, other: pymunk.ShapeFilter) -> bool:
    """Return True if the physics lets two shapes pass through each other."""
    return not (one.categories & other.mask and other.categories & one.mask)


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
