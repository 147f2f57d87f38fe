"""The one agent that each block belongs to.

A block belongs to one agent at a time, since it keeps state for its agent, such as the best
distance so far. Two agents that share a block would silently corrupt it. So an agent claims its
blocks when they are set up:

- If another agent of the same ControlRequestor has the block, that is an error.
- If an agent of another ControlRequestor has it, as when a notebook cell runs again, the block
  changes its owner, and the agent that had it can neither decide nor be reset any more.

A block refers to its owner weakly.
"""

from collections.abc import Iterable
from typing import Any, Protocol
from weakref import ref

from ai4u_edu.agent.error_context import block_label
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Answer, Brain, Percept
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.block import Block, walk_blocks
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import WorldView

_OWNER = "_owner_ref"
"""Attribute of a block that refers to the agent that claimed it last."""


class OwnedBlocks(Protocol):
    """Protocol of the blocks that an agent uses (BoundBlocks are)."""

    brain: Brain

    @property
    def blocks(self) -> list[Block]:
        """All active blocks and the brain, without the blocks inside them."""


class Owner(AgentView, Protocol):
    """Protocol of an agent that claims blocks (BasicAgent is one)."""

    @property
    def requestor(self) -> object | None:
        """The ControlRequestor that the agent belongs to."""

    @property
    def bound_blocks(self) -> OwnedBlocks:
        """The blocks that it uses."""

    @property
    def bound_blocks_or_none(self) -> OwnedBlocks | None:
        """The blocks that it uses; None before it is set up."""


def claim(agent: Owner, blocks: Iterable[Block]) -> None:
    """Make an agent the owner of blocks and of the blocks inside them.

    Raises:
        SetupError: another agent of the same ControlRequestor owns one of them.
    """
    claimed = list(walk_blocks(blocks))
    for block in claimed:
        owner = owner_of(block)
        if owner is None or owner is agent:
            continue
        if _are_together(agent, owner):
            raise SetupError(
                _(
                    "agents {id!r} and {id2!r} share the same {block}; make one for each agent, "
                    "as in {type}(...) for each",
                    id=owner.id,
                    id2=agent.id,
                    block=block_label(block),
                    type=type(block).__name__,
                )
            )
        _take_away(owner, block, agent)
    for block in claimed:
        setattr(block, _OWNER, ref(agent))


def owner_of(block: Block) -> Owner | None:
    """Return the agent that uses a block now."""
    reference: Any = getattr(block, _OWNER, None)
    owner: Owner | None = reference() if reference is not None else None
    bound = owner.bound_blocks_or_none if owner is not None else None
    if bound is None or not any(each is block for each in walk_blocks(bound.blocks)):
        return None
    return owner


def _are_together(one: Owner, other: Owner) -> bool:
    return one.requestor is not None and one.requestor is other.requestor


def _take_away(owner: Owner, block: Block, agent: Owner) -> None:
    bound = owner.bound_blocks
    if isinstance(bound.brain, LostBrain) and not bound.brain.is_replaceable:
        return
    lost = LostBrain(skip_frame=bound.brain.skip_frame, repeat_action=bound.brain.repeat_action)
    lost.replace_brain(
        bound.brain,
        block,
        _(
            "agent {id!r} has lost its {block} to agent {other!r} of another ControlRequestor, "
            "which was made later; make one for each agent, or make the ControlRequestor of agent "
            "{id!r} anew",
            id=owner.id,
            block=block_label(block),
            other=agent.id,
        ),
    )
    bound.brain = lost


class LostBrain(Brain):
    """Placeholder for the brain of an agent whose block another agent has claimed.

    It refuses to decide and to be reset, since the block writes to another agent's memory now.
    The agent can still be inspected.
    """

    abstract = True  # nothing for a scene file

    def replace_brain(self, brain: Brain, block: Block, problem: str) -> None:
        """Set the brain that it replaces and the reason."""
        self._title = brain.title()
        self.is_replaceable = any(block is each for each in walk_blocks([brain]))
        """True if only the brain was lost, so that another brain can replace it."""
        self.problem = problem

    def on_reset(self, agent: AgentView, view: WorldView) -> None:  # noqa: ARG002 - refuses any
        """Raise a SetupError."""
        raise SetupError(self.problem)

    def decide(self, percept: Percept) -> Answer:  # noqa: ARG002 - refuses any
        """Raise a SetupError."""
        raise SetupError(self.problem)

    def title(self) -> str:
        """Return the title of the brain that it replaces."""
        return self._title
