"""What a person changes: a scene's description, and who drives besides what it says."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.block import default_name
from ai4u_edu.editing.typed import check_name
from ai4u_edu.scenes import Scene, SceneDescription

NOBODY: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True)
class EditState:
    """Everything that undo takes back; never changed, only replaced."""

    description: SceneDescription
    folder: Path | None = None
    """Where paths in the description begin."""
    drivers: Mapping[str, str] = field(default_factory=lambda: NOBODY)
    """Who drives in place of an agent's own brain, by its id; see :mod:`drivers`."""
    source: str = field(default="", compare=False, repr=False)
    """The text that the scene was read from, for its comments."""

    @property
    def scene(self) -> Scene:
        """As a scene, to be saved or built."""
        return Scene(self.description, self.folder, self.source)

    @property
    def title(self) -> str:
        """What the scene is called."""
        return self.description.title or self.description.name

    def agent_index(self, agent_id: str) -> int:
        """Where the agent of that id stands in the description."""
        check_name(agent_id, "an agent's id")
        ids = [str(agent.get("id", "0")) for agent in self.description.agents]
        if agent_id not in ids:
            raise NameNotFoundError(f"no agent has the id {agent_id!r}; {suggest(agent_id, ids)}")
        return ids.index(agent_id)

    def agent(self, agent_id: str) -> Mapping[str, Any]:
        """The parameters of an agent, blocks as mappings with a ``type``."""
        return self.description.agents[self.agent_index(agent_id)]

    def with_agent(self, agent_id: str, agent: Mapping[str, Any]) -> "EditState":
        """The same with other parameters of an agent.

        Where the reward function that pays the scene's success gets another name, the success has
        that one too; where it is taken away, the scene has none.
        """
        agents = list(self.description.agents)
        index = self.agent_index(agent_id)
        success = _success(self.description, index, agent)
        agents[index] = agent
        return self.describing(agents=tuple(agents), success=success)

    def describing(self, **fields: Any) -> "EditState":
        """The same with other fields of the description."""
        return replace(self, description=self.description.model_copy(update=fields))

    def driven(self, agent_id: str, driver: str) -> "EditState":
        """The same with another driver; an empty one for the agent's own brain."""
        drivers = {name: each for name, each in self.drivers.items() if name != agent_id}
        if driver:
            drivers[agent_id] = driver
        return replace(self, drivers=MappingProxyType(drivers))


def _success(before: SceneDescription, index: int, agent: Mapping[str, Any]) -> str | None:
    wanted = before.success
    had = [_terms(each) for each in before.agents]
    have = _terms(agent)
    others = {name for number, names in enumerate(had) if number != index for name in names}
    if wanted is None or wanted not in had[index] or wanted in others or wanted in have:
        return wanted
    if len(have) != len(had[index]):
        return None  # it was taken away
    return have[had[index].index(wanted)]


def _terms(agent: Mapping[str, Any]) -> list[str]:
    """The names of an agent's reward functions."""
    endings = ("RewardFunc", "Reward", "Func")
    return [
        str(each.get("name") or default_name(Block.types[str(each["type"])], *endings))
        for each in agent.get("rewards", ())
    ]
