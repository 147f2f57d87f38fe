"""Everything where chance puts it, for an episode or for something that comes late."""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ai4u_edu.world.descriptions import AreaDescription, FloorDescription
from ai4u_edu.world.placement import Places, Some, Thing

if TYPE_CHECKING:
    from ai4u_edu.world.world import World


def randomize(seed: int, things: Iterable[Thing]) -> dict[str, Thing]:
    """Everything as it is in one episode, by name; a thing without a ``random`` is as described.

    Args:
        seed: of the episode; with it all is the same, however often the world is built.
        things: all that is in the world, in its order.

    Raises:
        WorldError: there is no room for something.
    """
    places = Places(seed)
    return {thing.name: places.find(thing) for thing in sorted(things, key=_turn)}


def place_now(world: "World", thing: Some, seed: int | None = None) -> Some:
    """Something that comes late, or again; what is random in it finds a place among the rest.

    Args:
        world: where it comes in.
        thing: as described.
        seed: of what is drawn; left out, the episode's.

    Raises:
        WorldError: there is no room for it.
    """
    if thing.random is None:
        return thing
    places = Places(world.seeds.seed if seed is None else seed)
    for floor in world.floors:
        places.take(floor)
    for other in world.bodies.values():
        if not other.fallen and other.name != thing.name:
            x, y, z, heading = other.pose
            now = {"position": (x, y), "z": z, "heading_deg": math.degrees(heading)}
            places.take(other.sampled.model_copy(update=now), _clearance(other.description))
    for name, area in world.areas.items():
        if isinstance(area.description, AreaDescription):
            places.take(area.description, _clearance(world._described[name]))
    return places.find(thing)


def _clearance(described: Thing) -> float:
    return described.random.clearance if described.random else 0.0


def _turn(thing: Thing) -> int:
    """Who is put in place first: what others stand on, then what can't give way."""
    if isinstance(thing, FloorDescription):
        return 0
    if isinstance(thing, AreaDescription):
        return 2
    return 1 if thing.random is None else 3
