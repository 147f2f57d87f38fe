"""Everything that can go wrong on purpose, in one tree.

::

    AI4UError
    ├── NameNotFoundError      a name that nothing in the world or the agent carries
    ├── SetupError             something was put together wrongly; nothing has run yet
    │   ├── ParameterError     a parameter is missing, unknown, out of range or of another type
    │   │   └── SeedError      a seed is no whole number from 0 on
    │   ├── BlockError         a block does not fit its agent or its world; names the block
    │   └── SceneError         a scene file is wrong; names file, path and line
    ├── WorldError             the world can't do this (too many bodies, a place is taken)
    ├── ReadingError           a sensor gave something that it had not declared
    ├── ActionError            an action that no actuator can carry out
    ├── NoDecisionError        an agent takes no decision, since it waits for its script
    ├── RecordingError         an episode can't be read, or played again (in ai4u_edu.recording)
    ├── WireError              what came over a network is no message (in ai4u_edu.wire)
    ├── RemoteError            a robot that is somewhere else (in ai4u_edu.remote)
    │   ├── RefusedError       the world does not give it to this script
    │   └── LostError          the connection is lost, or was ended, for good
    └── AddressError           the page can't be served there (in ai4u_edu.server)
        └── PortTakenError     somebody else listens on that port

Every message says what was expected, what came, and how to mend it.
"""

from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any

MAX_SHOWN_CHARS = 60
"""Of a value in a message."""
MAX_NAMES_COMPARED = 500
MAX_NAMES_SHOWN = 50
MAX_NAME_CHARS = 80
"""Of a name that is compared or shown; what is longer is no name that anybody chose."""


class AI4UError(Exception):
    """The root: ``except AI4UError`` catches all that this package raises on purpose."""


class NameNotFoundError(AI4UError, KeyError):
    """A name that nothing carries; the message suggests the nearest known one."""

    def __str__(self) -> str:
        return str(self.args[0])  # a KeyError alone would put its message in quotes


class SetupError(AI4UError):
    """Something was put together wrongly; nothing has run yet."""

    where: tuple[object, ...] = ()
    """The agent, then its block or parameter, that it is about; empty if that is not known."""


class ParameterError(SetupError):
    """A parameter is missing, unknown, out of range or of another type."""

    details: Exception | None = None
    """The finding, parameter by parameter, of the library that checked."""


class SeedError(ParameterError, ValueError):
    """A seed is no whole number from 0 on."""


class BlockError(SetupError):
    """A block does not fit its agent or its world."""


class SceneError(SetupError):
    """A scene file is wrong."""


class WorldError(AI4UError):
    """The world can't do what was asked of it."""

    def __init__(self, message: str, *, thing: str = "") -> None:
        super().__init__(message)
        self.thing = thing
        """The name of the body, floor or area that it is about, if it is one."""


class ReadingError(AI4UError):
    """A sensor gave something that it had not declared."""


class ActionError(AI4UError):
    """An action that no actuator can carry out."""


class NoDecisionError(AI4UError):
    """An agent was to take a decision, and took none."""


def suggest(name: str, known: Iterable[str]) -> str:
    """What to write instead of an unknown name.

    >>> suggest("bxo", ["box", "robot"])
    "did you mean 'box'?"
    >>> suggest("moon", ["box", "robot"])
    "known are 'box', 'robot'"
    >>> suggest("moon", [])
    'there are none'
    """
    names = sorted(known)
    if not names:
        return "there are none"
    if len(name) <= MAX_NAME_CHARS:
        near = get_close_matches(name, names[:MAX_NAMES_COMPARED], n=1)
        if near:
            return f"did you mean {near[0]!r}?"
    first = ", ".join(shown(each, MAX_NAME_CHARS) for each in names[:MAX_NAMES_SHOWN])
    more = len(names) - MAX_NAMES_SHOWN
    return f"known are {first}" + (f" and {more} more" if more > 0 else "")


def shown(value: object, most: int = MAX_SHOWN_CHARS) -> str:
    """Return a value as it stands in a message: the beginning of its repr.

    The value may be anything that came from a file or over a network: long, nested a thousand deep,
    or a number with more digits than Python writes.

    Args:
        value: to be shown.
        most: characters.

    >>> shown([1.0] * 1000, 20)
    '[1.0, 1.0, 1.0, 1...'
    >>> shown(10**5000)
    'a very large int'
    """
    try:
        text = repr(_beginning(value, [most + 1]))
    except ValueError:  # an int of so many digits
        text = f"a very large {type(value).__name__}"
    return shorten(text, most)


def shorten(text: str, most: int) -> str:
    """Return a text that has at most so many characters.

    >>> shorten("a sentence", 7)
    'a se...'
    """
    return text if len(text) <= most else text[: most - 3] + "..."


def _beginning(value: Any, room: list[int]) -> Any:
    """Return as much of a value as has a repr of so many characters, or a few more.

    Args:
        value: to be shown.
        room: the characters that are left; each part takes as many as its repr has, or fewer.
    """
    kind = type(value)
    room[0] -= 1
    if kind is str or kind is bytes:
        part = value[: max(room[0], 0) + 1]
        room[0] -= len(part)
        return part
    if kind not in (list, tuple, dict):
        return value
    parts = []
    for each in value.items() if kind is dict else value:
        if room[0] <= 0:
            break
        parts.append(_beginning(each, room))
    return kind(parts)
