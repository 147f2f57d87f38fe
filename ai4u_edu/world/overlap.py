"""Overlap of shapes, and of a body with the others of a world."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import pymunk

from ai4u_edu.world.native import IS_NATIVE, contact_distances

if TYPE_CHECKING:
    from ai4u_edu.world.body import BodyView
    from ai4u_edu.world.world import World

MAX_OVERLAP_M = 1e-3
"""Depth (metres) to which bodies may be put into each other: touching is no overlap."""


def find_overlap(world: "World", body: "BodyView") -> "BodyView | None":
    """Return a body that overlaps a given one, or None; two that can't move may overlap."""
    if not body.moves and IS_NATIVE:
        return _find_overlapping_mover(world, body)
    for shape in body._shapes:
        for hit in world.space.shape_query(shape):
            other = world.owners.get(hit.shape)
            if other is None or other is body or not (body.moves or other.moves):
                continue
            found = [point.distance for point in hit.contact_point_set.points]
            if _level(body, other) and is_overlap(shape, body._pm, hit.shape, other._pm, found):
                return other
    return None


def _find_overlapping_mover(world: "World", body: "BodyView") -> "BodyView | None":
    """Return a body that can move and overlaps a given one that can't.

    A query of the space would also return all bodies that can't move: with hundreds of overlapping
    walls, that took seconds (``python -m tests.benchmarks.many_walls``).
    """
    x, y = body.position
    for other in world._registry.bodies.values():
        if not other.moves or other is body or other.fallen:
            continue
        reach = body.sampled.shape.reach + other.sampled.shape.reach + MAX_OVERLAP_M
        if math.dist((x, y), other.position) > reach or not _level(body, other):
            continue
        for shape in body._shapes:
            for its in other._shapes:
                if _pass_through(shape.filter, its.filter):
                    continue
                found = contact_distances(shape, its, other._pm)
                if is_overlap(shape, body._pm, its, other._pm, found):
                    return other
    return None


def _level(body: "BodyView", other: "BodyView") -> bool:
    """Return True if neither of two bodies is above the other one."""
    return body.z < other.z + other.height and other.z < body.z + body.height


def _pass_through(one: pymunk.ShapeFilter, other: pymunk.ShapeFilter) -> bool:
    """Return True if the physics lets two shapes pass through each other."""
    return not (one.categories & other.mask and other.categories & one.mask)


def is_overlap(
    shape: pymunk.Shape,
    pm: pymunk.Body,
    other: pymunk.Shape,
    other_pm: pymunk.Body,
    found: Sequence[float],
) -> bool:
    """Return True if two shapes overlap by more than :data:`MAX_OVERLAP_M`.

    Args:
        shape: a shape.
        pm: its body.
        other: another shape.
        other_pm: its body.
        found: distances at pymunk's contact points of the two.
    """
    if not found:
        return False
    # for some pairs of shapes pymunk's distance has the wrong sign, and it is 0 for two shapes in
    # exactly the same place
    return (
        max(map(abs, found)) > MAX_OVERLAP_M
        or _depth(other, pm.local_to_world(shape.center_of_gravity)) > MAX_OVERLAP_M
        or _depth(shape, other_pm.local_to_world(other.center_of_gravity)) > MAX_OVERLAP_M
    )


def _depth(shape: pymunk.Shape, place: tuple[float, float]) -> float:
    return -shape.point_query(place).distance
