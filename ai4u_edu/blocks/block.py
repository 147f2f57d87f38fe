"""The base of all blocks: declared parameters, setup and reset."""

import re
import sys
from collections.abc import Sequence
from typing import Any, ClassVar

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.world import WorldView


class Block(Parameterized):
    """The base of sensors, actuators, reward functions, brains and controllers."""

    types: ClassVar[dict[str, type["Block"]]] = {}
    """All classes of blocks by name, as in scene files."""

    abstract: ClassVar[bool] = False
    """True for a class that is only a base of others; it applies to the class that sets it."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        Block.types[cls.__name__] = cls

    def inner_blocks(self) -> "Sequence[Block]":
        """Return the blocks inside this one, which it sets up and resets; most have none."""
        return ()

    def fixed_at_setup(self) -> dict[str, object]:
        """Return attributes that count at setup only, by name; the next reset refuses others."""
        return {}

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Prepare, when the agent is set up: check targets and compute what is costly here."""

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Prepare for an episode, at every reset before its first reading."""


def levels_up(cls: type, name: str) -> int:
    """Return the index in the MRO of the class that defines a name; the MRO's length if none."""
    order = cls.__mro__
    return next((up for up, each in enumerate(order) if name in vars(each)), len(order))


def is_built_in(cls: type[Block]) -> bool:
    """Return True for a class that a module of this package defines, except for a lesson."""
    place, module = cls.__module__, sys.modules.get(cls.__module__)
    is_ours = place.startswith("ai4u_edu.") and not place.startswith("ai4u_edu.lessons.")
    return is_ours and getattr(module, cls.__name__, None) is cls


def default_name(cls: type[Block], *endings: str) -> str:
    """Derive a name from a class: ``RayCastingSensor`` -> ``ray_casting``."""
    name = cls.__name__
    for ending in endings:
        if name != ending:
            name = name.removesuffix(ending)
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()
