"""Reading of a page's messages."""

from collections.abc import Iterable
from typing import Any, Union

import msgspec
from msgspec import Struct

from ai4u_edu.base.errors import suggest
from ai4u_edu.panel.messages.base import Command, Number, Show


class MessageReader:
    """Reads messages from pages: what a page looks at, and commands.

    Args:
        commands: types of the commands that pages may send.

    >>> from ai4u_edu.panel.messages import play
    >>> read = MessageReader([play.Pause, play.SetSpeed]).read
    >>> read('{"type": "do", "id": 1, "command": "speed", "speed": 2}').speed
    2.0
    >>> read('{"type": "do", "id": 1, "command": "puase"}')
    Traceback (most recent call last):
    ...
    ValueError: no command is called 'puase'; did you mean 'pause'?
    """

    def __init__(self, commands: Iterable[type[Command]]) -> None:
        self.names = {str(each.__struct_config__.tag): each for each in commands}
        """Commands by name."""
        self._command: msgspec.json.Decoder[Any] = msgspec.json.Decoder(
            Union[tuple(self.names.values())]  # noqa: UP007 - there is no other way for a list
        )

    def read(self, text: str | bytes) -> Show | Command:
        """Return the message in a JSON text.

        Raises:
            ValueError: it is no such message; the text says what was expected.
        """
        try:
            return self._decoded(text)
        except msgspec.ValidationError as error:
            raise ValueError(_sentence(str(error))) from None
        except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
            raise ValueError(f"expected JSON, got {text[:40]!r}: {error}") from None

    def _decoded(self, text: str | bytes) -> Show | Command:
        kind = _ENVELOPE.decode(text)
        if kind.type == "show":
            return _SHOW.decode(text)
        if kind.type != "do":
            raise ValueError(f"expected the type 'show' or 'do', got {kind.type!r:.80}")
        if kind.command not in self.names:
            hint = suggest(kind.command[:80], self.names)
            raise ValueError(f"no command is called {kind.command!r:.80}; {hint}")
        command: Command = self._command.decode(text)
        return command


def id_in(text: str | bytes) -> int | None:
    """Return the id of a message that could not be read, so that its page gets an answer."""
    try:
        return _ENVELOPE.decode(text).id
    except (msgspec.MsgspecError, RecursionError, UnicodeError):
        return None


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


_ENVELOPE = msgspec.json.Decoder(_Envelope)
_SHOW = msgspec.json.Decoder(Show)
