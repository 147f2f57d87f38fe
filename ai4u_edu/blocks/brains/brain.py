"""The base class of brains, and their answers: actions and commands."""

from collections.abc import Mapping
from enum import StrEnum
from typing import Annotated, Any

from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.block import Block
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.locale import gettext as _

__all__ = ["Action", "Brain", "Command"]


class Command(StrEnum):
    """An answer that is not an action."""

    RESTART = "restart"
    """Begin a new episode, for the world and all its agents."""
    RESPAWN = "respawn"
    """Begin a new episode for this agent alone; the world and the others go on."""
    PAUSE = "pause"
    """Take no more decisions until resume."""
    RESUME = "resume"
    """Go on."""
    STOP = "stop"
    """Take no more decisions until the next reset."""
    WAIT = "wait"
    """No answer yet: ask again at the next tick."""
    HOLD = "hold"
    """No answer yet, and the world waits for it: ask again before the next tick."""


Action = Mapping[str, Any]
"""Numbers by the actuator's name; actuators that are left out get no action."""


class Accepted(dict[str, tuple[float, ...]]):
    """An action whose numbers the agent's actuators have checked already."""


Answer = Action | Command


class Brain(Block):
    """The base of all brains. An agent has exactly one that is enabled."""

    enabled: bool = True
    """True for the one brain that decides; an agent has exactly one. It may be set at any time, and
    counts from the next decision on; ``agent.use_brain`` does the same in one step."""
    skip_frame: Annotated[int, Field(ge=0, le=10_000)] = 4
    """Ticks skipped between two decisions: it decides every ``skip_frame + 1`` ticks."""
    repeat_action: bool = True
    """True applies the action on every tick until the next decision, False on the first only."""

    def decide(self, percept: Percept) -> Answer:
        """Return an action by the actuator's name, or a command.

        Args:
            percept: of the agent; a brain gets nothing else.
        """
        raise BlockError(
            _(
                "{type} has no decide(self, percept): it must return an action",
                type=type(self).__name__,
            )
        )

    @property
    def keeps_waiting(self) -> bool:
        """True while :meth:`decide` can only return HOLD; the runner is notified of the answer."""
        return False

    def restart_seed(self) -> int | None:
        """Return the seed for its RESTART; None: the seed follows from the last one."""
        return None

    def idle(self) -> None:
        """Do regular work while the world stands still, and there is nothing to decide."""

    def close(self) -> None:
        """Release resources: another brain takes its place, or the world ends."""

    def title(self) -> str:
        """Return its name for people."""
        return type(self).__name__
