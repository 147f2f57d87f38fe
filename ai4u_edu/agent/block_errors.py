"""Errors of blocks, in words: a student's block may raise anything, ``SystemExit`` too."""

import threading
from collections.abc import Iterable

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_frames import calls_of_error, find_place
from ai4u_edu.base.errors import AI4UError, BlockError, shorten, text_of
from ai4u_edu.blocks import RemoteBrain
from ai4u_edu.locale import Text, join
from ai4u_edu.locale import gettext as _

MAX_SENTENCE_CHARS = 1000
"""A block may raise an error with a text of any length; it is kept, logged and sent to pages."""


def sentence_of(error: BaseException, agents: Iterable[BasicAgent] = ()) -> str:
    """Tell an error in a sentence.

    Args:
        error: what was raised; of one that is meant to end a program, the block is named too.
        agents: of the world in which it was raised.

    >>> sentence_of(ValueError("no idea"))
    'ValueError: no idea'
    """
    notes = [Text(" ({note})", {"note": note}) for note in getattr(error, "__notes__", ())]
    noted: str = join([*notes], "") if notes else ""
    text = shorten(text_of(error), MAX_SENTENCE_CHARS - min(len(noted), MAX_SENTENCE_CHARS // 2))
    sentence = join([text, shorten(noted, MAX_SENTENCE_CHARS // 2)], "")
    name = type(error).__name__
    if isinstance(error, Exception):
        return join([name, sentence], ": ")
    place = find_place(calls_of_error(error.__traceback__), agents)
    where = join([place.title, place.where], ", ") if place.where else place.title
    return _(
        "{error} (raised by {place})",
        error=join([name, sentence], ": ") if sentence else name,
        place=where,
    )


def message_of(error: BaseException) -> str:
    """Tell an error to the person whose wish it kept from being done.

    >>> message_of(BlockError("no body is called 'bxo'"))
    "no body is called 'bxo'"
    >>> message_of(ValueError("no idea"))
    'ValueError: no idea'
    """
    if isinstance(error, AI4UError):
        return shorten(text_of(error), MAX_SENTENCE_CHARS)
    return sentence_of(error)


def storable(error: BaseException, agents: Iterable[BasicAgent] = ()) -> Exception:
    """Return an error that a future can hand on.

    ``SystemExit`` and the like would end the thread that asks the future, a server's event loop
    too; ``StopIteration`` can't be raised into a coroutine.
    """
    if isinstance(error, Exception) and not isinstance(error, StopIteration):
        return error
    handed_on = BlockError(sentence_of(error, agents))
    handed_on.__cause__ = error
    return handed_on


def may_be_kept(error: BaseException) -> bool:
    """Return True unless it is Ctrl-C's or an exit's of the main thread, which has to end."""
    on_main = threading.current_thread() is threading.main_thread()
    return isinstance(error, Exception) or not on_main


def reason_for_no_decision(agent: BasicAgent) -> str:
    """Say why an agent that was asked has taken no decision."""
    if agent.stopped:
        return _("its brain has stopped it; a reset begins a new episode")
    if agent.paused:
        return _("its brain has paused it")
    if isinstance(agent.brain, RemoteBrain):
        return agent.brain.status().reason or _("it waits for its script")
    return _("{title} answered with a command in place of an action", title=agent.brain.title())
