"""Everything that can go wrong on purpose, in one tree.

::

    AI4UError
    ├── NameNotFoundError      a name that nothing in the world or the agent carries
    ├── SetupError             something was put together wrongly; nothing has run yet
    │   ├── ParameterError     a parameter is missing, unknown, out of range or of another type
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


class AI4UError(Exception):
    """The root: ``except AI4UError`` catches all that this package raises on purpose."""


class NameNotFoundError(AI4UError, KeyError):
    """A name that nothing carries; the message suggests the nearest known one."""

    def __str__(self) -> str:
        return str(self.args[0])  # a KeyError alone would put its message in quotes


class SetupError(AI4UError):
    """Something was put together wrongly; nothing has run yet."""


class ParameterError(SetupError):
    """A parameter is missing, unknown, out of range or of another type."""

    details: Exception | None = None
    """The finding, parameter by parameter, of the library that checked."""


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
    near = get_close_matches(name, names, n=1)
    if near:
        return f"did you mean {near[0]!r}?"
    return "known are " + ", ".join(repr(each) for each in names)
