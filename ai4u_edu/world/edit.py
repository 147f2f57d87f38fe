"""Changes in a world that is under way: what is new comes in, all else stays where it is."""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ai4u_edu.base.errors import WorldError
from ai4u_edu.world.descriptions import BodyDescription
from ai4u_edu.world.overlap import in_the_way

if TYPE_CHECKING:
    from ai4u_edu.world.body import Body
    from ai4u_edu.world.world import World

Pose = tuple[float, float, float]
"""x, y (metres), heading (radians)."""


def insert_body(world: "World", description: BodyDescription) -> "Body":
    """Adds a body where it is free now; nothing else is put back, however young the episode is.

    Raises:
        WorldError: its name or its place is taken, or the world is full.
    """
    world._add_now(description)
    return world[description.name]


def edit_body(world: "World", description: BodyDescription, pose: Pose | None = None) -> "Body":
    """Makes another body of the one that has this name; whoever knows it knows the new one.

    Nobody holds it or touches it then.

    Args:
        world: where it is.
        description: how it is from now on, in later episodes too.
        pose: where it is put, at rest, on the highest floor there (or at the described height);
            left out: it stays where it is, as fast as it is.

    Raises:
        WorldError: it would overlap another body; then all stays as it was.
    """
    body = world[description.name]
    before, drawn = body.description, body.sampled
    place, speed, z = body.pose, (body.velocity, body.angular_velocity, body.vz), body.z
    fallen = body.fallen
    x, y, heading = pose or (place[0], place[1], place[3])
    shape = description.shape.scaled(drawn.shape.reach / before.shape.reach)
    here = {"shape": shape, "position": (x, y), "heading_deg": math.degrees(heading)}
    _remake(world, body, description, description.model_copy(update=here))
    if pose is not None:
        world._height.settle(body, description.z)
        world._height.rest(body)
        taken = in_the_way(world, body)
    else:
        taken = None if fallen else in_the_way(world, body)
        _go_on(world, body, speed, z, fallen=fallen)
    if taken is not None:
        then = drawn.model_copy(
            update={"position": place[:2], "heading_deg": math.degrees(place[3])}
        )
        _remake(world, body, before, then)
        body.sampled = drawn
        _go_on(world, body, speed, z, fallen=fallen)
        raise WorldError(
            f"body {body.name!r}: at ({x:.2f}, {y:.2f}) it would overlap body {taken.name!r}; "
            "choose another place, or move that one first",
            thing=body.name,
        )
    return body


def reorder(world: "World", names: Iterable[str]) -> None:
    """Puts all things into this order; the physics is built in it from the next reset on."""
    order = {name: index for index, name in enumerate(names)}
    for things in (world._described, world._bodies, world._floors, world._areas):
        in_order = sorted(things.items(), key=lambda item: order.get(item[0], len(order)))
        things.clear()
        things.update(in_order)  # type: ignore[arg-type]  # each keeps its own kind of thing
    world.generation += 1


def _remake(
    world: "World", body: "Body", description: BodyDescription, drawn: BodyDescription
) -> None:
    world._remove_parts(body)
    body.description, body.sampled = description, drawn
    body.tags, body.height = description.tags, description.height
    world._described[body.name] = description
    world._has_random = any(thing.random for thing in world._described.values())
    world._embody(body)


def _go_on(
    world: "World",
    body: "Body",
    speed: tuple[tuple[float, float], float, float],
    z: float,
    *,
    fallen: bool,
) -> None:
    """As high and as fast as it was before."""
    world._height.settle(body, z)
    if fallen:
        world._drop(body)
        return
    if body.description.kind != "static":
        body.set_velocity(*speed[0])
        body.set_angular_velocity(speed[1])
    world._height.rest(body)
    if not body.on_ground:
        body.vz = speed[2]
