"""Messages from pages: their bounded fields, and the reader of both of a page's sockets.

They are checked strictly: no unknown fields, no conversion of types, bounded texts and numbers.
"""

from collections.abc import Iterable
from typing import Annotated, Any, Generic, Literal, TypeVar

import msgspec
from msgspec import Meta, Struct

from ai4u_edu.base.errors import suggest
from ai4u_edu.base.limits import MAX_EXACT_INT
from ai4u_edu.locale import Text, translate
from ai4u_edu.locale import gettext as _

MAX_NAME_CHARS = 200
MAX_PATH_PARTS = 12
MAX_FIELDS = 200
"""Most values of a form."""

Name = Annotated[str, Meta(max_length=MAX_NAME_CHARS)]
MAX_SELECTED = 100
"""Most things that are selected, moved or copied at once."""
Names = Annotated[tuple[Name, ...], Meta(min_length=1, max_length=MAX_SELECTED)]
Others = Annotated[tuple[Name, ...], Meta(max_length=MAX_SELECTED)]
Number = Annotated[int, Meta(ge=0, le=MAX_EXACT_INT)]
Path = Annotated[list[str | int], Meta(min_length=1, max_length=MAX_PATH_PARTS)]
Values = Annotated[dict[str, Any], Meta(max_length=MAX_FIELDS)]
Metres = Annotated[float, Meta(ge=-1e4, le=1e4)]
Degrees = Annotated[float, Meta(ge=-3600, le=3600)]
Seed = Annotated[str, Meta(pattern=r"^[0-9]{1,40}$")]
"""A whole number as text: JavaScript rounds those above 2**53."""
Kind = Literal["sensors", "actuators", "rewards", "brains"]

COMMAND_TYPE = "do"
"""The ``type`` of all commands."""


class Message(Struct, forbid_unknown_fields=True, tag_field="type"):
    """A message that is no command; its tag is its ``type``."""


class PageCommand(Struct, forbid_unknown_fields=True, tag_field="command"):
    """A command of a page; its tag is its name. The panel's answer has the same ``id``."""

    type: Literal["do"]
    id: Number


M = TypeVar("M", bound=Message)


class MessageReader(Generic[M]):
    """Reads the messages of one of a page's sockets.

    Args:
        messages: types of the messages that are no commands.
        commands: types of the commands that pages may send over this socket.

    >>> from ai4u_edu.page.server.run_commands import LockSeed, Pause
    >>> read = MessageReader([], [LockSeed, Pause]).read
    >>> read('{"type": "do", "id": 1, "command": "lock_seed", "on": true}').on
    True
    >>> read('{"type": "do", "id": 1, "command": "lock_seed", "on": 1}')
    Traceback (most recent call last):
    ...
    ValueError: on: expected bool, got int
    >>> read('{"type": "do", "id": 1, "command": "puase"}')
    Traceback (most recent call last):
    ...
    ValueError: no command is called 'puase'; did you mean 'pause'?
    """

    def __init__(self, messages: Iterable[type[M]], commands: Iterable[type[PageCommand]]) -> None:
        self._messages = {_tag(kind): msgspec.json.Decoder(kind) for kind in messages}
        self._commands = {_tag(kind): msgspec.json.Decoder(kind) for kind in commands}

    def read(self, text: str | bytes) -> M | PageCommand:
        """Return the message in a JSON text.

        Raises:
            ValueError: it is no such message; the text says what was expected.
        """
        try:
            return self._decoded(text)
        except msgspec.ValidationError as error:
            raise ValueError(_sentence(str(error))) from None
        except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
            raise ValueError(
                _("expected JSON, got {text}: {error}", text=repr(text[:40]), error=str(error))
            ) from None

    def _decoded(self, text: str | bytes) -> M | PageCommand:
        envelope = _ENVELOPE.decode(text)
        if envelope.type in self._messages:
            return self._messages[envelope.type].decode(text)
        if envelope.type != COMMAND_TYPE:
            hint = suggest(envelope.type[:80], [*self._messages, COMMAND_TYPE])
            raise ValueError(
                _("unknown type {type}; {hint}", type=f"{envelope.type!r:.80}", hint=hint)
            )
        if envelope.command not in self._commands:
            hint = suggest(envelope.command[:80], self._commands)
            name = f"{envelope.command!r:.80}"
            raise ValueError(_("no command is called {name}; {hint}", name=name, hint=hint))
        return self._commands[envelope.command].decode(text)


def id_in(text: str | bytes) -> int | None:
    """Return the id of a message that could not be read, so that its page gets an answer."""
    try:
        return _ENVELOPE.decode(text).id
    except (msgspec.MsgspecError, RecursionError, UnicodeError):
        return None


def translated(value: object) -> str:
    """Return a text in the reader's language; a hook for msgspec's encoders.

    Raises:
        NotImplementedError: it is something else, which msgspec can't encode.
    """
    if isinstance(value, Text):
        return translate(value)
    raise NotImplementedError(f"expected data, got a {type(value).__name__}")


_ENCODER = msgspec.json.Encoder(enc_hook=translated)


def to_json(message: object) -> bytes:
    """Return a message to a page as JSON, with its texts in the page's language.

    Numbers that JSON can't hold (NaN, infinity) become null.
    """
    return _ENCODER.encode(message)


class _Envelope(Struct):
    type: str
    command: str = ""
    id: Number | None = None


_ENVELOPE = msgspec.json.Decoder(_Envelope)


def _tag(kind: type[Struct]) -> str:
    return str(kind.__struct_config__.tag)


def _sentence(text: str) -> str:
    """Return msgspec's error with the field's name first.

    >>> _sentence("Expected `bool`, got `int` - at `$.on`")
    'on: expected bool, got int'
    """
    what, _, place = text.replace("`", "").partition(" - at $")
    what = what[:1].lower() + what[1:]
    return f"{place.lstrip('.')}: {what}" if place else what
