"""Messages from a page's panel: what the page looks at, and commands.

They are checked strictly: no unknown fields, no conversion of types, bounded texts and numbers.
"""

from typing import Annotated, Any, Literal, Union, get_args

import msgspec
from msgspec import Meta, Struct

from ai4u_edu.base.errors import suggest
from ai4u_edu.base.limits import MAX_EXACT_INT

MAX_NAME_CHARS = 200
MAX_PATH_PARTS = 12
MAX_FIELDS = 200
"""Most values of a form."""
MAX_BODIES = 500
"""Most bodies that one command moves."""

Name = Annotated[str, Meta(max_length=MAX_NAME_CHARS)]
Number = Annotated[int, Meta(ge=0, le=MAX_EXACT_INT)]
Steps = Annotated[int, Meta(ge=-MAX_EXACT_INT, le=MAX_EXACT_INT)]
Path = Annotated[list[str | int], Meta(min_length=1, max_length=MAX_PATH_PARTS)]
Values = Annotated[dict[str, Any], Meta(max_length=MAX_FIELDS)]
Seed = Annotated[str, Meta(pattern=r"^[0-9]{1,40}$")]
"""A whole number as text: JavaScript rounds those above 2**53."""
Kind = Literal["sensors", "actuators", "rewards", "brains"]
Tab = Literal["agent", "blocks", "world", "past"]


class Show(Struct, forbid_unknown_fields=True):
    """The whole of what a page looks at; only the parts of open tabs are sent."""

    type: Literal["show"]
    agent: Name
    tabs: Annotated[list[Tab], Meta(max_length=4)] = []
    block: Path | None = None
    body: Name | None = None
    episode: Number | None = None


class Command(Struct, forbid_unknown_fields=True, tag_field="command"):
    """A command; the answer has the same ``id``."""

    type: Literal["do"]
    id: Number


class Pause(Command, tag="pause"):
    """Pause the world."""


class Resume(Command, tag="resume"):
    """Let the world run."""


class Tick(Command, tag="tick"):
    """Pause, and tick once."""


class Decision(Command, tag="decision"):
    """Pause, and run until the agent's decision is over."""


class TryAgain(Command, tag="try_again"):
    """Begin an episode with the same start."""


class NewStart(Command, tag="new_start"):
    """Begin an episode with a new start."""


class SetSeed(Command, tag="seed"):
    """Begin an episode with a seed."""

    seed: Seed


class LockSeed(Command, tag="lock_seed"):
    """Begin each episode with the same seed from now on, or with new ones."""

    on: bool


class SetSpeed(Command, tag="speed"):
    """Set the time scale; 1 is real time."""

    speed: Annotated[float, Meta(gt=0, le=1000)] | Literal["max"]


class ShowAgent(Command, tag="agent"):
    """Show another agent."""

    agent: Name


class Camera(Command, tag="camera"):
    """Put the camera somewhere."""

    mode: Literal["arena", "follow", "turn", "eyes"]


class ShowSensor(Command, tag="sensor"):
    """Draw a sensor in the picture, or hide it."""

    key: Name
    on: bool


class ShowTrail(Command, tag="trail"):
    """Draw the agent's trail, or hide it."""

    on: bool


class Dark(Command, tag="dark"):
    """Draw the picture in dark colours, or light ones."""

    on: bool


class ListDrivers(Command, tag="drivers"):
    """List the drivers that the agent can have."""


class SetDriver(Command, tag="driver"):
    """Choose the agent's driver."""

    name: Name
    agent: Name | None = None


class ListBlocks(Command, tag="gallery"):
    """List the blocks that can be added."""

    kind: Kind


class AddBlock(Command, tag="add_block"):
    """Add a block to the agent, or to one of its blocks."""

    type_name: Name = msgspec.field(name="class")
    parent: Path
    index: Annotated[int, Meta(ge=0, le=1000)] | None = None


class RemoveBlock(Command, tag="remove_block"):
    """Remove a block of the agent."""

    path: Path


class MoveBlock(Command, tag="move_block"):
    """Move a block of the agent up (-1) or down (1)."""

    path: Path
    by: Annotated[int, Meta(ge=-1000, le=1000)]


class SwitchBlock(Command, tag="switch_block"):
    """Switch a block of the agent on or off."""

    path: Path
    on: bool


class DuplicateBlock(Command, tag="duplicate_block"):
    """Add a copy of a block of the agent."""

    path: Path


class ChangeBlock(Command, tag="change_block"):
    """Change parameters of a block of the agent."""

    path: Path
    values: Values


class ChangeAgent(Command, tag="change_agent"):
    """Change parameters of the agent itself."""

    values: Values


class Undo(Command, tag="undo"):
    """Take back the last change."""


class Redo(Command, tag="redo"):
    """Make the change again that was undone last."""


def read(text: str | bytes) -> Show | Command:
    """Return the message in a JSON text.

    Raises:
        ValueError: it is no such message; the text says what was expected.

    >>> read('{"type": "do", "id": 1, "command": "speed", "speed": 2}').speed
    2.0
    >>> read('{"type": "do", "id": 1, "command": "puase"}')
    Traceback (most recent call last):
    ...
    ValueError: no command is called 'puase'; did you mean 'pause'?
    """
    try:
        return _decoded(text)
    except msgspec.ValidationError as error:
        raise ValueError(_sentence(str(error))) from None
    except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
        raise ValueError(f"expected JSON, got {text[:40]!r}: {error}") from None


def id_in(text: str | bytes) -> int | None:
    """Return the id of a message that could not be read, so that its page gets an answer."""
    try:
        return _ENVELOPE.decode(text).id
    except (msgspec.MsgspecError, RecursionError, UnicodeError):
        return None


def _decoded(text: str | bytes) -> Show | Command:
    kind = _ENVELOPE.decode(text)
    if kind.type == "show":
        return _SHOW.decode(text)
    if kind.type != "do":
        raise ValueError(f"expected the type 'show' or 'do', got {kind.type!r:.80}")
    if kind.command not in NAMES:
        hint = suggest(kind.command[:80], NAMES)
        raise ValueError(f"no command is called {kind.command!r:.80}; {hint}")
    command: Command = _COMMAND.decode(text)
    return command


class _Envelope(Struct):
    type: str
    command: str = ""
    id: Number | None = None


def _sentence(text: str) -> str:
    """Return msgspec's error with the field's name first.

    >>> _sentence("Expected `bool`, got `int` - at `$.on`")
    'on: expected bool, got int'
    """
    what, _, place = text.replace("`", "").partition(" - at $")
    what = what[:1].lower() + what[1:]
    return f"{place.lstrip('.')}: {what}" if place else what


_AnyCommand = Union[  # noqa: UP007 - a union of so many is read more easily as a list
    Pause,
    Resume,
    Tick,
    Decision,
    TryAgain,
    NewStart,
    SetSeed,
    LockSeed,
    SetSpeed,
    ShowAgent,
    Camera,
    ShowSensor,
    ShowTrail,
    Dark,
    ListDrivers,
    SetDriver,
    ListBlocks,
    AddBlock,
    RemoveBlock,
    MoveBlock,
    SwitchBlock,
    DuplicateBlock,
    ChangeBlock,
    ChangeAgent,
    Undo,
    Redo,
]
NAMES = {str(each.__struct_config__.tag): each for each in get_args(_AnyCommand)}
"""Commands by name."""
_ENVELOPE = msgspec.json.Decoder(_Envelope)
_SHOW = msgspec.json.Decoder(Show)
_COMMAND: "msgspec.json.Decoder[Any]" = msgspec.json.Decoder(_AnyCommand)
