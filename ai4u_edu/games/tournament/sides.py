"""Sides of a scene: the agents that one entry drives."""

from dataclasses import dataclass

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene


@dataclass(frozen=True)
class Sides:
    """Agents of a scene by side: agents whose ids begin with the same word before ``_``."""

    names: tuple[str, ...]
    agents: tuple[tuple[str, ...], ...]
    """Ids of the agents of each side."""

    @property
    def is_race(self) -> bool:
        """True if there is one side: entries drive alone, on the same seeds."""
        return len(self.names) == 1

    def parts_of(self, agent_id: str) -> tuple[str, ...]:
        """Return the names by which an entry may mean an agent: its id, its role, its side."""
        side, _, role = agent_id.partition("_")
        return tuple(filter(None, (agent_id, role, side)))

    @property
    def parts(self) -> tuple[str, ...]:
        """All names by which an entry may mean agents."""
        ids = (each for side in self.agents for each in side)
        return tuple(dict.fromkeys(part for each in ids for part in self.parts_of(each)))

    def counterpart(self, agent_id: str) -> str:
        """Return the agent of the other side in the same place; empty in a race."""
        if self.is_race:
            return ""
        own = 0 if agent_id in self.agents[0] else 1
        here, there = self.agents[own], self.agents[1 - own]
        place = here.index(agent_id)
        return there[place] if len(here) == len(there) else ""


def sides_of(scene: Scene) -> Sides:
    """Return the sides of a scene.

    Raises:
        SetupError: there are more than two.

    >>> sides_of(Scene.load("soccer")).agents
    (('blue_striker', 'blue_keeper'), ('orange_striker', 'orange_keeper'))
    >>> sides_of(Scene.load("tag")).names
    ('chaser', 'runner')
    """
    found: dict[str, list[str]] = {}
    for agent in scene.description.agents:
        name = str(agent.get("id", "0"))
        found.setdefault(name.partition("_")[0], []).append(name)
    if len(found) > 2:
        raise SetupError(
            _(
                "{name}: expected one side or two, got {found}; agents of one side have ids "
                "that begin with the same word before _, such as blue_keeper",
                name=scene.description.name,
                found=", ".join(found),
            )
        )
    return Sides(tuple(found), tuple(map(tuple, found.values())))
