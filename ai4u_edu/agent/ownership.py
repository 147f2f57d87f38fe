"""The agent that a block works for: one at a time.

A block keeps what it needs for its agent: where to write a reading, the best distance so far. Two
agents with one block would mix that up without a word. So an agent claims its blocks when they are
set up:

- Another agent of the same ControlRequestor has the block: that is an error.
- An agent of another ControlRequestor has it, as when a cell of a notebook runs again: the block
  changes over, and the agent that had it can decide and be reset no more.

Nothing here keeps an agent alive: a block refers to its owner weakly.
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
"""The attribute of a block that refers to the agent that claimed it last."""


class LostBrain(Brain):
    """Stands in for the brain of an agent whose block another agent has claimed.

    It refuses to decide and to be reset, so that nothing goes on with a block that writes to
    somewhere else; the agent can still be looked at.
    """

    abstract = True  # nothing for a scene file

    def lose(self, brain: Brain, block: Block, problem: str) -> None:
        """Say in whose place it stands, and why."""
        self._title = brain.title()
        self.is_replaceable = any(block is each for each in walk_blocks([brain]))
        """True if another brain mends it: nothing but the brain was lost."""
        self.problem = problem

    def on_reset(self, agent: AgentView, view: WorldView) -> None:  # noqa: ARG002 - refuses all
        """Refuse.

        Raises:
            SetupError: always.
        """
        raise SetupError(self.problem)

    def decide(self, percept: Percept) -> Answer:  # noqa: ARG002 - refuses all
        """Refuse.

        Raises:
            SetupError: always.
        """
        raise SetupError(self.problem)

    def title(self) -> str:
        """Return what the brain in whose place it stands is called."""
        return self._title


def walk_blocks(blocks: Iterable[Block]) -> Iterator[Block]:
    """Return blocks, each followed by the blocks inside it."""
    for block in blocks:
        yield block
        yield from walk_blocks(block.inner_blocks())


def check_each_once(agent: "BasicAgent", blocks: Iterable[Block]) -> None:
    """Look whether a block, or a block inside of one, stands in an agent twice.

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
        SetupError: an agent beside it has one of them.
    """
    claimed = list(walk_blocks(blocks))
    for block in claimed:
        owner = _owner_of(block)
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


def _owner_of(block: Block) -> "BasicAgent | None":
    """The agent that works with a block now."""
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
    lost.lose(
        bound.brain,
        block,
        f"agent {owner.id!r} has lost its {block_label(block)} to agent {agent.id!r} of another "
        "ControlRequestor, which was made later; make one for each agent, or make the "
        f"ControlRequestor of agent {owner.id!r} anew",
    )
    bound.brain = lost
