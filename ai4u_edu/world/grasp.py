"""Holding another body, by two joints of the space."""

from typing import TYPE_CHECKING

import pymunk

from ai4u_edu.base.errors import WorldError

if TYPE_CHECKING:
    from ai4u_edu.world.body import BodyView
    from ai4u_edu.world.physics import Physics


def hold(physics: "Physics", holder: "BodyView", other: "BodyView") -> None:
    """Fix a body to a holder at its present place and angle.

    Raises:
        WorldError: the holder holds a body already, or the other one can't be held.
    """
    what = f"body {holder.name!r} can't hold {other.name!r}"
    held = held_by(physics, holder)
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
        joint.error_bias = physics.space.collision_bias  # as stiff as a contact with a wall
    physics.space.add(*joints)


def held_by(physics: "Physics", holder: "BodyView") -> "BodyView | None":
    """Return the body that a body holds; None if it holds none."""
    for joint in physics.space.constraints:
        if joint.a is holder._pm:
            return physics.owners[next(iter(joint.b.shapes))]
    return None


def release(physics: "Physics", holder: "BodyView") -> None:
    """Release the body that a body holds."""
    _remove(physics, [joint for joint in physics.space.constraints if joint.a is holder._pm])


def detach(physics: "Physics", body: "BodyView") -> None:
    """Release what a body holds, and the body from whatever holds it."""
    ends = [joint for joint in physics.space.constraints if body._pm in (joint.a, joint.b)]
    _remove(physics, ends)


def _remove(physics: "Physics", joints: list[pymunk.Constraint]) -> None:
    if joints:
        physics.space.remove(*joints)
