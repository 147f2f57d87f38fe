"""What there is in a scene for blocks to refer to, by name."""

from collections.abc import Mapping
from functools import cached_property
from typing import Any

from ai4u_edu.blocks import Block
from ai4u_edu.editing.state import EditState


class SceneNames:
    """The names in a scene, as one of its agents may use them.

    Args:
        state: the scene.
        agent_id: the agent.
    """

    def __init__(self, state: EditState, agent_id: str) -> None:
        self._description = state.description
        self.agent = state.agent(agent_id)

    @cached_property
    def bodies(self) -> tuple[str, ...]:
        """All bodies but the agent's own, targets first."""
        others = [body for body in self._description.bodies if body.name != self.agent.get("body")]
        others.sort(key=lambda body: "target" not in body.tags)
        return tuple(body.name for body in others)

    @property
    def areas(self) -> tuple[str, ...]:
        """All areas."""
        return tuple(area.name for area in self._description.areas)

    @property
    def things(self) -> tuple[str, ...]:
        """All that can be a target."""
        return (*self.bodies, *self.areas)

    @property
    def tags(self) -> tuple[str, ...]:
        """The tags of all bodies, that of targets first."""
        tags = dict.fromkeys(tag for body in self._description.bodies for tag in body.tags)
        return tuple(sorted(tags, key=lambda tag: tag != "target"))

    @property
    def area_tags(self) -> tuple[str, ...]:
        """The tags of all areas."""
        return tuple(dict.fromkeys(tag for area in self._description.areas for tag in area.tags))

    def of_blocks(self, kind: str, parameter: str, only: str = "") -> tuple[str, ...]:
        """What the agent's blocks are called.

        Args:
            kind: ``sensors``, ``actuators`` or ``rewards``.
            parameter: in which they have their name.
            only: the type of those that are meant.
        """
        blocks = [each for each in self.agent.get(kind, ()) if only in ("", each["type"])]
        return tuple(dict.fromkeys(name_of(each, parameter) for each in blocks))

    def fitting(self, parameter: str) -> tuple[str, ...] | None:
        """What may stand in a parameter of that name; None where it is no name from the scene."""
        match parameter:
            case "target":
                return self.things
            case "thing" | "reference":
                return self.bodies
            case "area":
                return self.areas
            case "group" | "target_group":
                return (*self.tags, *self.area_tags)
            case "actuator_name" | "main_output":
                return self.of_blocks("actuators", "action_name")
            case "source":
                return self.of_blocks("rewards", "name", "HomeostaticReward")
        return None


def name_of(block: Mapping[str, Any], parameter: str) -> str:
    """What a block is called: as it says, or as its kind is called by default."""
    given = block.get(parameter)
    if given:
        return str(given)
    cls = Block.types[str(block["type"])]
    default = cls.parameters()[parameter].get_default() if parameter in cls.parameters() else ""
    return str(default or _by_itself(cls))


def _by_itself(cls: type[Block]) -> str:
    from ai4u_edu.blocks.block import default_name

    return default_name(cls, "Sensor", "Actuator", "RewardFunc", "Reward", "Func")
