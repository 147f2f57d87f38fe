"""What every brain has: how often it decides, and the one door to acting."""

from typing import Annotated

from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.block import Block
from ai4u_edu.blocks.brains.command import Answer
from ai4u_edu.blocks.percept import Percept


class Brain(Block):
    """The base of all brains. An agent has exactly one that is enabled."""

    enabled: bool = True
    """True for the one brain that decides; an agent has exactly one."""
    skip_frame: Annotated[int, Field(ge=0, le=10_000)] = 4
    """Ticks skipped between two decisions: it decides every ``skip_frame + 1`` ticks."""
    repeat_action: bool = True
    """Whether the action is applied on every tick until the next decision, or on the first only."""

    def decide(self, percept: Percept) -> Answer:
        """An action by the actuator's name, or a command.

        Args:
            percept: what the agent senses now; all that a brain ever sees.
        """
        raise BlockError(
            f"{type(self).__name__} has no decide(self, percept): it must return an action"
        )

    @property
    def keeps_waiting(self) -> bool:
        """Whether it answers HOLD, until the runner is called; then to ask it is in vain."""
        return False

    def restart_seed(self) -> int | None:
        """The seed of the episode that it asks for with RESTART; None: it follows from the last."""
        return None

    def idle(self) -> None:
        """Called now and then while the world stands still, and nothing is to be decided."""

    def close(self) -> None:
        """Called when another brain takes its place, or the world ends."""

    def title(self) -> str:
        """What a person calls it."""
        return type(self).__name__
