"""Checks of an agent's blocks at setup."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Brain
from ai4u_edu.blocks.block import Block

if TYPE_CHECKING:
    from ai4u_edu.agent.agent import BasicAgent


def enabled_brain(agent: "BasicAgent", brains: Sequence[Brain]) -> Brain:
    """Return the one enabled brain of an agent.

    Args:
        agent: for the message.
        brains: its brains.

    Raises:
        SetupError: none or several are enabled.
    """
    enabled = [brain for brain in brains if brain.enabled]
    who = f"agent {agent.id!r}"
    if not enabled:
        problem = SetupError(
            f"{who}: expected exactly one enabled brain, got none"
            + (f" ({len(brains)} are switched off)" if brains else "")
            + "; add one, such as brains=[LocalBrain(controller=WASDRBMoveController())]"
        )
        problem.where = (agent, "brains")
        raise problem
    if len(enabled) > 1:
        names = " and ".join(brain.title() for brain in enabled)
        problem = SetupError(
            f"{who}: expected exactly one enabled brain, got {len(enabled)}: {names}; "
            "set enabled=False on the others"
        )
        problem.where = (agent, enabled[1])
        raise problem
    return enabled[0]


def check_unique(agent: "BasicAgent", what: str, field: str, blocks: Sequence[Block]) -> None:
    """Raise a SetupError if two blocks of an agent have the same name.

    Args:
        agent: the owner of the blocks.
        what: their kind, for the message.
        field: the parameter that holds the name.
        blocks: all blocks of that kind.
    """
    names: set[str] = set()
    for block in blocks:
        name = getattr(block, field)
        if name in names:
            problem = SetupError(
                f"agent {agent.id!r}: two {what}s have the {field} {name!r}; "
                f"give one of them another, as in {field}='{name}_2'"
            )
            problem.where = (agent, block)
            raise problem
        names.add(name)
