"""Sampling of everything random, for an episode or for one thing that is added during it."""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ai4u_edu.world.descriptions import AreaDescription, FloorDescription
from ai4u_edu.world.placement import Places, Thing, ThingT

if TYPE_CHECKING:
    from ai4u_edu.world.world import World


def randomize(seed: int, things: Iterable[Thing]) -> dict[str, Thing]:
    """Return everything as sampled for an episode, by name.

    Args:
        seed: the episode's seed; the same seed gives the same result.
        things: everything in the world, in its order; without ``random`` a thing stays as it is.

    Raises:
        WorldError: there is no room for something.
    """
    places = Places(seed)
    return {thing.name: places.find(thing) for thing in sorted(things, key=_placing_order)}


def place_now(world: "World", thing: ThingT, seed: int | None = None) -> ThingT:
    """Return a thing as sampled now, at a free place among the others.

    Args:
        world: the world that it is added to, or put back in.
        thing: its description.
        seed: seed of the samples; by default the episode's.

    Raises:
        WorldError: there is no room for it.
    """
    if thing.random is None:
        return thing
    places = Places(world.seeds.seed if seed is None else seed)
    for floor in world.floors:
        places.occupy(floor)
    for other in world.bodies.values():
        if not other.fallen and other.name != thing.name:
            x, y, z, heading = other.pose
            now = {"position": (x, y), "z": z, "heading_deg": math.degrees(heading)}
            places.occupy(other.sampled.model_copy(update=now), _clearance(other.description))
    for name, area in world.areas.items():
        if isinstance(area.description, AreaDescription):
            places.occupy(area.description, _clearance(world._registry.described[name]))
    return places.find(thing)


def _clearance(described: Thing) -> float:
    return described.random.clearance if described.random else 0.0


def _placing_order(thing: Thing) -> int:
    """Return the rank of placing: floors first, then things with a fixed place."""
    if isinstance(thing, FloorDescription):
        return 0
    if isinstance(thing, AreaDescription):
        return 2
    return 1 if thing.random is None else 3
