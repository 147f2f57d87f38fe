"""Edits of a world during an episode; everything else stays where it is."""

import math
from collections.abc import Iterable
from typing import cast

from ai4u_edu.base.errors import WorldError
from ai4u_edu.locale import gettext as _
from ai4u_edu.world.body import Body
from ai4u_edu.world.descriptions import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    WorldSettings,
)
from ai4u_edu.world.fields import AnyField
from ai4u_edu.world.world import World

Pose = tuple[float, float, float]
"""x, y (metres), heading (radians)."""


def insert_body(world: World, description: BodyDescription) -> Body:
    """Add a body at a free place; unlike ``World.add``, never sample or reset anything else.

    Raises:
        WorldError: its name or its place is blocker, or the world is full.
    """
    world._add_now(description)
    return world[description.name]


def edit_body(world: World, description: BodyDescription, pose: Pose | None = None) -> Body:
    """Give the body of a name another description; references to it stay valid.

    It is not held and touches nothing then.

    Args:
        world: the world to change.
        description: of this and all later episodes.
        pose: new place, at rest, on the highest floor there or at the described height; by
            default the body keeps its place and its speed.

    Raises:
        WorldError: the body would overlap another one; then nothing changes.
    """
    body, height = world[description.name], world._physics.height
    before, drawn = body.description, body.sampled
    place, speed, z = body.pose, (body.velocity, body.angular_velocity, body.vz), body.z
    fallen = body.fallen
    x, y, heading = pose or (place[0], place[1], place[3])
    shape = description.shape.scaled(drawn.shape.reach / before.shape.reach)
    here = {"shape": shape, "position": (x, y), "heading_deg": math.degrees(heading)}
    _replace_body(world, body, description, description.model_copy(update=here))
    if pose is not None:
        height.set_height(body, description.z)
        height.update_support(body)
        blocker = world.find_overlap(body)
    else:
        blocker = None if fallen else world.find_overlap(body)
        _restore_motion(world, body, speed, z, fallen=fallen)
    if blocker is not None:
        then = drawn.model_copy(
            update={"position": place[:2], "heading_deg": math.degrees(place[3])}
        )
        _replace_body(world, body, before, then)
        body.sampled = drawn
        _restore_motion(world, body, speed, z, fallen=fallen)
        raise WorldError(
            _(
                "body {name!r}: at ({x:.2f}, {y:.2f}) it would overlap body {name2!r}; choose "
                "another place, or move that one first",
                name=body.name,
                x=x,
                y=y,
                name2=blocker.name,
            ),
            thing=body.name,
        )
    return body


def sampled_region(world: World, name: str) -> FloorDescription | AreaDescription:
    """Return a floor or an area as sampled for this episode."""
    registry = world._registry
    sampled = registry.floors[name][0] if name in registry.floors else None
    if sampled is not None:
        return sampled
    return cast(AreaDescription, registry.areas[name].description)


def put_region(
    world: World,
    name: str,
    description: FloorDescription | AreaDescription | None,
    sampled: FloorDescription | AreaDescription | None,
) -> None:
    """Add, change or remove a floor or an area; no body is lifted, and some may fall.

    Args:
        world: the world to change.
        name: of the floor or the area.
        description: of this and all later episodes; None removes it.
        sampled: the floor or the area of this episode.

    Raises:
        WorldError: the name of a new one is taken.
    """
    registry = world._registry
    is_floor = name in registry.floors or isinstance(description, FloorDescription)
    if description is None or sampled is None:
        registry.forget(name)
    else:
        if name not in registry.floors and name not in registry.areas:
            registry.check_name(description)
        registry.replace(description)
        registry.put_region(sampled)
    if is_floor:
        world._update_heights()
    world._physics.generation += 1


def redescribe(
    world: World,
    things: Iterable[BodyDescription | FloorDescription | AreaDescription],
    settings: WorldSettings,
    field: AnyField | None,
) -> None:
    """Give things, and the world, other descriptions, which count from the next reset on.

    Args:
        world: the world to change.
        things: new descriptions; each of them has the name of one of that kind in the world.
        settings: of the world; the length of a tick stays.
        field: that is generated at each reset; None for none.
    """
    for thing in things:
        world._registry.replace(thing)
        if isinstance(thing, BodyDescription):
            body = world[thing.name]
            body.description, body.tags, body.height = thing, thing.tags, thing.height
        else:
            world._registry.put_region(thing)
    world.settings = world._physics.settings = settings
    world._registry.set_field(field)


def reorder(world: World, names: Iterable[str]) -> None:
    """Put all things into this order; from the next reset on, the physics is built in it."""
    world._registry.reorder(names)
    world._physics.generation += 1


def _replace_body(
    world: World, body: Body, description: BodyDescription, drawn: BodyDescription
) -> None:
    world._physics.remove(body)
    body.description, body.sampled = description, drawn
    body.tags, body.height = description.tags, description.height
    world._registry.replace(description)
    world._physics.add(body)


def _restore_motion(
    world: World,
    body: Body,
    speed: tuple[tuple[float, float], float, float],
    z: float,
    *,
    fallen: bool,
) -> None:
    """Give a body its former height and speed."""
    physics = world._physics
    physics.height.set_height(body, z)
    if fallen:
        physics.drop(body)
        return
    if body.description.kind != "static":
        body.set_velocity(*speed[0])
        body.set_angular_velocity(speed[1])
    physics.height.update_support(body)
    if not body.on_ground:
        body.vz = speed[2]
