"""One body that holds another: two joints, which the space alone remembers."""

from typing import TYPE_CHECKING

import pymunk

from ai4u_edu.base.errors import WorldError

if TYPE_CHECKING:
    from ai4u_edu.world.body import BodyView
    from ai4u_edu.world.world import World


def hold(world: "World", holder: "BodyView", other: "BodyView") -> None:
    """Fixes a body to another, at the place and the angle that it has now.

    Raises:
        WorldError: the holder holds something already, or the other one can't be held.
    """
    what = f"body {holder.name!r} can't hold {other.name!r}"
    held = held_by(world, holder)
    if held is not None:
        raise WorldError(f"{what}: it holds {held.name!r}; release that first")
    if other is holder or not other.moves or other.fallen or holder.fallen:
        raise WorldError(f"{what}: expected another body, one that can move and has not fallen")
    a, b = holder._pm, other._pm
    joints = (
        pymunk.PivotJoint(a, b, b.position),
        pymunk.GearJoint(a, b, b.angle - a.angle, 1.0),
    )
    for joint in joints:
        joint.error_bias = world.space.collision_bias  # as firm as a wall
    world.space.add(*joints)


def held_by(world: "World", holder: "BodyView") -> "BodyView | None":
    """What a body holds."""
    for joint in world.space.constraints:
        if joint.a is holder._pm:
            return world.owners[next(iter(joint.b.shapes))]
    return None


def release(world: "World", holder: "BodyView") -> None:
    """Ends what a body holds."""
    _cut(world, [joint for joint in world.space.constraints if joint.a is holder._pm])


def detach(world: "World", body: "BodyView") -> None:
    """Ends what a body holds, and whatever holds it: it goes away, or somewhere else."""
    ends = [joint for joint in world.space.constraints if body._pm in (joint.a, joint.b)]
    _cut(world, ends)


def _cut(world: "World", joints: list[pymunk.Constraint]) -> None:
    if joints:
        world.space.remove(*joints)
