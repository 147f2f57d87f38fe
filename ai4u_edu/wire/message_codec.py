"""Codec of a protocol whose messages are msgpack arrays: the kind, then the fields.

Compatibility: a field that was added to a message later stands at its end and has a default. It is
left out of the frame if it has its default, and takes its default if it is not there.
"""

from collections.abc import Callable
from functools import partial
from typing import Any, Generic, TypeVar, get_args

import msgspec
from msgspec import Struct

from ai4u_edu.locale import Text
from ai4u_edu.locale import gettext as _
from ai4u_edu.wire.validation import WireError, find_wrong_field, shown


class Record(Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """Base of messages and their parts: an array of fields on the wire."""


class TaggedMessage(Record, frozen=True, tag=str.lower):
    """Base of messages, which begin with their tag: by default the class's name in lower case."""


M = TypeVar("M", bound=TaggedMessage)


class MessageCodec(Generic[M]):
    """Encoder and decoder of a protocol's messages.

    Args:
        union: of the classes of all messages.
        text: returns a text as it is sent; default: in English.
    """

    def __init__(self, union: Any, text: Callable[[str], str] = str) -> None:
        self._decoder: msgspec.msgpack.Decoder[M] = msgspec.msgpack.Decoder(union)
        self._encoder = msgspec.msgpack.Encoder(enc_hook=partial(_plain, text))
        self._fields: dict[str, tuple[msgspec.inspect.Field, ...]] = {}
        for kind in get_args(union):
            info = msgspec.inspect.type_info(kind)
            assert isinstance(info, msgspec.inspect.StructType)  # noqa: S101
            self._fields[str(info.tag)] = info.fields

    def encode(self, message: M) -> bytes:
        """Return a message as a frame, without trailing fields that have their default."""
        fields: Any = message
        if message.__struct_defaults__:
            fields = _without_defaults(message)
        try:
            return self._encoder.encode(fields)
        except UnicodeEncodeError:  # half of a surrogate pair, from somebody's text
            return self._encoder.encode(
                _without_surrogates(msgspec.to_builtins(fields, builtin_types=(bytes,)))
            )

    def decode(self, frame: bytes, max_bytes: int) -> M:
        """Return the message in a frame.

        Raises:
            WireError: there is no valid message in it. No other error is raised for any bytes.
        """
        if len(frame) > max_bytes:
            raise WireError(
                _(
                    "expected at most {most} bytes, got {count}",
                    most=max_bytes,
                    count=len(frame),
                )
            )
        try:
            return self._decoder.decode(frame)
        except Exception as error:  # any error is due to the bytes
            raise WireError(self._explain(frame, error)) from None

    def _explain(self, frame: bytes, error: Exception) -> str:
        """Return the text for a frame that is no message."""
        try:
            parts = msgspec.msgpack.decode(frame)
        except Exception as malformed:  # such as bytes that nest too deep
            return _(
                "expected msgpack, got {frame} ({problem})",
                frame=shown(frame),
                problem=str(malformed),
            )
        name = parts[0] if type(parts) is list and parts else None
        if type(name) is not str or name not in self._fields:
            known = ", ".join(self._fields)
            return _("expected a message ({known}), got {name}", known=known, name=shown(name))
        return find_wrong_field(self._fields[name], parts[1:]) or str(error)


def _plain(text: Callable[[str], str], value: Any) -> Any:
    """Convert an instance of a subclass, such as numpy.float64."""
    if isinstance(value, Text):
        return text(value)
    for kind in (float, int, str):
        if isinstance(value, kind):
            return kind(value)
    raise TypeError(shown(value))


def _without_defaults(message: TaggedMessage) -> tuple[Any, ...]:
    kind = type(message)
    fields = msgspec.structs.astuple(message)
    for default in reversed(kind.__struct_defaults__):
        if fields[-1] != default:
            break
        fields = fields[:-1]
    return (kind.__struct_config__.tag, *fields)


def _without_surrogates(value: Any) -> Any:
    """Replace what UTF-8 can't encode in all texts of a message."""
    match value:
        case str():
            return value.encode(errors="replace").decode()
        case list() | tuple():
            return [_without_surrogates(each) for each in value]
        case dict():
            return {
                _without_surrogates(key): _without_surrogates(each) for key, each in value.items()
            }
    return value
