"""Ownership of blocks: a block belongs to one agent at a time.

A block keeps state for its agent, such as the best distance so far. Two agents that share a block
would silently corrupt it. So an agent claims its blocks when they are set up:

- If another agent of the same ControlRequestor has the block, that is an error.
- If an agent of another ControlRequestor has it, as when a notebook cell runs again, the block
  changes its owner, and the agent that had it can neither decide nor be reset any more.

A block refers to its owner weakly.
"""

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any
from weakref import ref

from ai4u_edu.agent.error_context import block_label
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Brain, Percept
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.block import Block
from ai4u_edu.blocks.brains.command import Answer
from ai4u_edu.world import WorldView

if TYPE_CHECKING:
    from ai4u_edu.agent.agent import BasicAgent

_OWNER = "_owner_ref"
"""Attribute of a block that refers to the agent that claimed it last."""


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
        """Refuse.

        Raises:
            SetupError: always.
        """
        raise SetupError(self.problem)

    def decide(self, percept: Percept) -> Answer:  # noqa: ARG002 - refuses any
        """Refuse.

        Raises:
            SetupError: always.
        """
        raise SetupError(self.problem)

    def title(self) -> str:
        """Return the title of the brain that it replaces."""
        return self._title


def walk_blocks(blocks: Iterable[Block]) -> Iterator[Block]:
    """Yield blocks, each followed by the blocks inside it."""
    for block in blocks:
        yield block
        yield from walk_blocks(block.inner_blocks())


def check_each_once(agent: "BasicAgent", blocks: Iterable[Block]) -> None:
    """Check that no block, nor a block inside one, occurs in an agent twice.

    Raises:
        SetupError: one does.
    """
    known: set[int] = set()
    for block in walk_blocks(blocks):
        if id(block) in known:
            raise SetupError(
                f"agent {agent.id!r}: the same {block_label(block)} stands in it twice; "
                f"make one for each place, as in {type(block).__name__}(...) there as well"
            )
        known.add(id(block))


def claim(agent: "BasicAgent", blocks: Iterable[Block]) -> None:
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
                f"agents {owner.id!r} and {agent.id!r} share the same {block_label(block)}; "
                f"make one for each agent, as in {type(block).__name__}(...) for each"
            )
        _take_away(owner, block, agent)
    for block in claimed:
        setattr(block, _OWNER, ref(agent))


def owner_of(block: Block) -> "BasicAgent | None":
    """Return the agent that uses a block now."""
    reference: Any = getattr(block, _OWNER, None)
    owner: BasicAgent | None = reference() if reference is not None else None
    bound = owner.bound_blocks_or_none if owner is not None else None
    if bound is None or not any(each is block for each in walk_blocks(bound.blocks)):
        return None
    return owner


def _are_together(one: "BasicAgent", other: "BasicAgent") -> bool:
    return one.requestor is not None and one.requestor is other.requestor


def _take_away(owner: "BasicAgent", block: Block, agent: "BasicAgent") -> None:
    bound = owner.bound_blocks
    if isinstance(bound.brain, LostBrain) and not bound.brain.is_replaceable:
        return
    lost = LostBrain(skip_frame=bound.brain.skip_frame, repeat_action=bound.brain.repeat_action)
    lost.replace_brain(
        bound.brain,
        block,
        f"agent {owner.id!r} has lost its {block_label(block)} to agent {agent.id!r} of another "
        "ControlRequestor, which was made later; make one for each agent, or make the "
        f"ControlRequestor of agent {owner.id!r} anew",
    )
    bound.brain = lost
