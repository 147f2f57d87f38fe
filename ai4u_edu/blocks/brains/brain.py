"""The base class of brains."""

from typing import Annotated

from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.block import Block
from ai4u_edu.blocks.brains.command import Answer
from ai4u_edu.blocks.percept import Percept


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
            f"{type(self).__name__} has no decide(self, percept): it must return an action"
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
