"""Names in a scene that a block's parameters can refer to."""

from collections.abc import Mapping
from functools import cached_property
from typing import Any

from ai4u_edu.base.parameters import default_of
from ai4u_edu.blocks import Block
from ai4u_edu.page.editing.state import EditState


class SceneNames:
    """Names that one agent's blocks can use.

    Args:
        state: has the scene.
        agent_id: the agent.
    """

    def __init__(self, state: EditState, agent_id: str) -> None:
        self._description = state.description
        self.agent = state.agent(agent_id)

    @cached_property
    def bodies(self) -> tuple[str, ...]:
        """Names of all bodies but the agent's own, targets first."""
        others = [body for body in self._description.bodies if body.name != self.agent.get("body")]
        others.sort(key=lambda body: "target" not in body.tags)
        return tuple(body.name for body in others)

    @property
    def areas(self) -> tuple[str, ...]:
        """Names of all areas."""
        return tuple(area.name for area in self._description.areas)

    @property
    def things(self) -> tuple[str, ...]:
        """Names of everything that can be a target."""
        return (*self.bodies, *self.areas)

    @property
    def tags(self) -> tuple[str, ...]:
        """Tags of all bodies, ``target`` first."""
        tags = dict.fromkeys(tag for body in self._description.bodies for tag in body.tags)
        return tuple(sorted(tags, key=lambda tag: tag != "target"))

    @property
    def area_tags(self) -> tuple[str, ...]:
        """Tags of all areas."""
        return tuple(dict.fromkeys(tag for area in self._description.areas for tag in area.tags))

    def of_blocks(self, kind: str, parameter: str, only: str = "") -> tuple[str, ...]:
        """Return the names of the agent's blocks.

        Args:
            kind: ``sensors``, ``actuators`` or ``rewards``.
            parameter: the parameter that holds a block's name.
            only: a type, to return the names of these blocks only.
        """
        blocks = [each for each in self.agent.get(kind, ()) if only in ("", each["type"])]
        return tuple(dict.fromkeys(name_of(each, parameter) for each in blocks))

    def fitting(self, parameter: str) -> tuple[str, ...] | None:
        """Return the values that a parameter can have; None if it does not name anything."""
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
    """Return a block's name: the given one, or the default of its type."""
    given = block.get(parameter)
    if given:
        return str(given)
    cls = Block.types[str(block["type"])]
    default = default_of(cls.parameters()[parameter]) if parameter in cls.parameters() else ""
    return str(default or _default_name(cls))


def _default_name(cls: type[Block]) -> str:
    from ai4u_edu.blocks.block import default_name

    return default_name(cls, "Sensor", "Actuator", "RewardFunc", "Reward", "Func")
