"""All errors that this package raises on purpose.

::

    AI4UError
    ├── NameNotFoundError      nothing in the world or the agent has this name
    ├── SetupError             something was put together wrongly; nothing has run yet
    │   ├── ParameterError     a parameter is missing, unknown, out of range or of another type
    │   │   └── SeedError      a seed is not a whole number from 0 on
    │   ├── BlockError         a block does not fit its agent or its world; names the block
    │   └── SceneError         a scene file is wrong; names file, path and line
    ├── WorldError             the world can't do this (too many bodies, a place is taken)
    ├── ReadingError           a sensor read something outside its declaration
    ├── ActionError            no actuator can execute an action
    ├── NoDecisionError        an agent takes no decision, since it waits for its script
    ├── RecordingError         an episode can't be read, or played again (in ai4u_edu.recording)
    ├── WireError              data from a network is not a valid message (in ai4u_edu.wire)
    ├── RemoteError            controlling a robot over a network failed (in ai4u_edu.remote)
    │   ├── RefusedError       the world refuses the robot to this script
    │   └── LostError          the connection is lost, or was closed, for good
    ├── NotJoinedError         a class gives this program no seat (in ai4u_edu.member)
    │   └── UnreachableError   nobody answers at the class's address
    └── AddressError           the page can't be served there (in ai4u_edu.page.server)
        └── PortTakenError     another program uses that port

Every message says what was expected, what it got, and how to mend it.
"""

from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any

from ai4u_edu.locale import Text, in_chosen_language
from ai4u_edu.locale import gettext as _

MAX_SHOWN_CHARS = 60
"""Maximum length of a value in a message."""
MAX_NAMES_COMPARED = 500
MAX_NAMES_SHOWN = 50
MAX_NAME_CHARS = 80
"""Maximum length of a name that is compared or shown; nobody chooses longer ones."""


class AI4UError(Exception):
    """The base of all errors that this package raises on purpose."""

    def __str__(self) -> str:
        """Return the message, in English if no language was chosen by ``set_language``."""
        if len(self.args) == 1 and isinstance(self.args[0], str):
            return in_chosen_language(self.args[0])
        return super().__str__()


class NameNotFoundError(AI4UError, KeyError):
    """Nothing has this name; the message suggests the nearest known one."""


class SetupError(AI4UError):
    """Something was put together wrongly; nothing has run yet."""

    where: tuple[object, ...] = ()
    """The agent, then its block or parameter, that caused it; empty if unknown."""


class ParameterError(SetupError):
    """A parameter is missing, unknown, out of range or of another type."""

    details: Exception | None = None
    """The validation library's error, with details for each parameter."""


class UnknownAttributeError(SetupError, AttributeError):
    """An attribute was set that the object's class does not have."""


class SeedError(ParameterError, ValueError):
    """A seed is not a whole number from 0 on."""


class BlockError(SetupError):
    """A block does not fit its agent or its world."""

    problem: str = ""
    """The message without the block's name; empty if it doesn't begin with one."""


class SceneError(SetupError):
    """A scene file is wrong."""


class WorldError(AI4UError):
    """The world can't do this, such as adding too many bodies."""

    def __init__(self, message: str, *, thing: str = "") -> None:
        super().__init__(message)
        self.thing = thing
        """Name of the body, floor or area that caused it; empty if there is none."""


class ReadingError(AI4UError):
    """A sensor read something outside its declaration."""


class ActionError(AI4UError):
    """No actuator can execute an action."""


class NoDecisionError(AI4UError):
    """An agent took no decision when one was needed."""


def text_of(error: BaseException) -> str:
    """Return an error's message, as a text that can be translated if it is one.

    As a string it is English; ``str(error)`` is in the language that a program chose.
    """
    (message,) = error.args if len(error.args) == 1 else ("",)
    return message if isinstance(message, Text) else str(error)


def suggest(name: str, known: Iterable[str]) -> str:
    """Return a hint for an unknown name: the nearest known one, or all.

    >>> suggest("bxo", ["box", "robot"])
    "did you mean 'box'?"
    >>> suggest("moon", ["box", "robot"])
    "known are 'box', 'robot'"
    >>> suggest("moon", [])
    'there are none'
    """
    names = sorted(known)
    if not names:
        return _("there are none")
    if len(name) <= MAX_NAME_CHARS:
        near = get_close_matches(name, names[:MAX_NAMES_COMPARED], n=1)
        if near:
            return _("did you mean {name!r}?", name=near[0])
    first = ", ".join(shown(each, MAX_NAME_CHARS) for each in names[:MAX_NAMES_SHOWN])
    more = len(names) - MAX_NAMES_SHOWN
    if more > 0:
        return _("known are {names} and {more} more", names=first, more=more)
    return _("known are {names}", names=first)


def shown(value: object, max_chars: int = MAX_SHOWN_CHARS) -> str:
    """Return a value for a message: the beginning of its repr.

    The value may be any input from a file or network: long, nested a thousand levels deep, or a
    number with more digits than Python converts.

    Args:
        value: the value.
        max_chars: maximum number of characters.

    >>> shown([1.0] * 1000, 20)
    '[1.0, 1.0, 1.0, 1...'
    >>> shown(10**5000)
    'a very large int'
    """
    try:
        text = repr(_beginning(value, [max_chars + 1]))
    except ValueError:  # an int with more digits than Python converts
        text = _("a very large {type}", type=type(value).__name__)
    return shorten(text, max_chars)


def shorten(text: str, max_chars: int) -> str:
    """Shorten a text to a maximum number of characters.

    >>> shorten("a sentence", 7)
    'a se...'
    """
    return text if len(text) <= max_chars else text[: max_chars - 3] + "..."


def _beginning(value: Any, chars_left: list[int]) -> Any:
    """Return the beginning of a value whose repr has about a given number of characters.

    Args:
        value: the value.
        chars_left: list with the number of characters left; each part subtracts at most its repr's.
    """
    kind = type(value)
    chars_left[0] -= 1
    if kind is str or kind is bytes:
        part = value[: max(chars_left[0], 0) + 1]
        chars_left[0] -= len(part)
        return part
    if kind not in (list, tuple, dict):
        return value
    parts = []
    for each in value.items() if kind is dict else value:
        if chars_left[0] <= 0:
            break
        parts.append(_beginning(each, chars_left))
    return kind(parts)
