"""What every block has: declared parameters, a name, a setup and a reset."""

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
    """Every kind of block there is, by the name of its class; scene files name them so."""

    abstract: ClassVar[bool] = False
    """Whether a class is only the base of others; said in its own body."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        Block.types[cls.__name__] = cls

    def inner_blocks(self) -> "Sequence[Block]":
        """Return the blocks inside this one that it sets up and resets itself; most have none."""
        return ()

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Called when the agent is set up: check targets here, prepare what is costly."""

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Called at every reset, before the first reading of the episode."""


def levels_up(cls: type, name: str) -> int:
    """Return how many classes one has to go up until one defines a name; all, if none does."""
    order = cls.__mro__
    return next((up for up, each in enumerate(order) if name in vars(each)), len(order))


def is_built_in(cls: type[Block]) -> bool:
    """Whether a class is one of this package's own, not one that was made somewhere else."""
    module = sys.modules.get(cls.__module__)
    own = cls.__module__.startswith("ai4u_edu.")
    return own and getattr(module, cls.__name__, None) is cls


def default_name(cls: type[Block], *endings: str) -> str:
    """A name from a class: ``RayCastingSensor`` -> ``ray_casting``."""
    name = cls.__name__
    for ending in endings:
        if name != ending:
            name = name.removesuffix(ending)
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()
