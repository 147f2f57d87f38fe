"""The agent and block that an error came from, added to its message."""

from typing import Protocol

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Brain
from ai4u_edu.blocks.block import Block


class HasId(Protocol):
    """An agent, as far as it is named in a message."""

    id: str


def block_label(block: Block | None) -> str:
    """Return a block's class and its own name, as they stand in messages."""
    if isinstance(block, Brain):
        return block.title()
    name = ""
    for field in ("perception_key", "action_name", "name"):
        name = name or getattr(block, field, "")
    return f"{type(block).__name__} {name!r}" if name else type(block).__name__


def add_context(error: Exception, agent: HasId, block: Block | str | None, doing: str) -> None:
    """Add the agent and the block to an error that is on its way out, once.

    Errors of this package get it in front of their message and keep their type; all others get a
    note, since their arguments may mean anything.

    Args:
        error: is changed in place.
        agent: whose block it was.
        block: the block, or a name for what is no block.
        doing: the end of the note: "was acting".
    """
    if getattr(error, "_is_blamed", False):
        return
    name = block if isinstance(block, str) else block_label(block)
    who = f"agent {agent.id!r}"
    if isinstance(error, AI4UError) and error.args and isinstance(error.args[0], str):
        text, *others = error.args
        text = text.removeprefix(f"{who}, ")
        between = "" if text.startswith(name) else f"{name}: "
        error.args = (f"{who}, {between}{text}", *others)
    else:
        error.add_note(f"while {name} of {who} {doing}")
    error._is_blamed = True  # type: ignore[attr-defined]  # an event within an event names one
