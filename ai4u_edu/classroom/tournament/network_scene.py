"""Scenes for which networks can be handed in, and the parts that a network of each may drive."""

from dataclasses import dataclass
from functools import lru_cache

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks.brains import zoo
from ai4u_edu.blocks.brains.network import find_network
from ai4u_edu.games.tournament.drivers import scripted_agents
from ai4u_edu.games.tournament.entry import Driver, Entry, file_driver
from ai4u_edu.games.tournament.sides import Sides, sides_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

OWN_PLAYER = _("The scene's player")
"""Name of the entry that the scene itself brings along."""
ALL = ""
"""Part that means all agents of a side."""
MAX_ZOO_BYTES = 5 * 2**20


@dataclass(frozen=True)
class NetworkScene:
    """A scene of the library, as a tournament plays it."""

    name: str
    title: str
    sides: Sides
    parts: tuple[str, ...]
    """Parts for which students may hand in networks of their own, besides :data:`ALL`."""
    scripted: frozenset[str]
    """Ids of the agents that the scene's own controllers can drive."""

    def entry(self, name: str, networks: dict[str, Driver]) -> Entry:
        """Return an entry with some networks, by part.

        Agents without a network are driven by the scene's own controllers, or else at random.
        """
        drivers = dict(networks)
        if ALL not in drivers:
            for agent in (each for side in self.sides.agents for each in side):
                if not set(self.sides.parts_of(agent)) & networks.keys():
                    drivers[agent] = {"kind": "scene" if agent in self.scripted else "random"}
        return Entry(name=name, drivers=drivers)

    def own_player(self) -> Entry | None:
        """Return the entry that the scene brings along: a network of the zoo, or controllers."""
        if self.name in zoo.names():
            path = find_network(f"zoo:{self.name}")
            return Entry(
                name=OWN_PLAYER, drivers={ALL: file_driver("network", path, MAX_ZOO_BYTES)}
            )
        return self.entry(OWN_PLAYER, {}) if self.scripted else None


@lru_cache(maxsize=1)
def network_scenes() -> dict[str, NetworkScene]:
    """Return all scenes by name, by title; it takes a second at first, so a thread does it."""
    found = []
    for name in Scene.names():
        try:
            scene = Scene.load(name)
            sides = sides_of(scene)
        except AI4UError:  # a scene with more sides has no tournaments
            continue
        title = scene.description.title or name
        found.append(NetworkScene(name, title, sides, _parts(sides), scripted_agents(scene, sides)))
    return {each.name: each for each in sorted(found, key=lambda each: each.title.lower())}


def _parts(sides: Sides) -> tuple[str, ...]:
    """Return the roles of agents if both sides have the same ones, or sides that differ in size.

    >>> _parts(Sides(("a", "b"), (("a_x", "a_y"), ("b_x", "b_y"))))
    ('x', 'y')
    >>> _parts(Sides(("a", "b"), (("a",), ("b_1", "b_2"))))
    ('a', 'b')
    >>> _parts(Sides(("a", "b"), (("a",), ("b",))))
    ()
    """
    roles = [tuple(each.partition("_")[2] for each in side) for side in sides.agents]
    if all(each == roles[0] for each in roles):
        return roles[0] if len(roles[0]) > 1 and all(roles[0]) else ()
    return sides.names
