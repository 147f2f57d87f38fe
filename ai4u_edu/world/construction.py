"""Adding things to a world, removing them, and building the world for an episode."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ai4u_edu.base.errors import WorldError
from ai4u_edu.world.body import Body
from ai4u_edu.world.descriptions import BodyDescription, FloorDescription
from ai4u_edu.world.overlap import find_overlap
from ai4u_edu.world.placement import Thing
from ai4u_edu.world.randomize import place_now, randomize

if TYPE_CHECKING:
    from ai4u_edu.world.world import World


def add_all(world: "World", things: Iterable[Thing]) -> None:
    """Add bodies, floors and areas, in this order.

    Before the first tick everything random is sampled together, so that the world is the one that
    a reset to its seed gives. Later, only the new things are sampled.

    Raises:
        WorldError: a name or a place is taken, or the world is full.
    """
    things = list(things)
    if world.ticks == 0 and (world._registry.has_random or any(each.random for each in things)):
        _add_and_rebuild(world, things)
        return
    for each in things:
        add_now(world, each)


def add_now(world: "World", thing: Thing) -> None:
    """Add one thing; everything else stays where it is now.

    Raises:
        WorldError: its name or its place is taken, or the world is full.
    """
    registry = world._registry
    registry.check_name(thing)
    if isinstance(thing, BodyDescription):
        _add_body(world, thing, place_now(world, thing))
    else:
        registry.put_region(place_now(world, thing))
        if isinstance(thing, FloorDescription):
            update_heights(world)
        world._physics.generation += 1
    registry.register(thing)


def remove(world: "World", name: str) -> None:
    """Remove a body for good.

    Raises:
        NameNotFoundError: no body has that name.
    """
    world._physics.remove(world[name])
    world._registry.forget(name)


def put_back(world: "World", name: str) -> None:
    """Put a body back to its described place; its random values are sampled anew.

    Raises:
        WorldError: there is no room for it; then nothing changes.
    """
    body, physics = world[name], world._physics
    rng = world.seeds.child(f"put back/{name}")
    body.sampled = place_now(world, body.description, int(rng.integers(2**63)))
    physics.remove(body)
    physics.add(body)
    physics.height.set_height(body, body.sampled.z)
    physics.height.update_support(body)


def rebuild(world: "World") -> None:
    """Build the physics anew, with all bodies in their places of this episode.

    Raises:
        WorldError: there is no room for something random; then nothing changes.
    """
    registry = world._registry
    if registry.has_random:
        _sample_all(world)
    world.ticks = 0
    world._physics.start_over()
    for body in registry.bodies.values():
        if not registry.has_random:
            body.sampled = body.description  # an edit may have changed it in its place
        world._physics.add(body)
    update_heights(world)


def _add_and_rebuild(world: "World", things: list[Thing]) -> None:
    """Add things before the first tick, and find places for everything random."""
    registry, added = world._registry, []
    try:
        for thing in things:
            registry.check_name(thing)
            added.append(thing.name)
            if isinstance(thing, BodyDescription):
                registry.bodies[thing.name] = Body(world, thing)
            registry.register(thing)
        rebuild(world)
        for name in added:
            if name in registry.bodies:
                _check_place(world, registry.bodies[name])
    except WorldError:
        for name in added:
            registry.forget(name)
        rebuild(world)
        raise


def _add_body(world: "World", description: BodyDescription, sampled: BodyDescription) -> None:
    body, physics = Body(world, description), world._physics
    body.sampled = sampled
    physics.add(body)
    physics.height.set_height(body, sampled.z)
    try:
        _check_place(world, body)
    except WorldError:
        physics.remove(body)
        raise
    world._registry.bodies[body.name] = body
    physics.height.update_support(body)


def _sample_all(world: "World") -> None:
    """Sample everything random for this episode."""
    registry = world._registry
    for thing in randomize(world.seeds.seed, registry.described.values()).values():
        if isinstance(thing, BodyDescription):
            registry.bodies[thing.name].sampled = thing
        else:
            registry.put_region(thing)
    world._physics.generation += 1


def update_heights(world: "World") -> None:
    """Find out what every body stands on, after the floors have changed."""
    height = world._physics.height
    height.rebuild(world._registry.floors.values())
    bodies = [body for body in world.bodies.values() if not body.fallen]
    if world.ticks == 0:  # later, a new floor lifts no body
        for body in bodies:
            height.set_height(body, body.description.z)
    for body in bodies:
        height.update_support(body)


def _check_place(world: "World", body: Body) -> None:
    """Raise a WorldError if a body overlaps another one."""
    other = find_overlap(world, body)
    if other is not None:
        raise WorldError(
            f"body {body.name!r}: its place {body.sampled.position} overlaps body "
            f"{other.name!r} at {other.sampled.position}; move one of them",
            thing=body.name,
        )
