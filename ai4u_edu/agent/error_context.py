"""Agent and block that an error came from, added to its message."""

from typing import Protocol

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Brain
from ai4u_edu.blocks.block import Block
from ai4u_edu.locale import Text, join
from ai4u_edu.locale import gettext as _


class HasId(Protocol):
    """Protocol of an agent that a message names."""

    id: str


def block_label(block: Block | None) -> str:
    """Return a block's class and name for messages."""
    if isinstance(block, Brain):
        return block.title()
    name = ""
    for field in ("perception_key", "action_name", "name"):
        name = name or getattr(block, field, "")
    return f"{type(block).__name__} {name!r}" if name else type(block).__name__


def add_context(error: Exception, agent: HasId, block: Block | str | None, doing: Text) -> None:
    """Add agent and block to an error, once.

    Errors of this package get them in front of their message and keep their type; all others get
    a note, since their arguments are not known to be a message.

    Args:
        error: changed in place.
        agent: the block's agent.
        block: the block, or the name of a handler.
        doing: the note, with ``{block}`` and ``{agent}`` in it.
    """
    if getattr(error, "_has_context", False):
        return
    name = block if isinstance(block, str) else block_label(block)
    who = _("agent {id!r}", id=agent.id)
    if isinstance(error, AI4UError) and error.args and isinstance(error.args[0], str):
        text, *others = error.args
        if text.startswith(f"{who}, "):  # it names the agent itself
            text = text.removeprefix(f"{who}, ")
        named = [text] if text.startswith(name) else [name, text]
        error.args = (join([who, join(named, ": ")], ", "), *others)
    else:
        error.add_note(Text(doing.msgid, {"block": name, "agent": who}))
    error._has_context = True  # type: ignore[attr-defined]  # of nested events only the inner one is named
