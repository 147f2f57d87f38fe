"""The edited state: a scene's description, and drivers that it does not contain."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.block import default_name
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.input_checks import check_name
from ai4u_edu.scenes import Scene, SceneDescription
from ai4u_edu.scenes.star_goals import StarGoals, library_star_goals

NO_DRIVERS: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True)
class EditState:
    """Everything that undo restores; immutable."""

    description: SceneDescription
    folder: Path | None = None
    """The folder to which paths in the description are relative."""
    drivers: Mapping[str, str] = field(default_factory=lambda: NO_DRIVERS)
    """Names of drivers in place of agents' own brains, by agent id; see :mod:`drivers`."""
    source: str = field(default="", compare=False, repr=False)
    """The text that the scene was read from; its comments are kept."""

    @property
    def scene(self) -> Scene:
        """The scene, to be saved or built."""
        return Scene(self.description, self.folder, self.source)

    @property
    def title(self) -> str:
        """The scene's title, or its name."""
        return self.description.title or self.description.name

    @cached_property
    def star_goals(self) -> StarGoals | None:
        """Goals for programs; None unless this is a scene of the library without changes."""
        return library_star_goals(self.description)

    @cached_property
    def task_key(self) -> str:
        """Key of all that makes times comparable."""
        return self.description.task_key()

    def agent_index(self, agent_id: str) -> int:
        """Return the index of an agent in the description."""
        check_name(agent_id, _("an agent's id"))
        ids = [str(agent.get("id", "0")) for agent in self.description.agents]
        if agent_id not in ids:
            raise NameNotFoundError(
                _("no agent has the id {id!r}; {hint}", id=agent_id, hint=suggest(agent_id, ids))
            )
        return ids.index(agent_id)

    def agent(self, agent_id: str) -> Mapping[str, Any]:
        """Return the parameters of an agent, blocks as mappings with a ``type``."""
        return self.description.agents[self.agent_index(agent_id)]

    def agent_with(self, body: str) -> str | None:
        """Return the id of the agent that a body belongs to; None if it belongs to none."""
        for agent in self.description.agents:
            if agent.get("body") == body:
                return str(agent.get("id", "0"))
        return None

    def with_agent(self, agent_id: str, agent: Mapping[str, Any]) -> "EditState":
        """Return a copy with other parameters of an agent.

        If the reward function that pays the scene's ``success`` term is renamed, ``success`` is
        renamed too; if it is removed, the scene has no ``success`` any more.
        """
        agents = list(self.description.agents)
        index = self.agent_index(agent_id)
        success = _success(self.description, index, agent)
        agents[index] = agent
        return self.describing(agents=tuple(agents), success=success)

    def describing(self, **fields: Any) -> "EditState":
        """Return a copy with other fields of the description."""
        return replace(self, description=self.description.model_copy(update=fields))

    def driven(self, agent_id: str, driver: str) -> "EditState":
        """Return a copy with another driver; an empty one for the agent's own brain."""
        drivers = {name: each for name, each in self.drivers.items() if name != agent_id}
        if driver:
            drivers[agent_id] = driver
        return replace(self, drivers=MappingProxyType(drivers))


def _success(before: SceneDescription, index: int, agent: Mapping[str, Any]) -> str | None:
    wanted = before.success
    had = [reward_names(each) for each in before.agents]
    have = reward_names(agent)
    others = {name for number, names in enumerate(had) if number != index for name in names}
    if wanted is None or wanted not in had[index] or wanted in others or wanted in have:
        return wanted
    if len(have) != len(had[index]):
        return None  # the function was removed
    return have[had[index].index(wanted)]


def reward_names(agent: Mapping[str, Any]) -> list[str]:
    """Return the names of an agent's reward functions."""
    endings = ("RewardFunc", "Reward", "Func")
    return [
        str(each.get("name") or default_name(Block.types[str(each["type"])], *endings))
        for each in agent.get("rewards", ())
    ]
