"""Datagrams of AI4U's own protocol: text over UDP, one request and one reply at a time.

The world sends requests, the script replies. A request is a list of named fields, each with a type.
A reply is a list of commands: the first one counts, the others are its fields::

    request     5  10__target__3      10envcontrol   2id3       10 ...
                how many fields; of each: bytes of the name, name, type, bytes of the value, value
    reply       move;4;1.0;0;0;0@speed;1;2
                name, number of arguments, arguments; the next command after an @

Source: AI4U's ControlRequestor.SendMessageFrom and the Python package's BMWorker.decode.
"""

import base64
import binascii
import re
from collections.abc import Callable, Iterable, Sequence
from enum import IntEnum
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.locale import gettext as _
from ai4u_edu.wire.validation import WireError, shown

MAX_DATAGRAM_BYTES = 65_507
"""The largest UDP datagram over IPv4."""
MIN_CACHED_ROW_BYTES = 64
"""Size of a row of numbers from which on caching its text is faster than writing it again."""
HALT = "halt"
"""The only reply that is not a command: the script has ended."""


class Kind(IntEnum):
    """Types of fields (AI4U's Python package has other names for the numbers)."""

    FLOAT = 0
    INT = 1
    BOOL = 2
    TEXT = 3
    BYTES = 4
    FLOATS = 5
    INTS = 6
    TEXTS = 7


class Field(NamedTuple):
    """A named value of a request."""

    name: str
    kind: Kind
    value: Any
    """float, int, bool, str, bytes, an array of float64 or int64, or a list of str."""


class ReplyCommand(NamedTuple):
    """A command of a reply."""

    name: str
    args: tuple[str, ...] = ()


# -- requests --------------------------------------------------------------------------------------


def encode_request(fields: Iterable[Field]) -> bytes:
    """Return a request as a datagram.

    Raises:
        WireError: a value does not have the type of its field, or the request is too large.

    >>> encode_request([Field("id", Kind.TEXT, "0"), Field("done", Kind.BOOL, True)])
    b'   2   2id3       10   4done2       11'
    """
    parts = [packed(field) for field in fields]
    return joined(parts)


def packed(field: Field) -> bytes:
    """Return an encoded field, for fields that are the same in many requests."""
    return packer(field.name, field.kind)(field.value)


def packer(name: str, kind: Kind) -> Callable[[Any], bytes]:
    """Return a function that encodes values as a field with this name and type."""
    encoded, write = name.encode(), _WRITERS[kind]
    head = b"%4d%s%d" % (len(encoded), encoded, kind)

    def pack(value: Any) -> bytes:
        try:
            text = write(value).encode()
        except (TypeError, ValueError, OverflowError) as error:
            raise WireError(
                _(
                    "field {name!r}: {value} is no {kind}",
                    name=name,
                    value=shown(value),
                    kind=kind.name,
                )
            ) from error
        if len(encoded) > 9_999 or len(text) > 99_999_999:
            raise WireError(
                _(
                    "field {name}: expected a value that fits, got {count}",
                    name=shown(name),
                    count=len(text),
                )
            )
        return b"%s%8d%s" % (head, len(text), text)

    return pack


def joined(parts: Sequence[bytes]) -> bytes:
    """Return a request of encoded fields."""
    request = b"%4d%s" % (len(parts), b"".join(parts))
    if len(request) > MAX_DATAGRAM_BYTES:
        raise WireError(
            _(
                "expected a request of at most {most} "
                "bytes, got {count}: make sensors that read much "
                "smaller, or switch them off (is_active=False)",
                most=MAX_DATAGRAM_BYTES,
                count=len(request),
            )
        )
    return request


def decode_request(data: bytes) -> list[Field]:
    """Return the fields of a request.

    Raises:
        WireError: the bytes are no request. No other error is raised for any bytes.

    >>> decode_request(b'   1   4eyes5       50.5 1')
    [Field(name='eyes', kind=<Kind.FLOATS: 5>, value=array([0.5, 1. ]))]
    """
    if len(data) > MAX_DATAGRAM_BYTES:
        raise WireError(
            _(
                "expected at most {most} bytes, got {count}",
                most=MAX_DATAGRAM_BYTES,
                count=len(data),
            )
        )
    count, at = _size(data, 0, 4, _("the number of fields"))
    fields = []
    for _number in range(count):
        size, at = _size(data, at, 4, _("the length of a name"))
        name, at = _words(data, at, size, _("a name"))
        kind, at = _size(data, at, 1, _("the type of {name}", name=shown(name)))
        if kind >= len(Kind):
            raise WireError(
                _(
                    "{name}: expected a type from 0 to {last}, got {kind}",
                    name=shown(name),
                    last=len(Kind) - 1,
                    kind=kind,
                )
            )
        size, at = _size(data, at, 8, _("the length of {name}", name=shown(name)))
        text, at = _words(data, at, size, _("the value of {name}", name=shown(name)))
        fields.append(Field(name, Kind(kind), _value(name, Kind(kind), text)))
    if at != len(data):
        raise WireError(
            _(
                "expected the end after {count} fields, got {more} bytes more",
                count=count,
                more=len(data) - at,
            )
        )
    return fields


def floats(numbers: npt.NDArray[Any]) -> str:
    """Return numbers as text, with nine digits, which give the same float32 when parsed.

    >>> floats(np.array([0.5, 1, -2.5e-7], np.float32))
    '0.5 1 -2.49999999e-07'
    """
    data, kind, rows = numbers.tobytes(), numbers.dtype, numbers.ndim > 1 and len(numbers)
    size = len(data) // rows if rows else 0
    if size < MIN_CACHED_ROW_BYTES:
        return _written(data, kind)
    return " ".join([_written(data[at : at + size], kind) for at in range(0, len(data), size)])


@lru_cache(maxsize=256)
def _written(data: bytes, kind: np.dtype[Any]) -> str:
    """Return a row of numbers as text, which takes 0.1 us a number.

    It is cached: a stacked reading has one new row each time, and many readings do not change.
    """
    values = np.frombuffer(data, kind).tolist()
    return _nine_digits(len(values)) % tuple(values)


@lru_cache(maxsize=256)
def _nine_digits(count: int) -> str:
    return " ".join(["%.9g"] * count)


def _float(value: Any) -> str:
    int(value)  # raises for NaN and infinities, which a script can't parse
    return repr(float(value))


_WRITERS: dict[Kind, Callable[[Any], str]] = {
    Kind.FLOAT: _float,
    Kind.INT: lambda value: str(int(value)),
    Kind.BOOL: lambda value: "1" if value else "0",
    Kind.TEXT: str,
    Kind.BYTES: lambda value: base64.b64encode(value).decode(),
    Kind.FLOATS: lambda value: floats(np.asarray(value)),
    Kind.INTS: lambda value: " ".join(map(str, np.asarray(value).ravel().tolist())),
    Kind.TEXTS: " ".join,
}


# without ambiguity: if a digit could match in two ways, 20,000 digits would take over a second
_NUMBER = re.compile(
    r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?|[+-]?(inf|nan|infinity)", re.I | re.A
)
_WHOLE = re.compile(r"[+-]?\d{1,18}", re.A)
_SIZE = re.compile(rb" *\d+ *")


def number(text: str) -> float:
    """Parse a number as a script writes it, ``nan`` and ``inf`` too.

    Raises:
        WireError: the text is no number.
    """
    text = text.strip(" ")
    if not _NUMBER.fullmatch(text):
        raise WireError(_("expected a number, got {text}", text=shown(text)))
    return float(text)


def _value(name: str, kind: Kind, text: str) -> Any:
    try:
        match kind:
            case Kind.FLOAT:
                return number(text)
            case Kind.INT:
                return _whole(text)
            case Kind.BOOL:
                return {"1": True, "0": False}[text.strip(" ")]
            case Kind.TEXT:
                return text
            case Kind.BYTES:
                return base64.b64decode(text.encode(), validate=True)
            case Kind.FLOATS:
                return np.array([number(part) for part in _parts(text)], np.float64)
            case Kind.INTS:
                return np.array([_whole(part) for part in _parts(text)], np.int64)
            case Kind.TEXTS:
                return _parts(text)
    except (KeyError, WireError, binascii.Error):
        raise WireError(
            _(
                "{name}: expected {kind}, got {text}",
                name=shown(name),
                kind=kind.name,
                text=shown(text),
            )
        ) from None


def _whole(text: str) -> int:
    text = text.strip(" ")
    if not _WHOLE.fullmatch(text):
        raise WireError(_("expected a whole number, got {text}", text=shown(text)))
    return int(text)


def _parts(text: str) -> list[str]:
    return text.split(" ") if text else []


def _size(data: bytes, at: int, digits: int, what: str) -> tuple[int, int]:
    part = data[at : at + digits]
    if len(part) != digits or not _SIZE.fullmatch(part):
        raise WireError(
            _(
                "expected {what} in {digits} characters, got {part}",
                what=what,
                digits=digits,
                part=shown(part),
            )
        )
    return int(part), at + digits


def _words(data: bytes, at: int, size: int, what: str) -> tuple[str, int]:
    part = data[at : at + size]
    if len(part) != size:
        raise WireError(
            _(
                "expected {size} bytes for {what}, got {count}",
                size=size,
                what=what,
                count=len(part),
            )
        )
    try:
        return part.decode(), at + size
    except UnicodeDecodeError:
        raise WireError(
            _("expected UTF-8 for {what}, got {part}", what=what, part=shown(part))
        ) from None


# -- replies ---------------------------------------------------------------------------------------


def encode_reply(orders: Sequence[ReplyCommand]) -> bytes:
    """Return a reply as a datagram: a command, and its fields.

    >>> encode_reply([ReplyCommand("move", ("1.0", "0", "0", "0"))])
    b'move;4;1.0;0;0;0'
    """
    if orders and orders[0].name == HALT:
        return HALT.encode()
    return "@".join(";".join((name, str(len(args)), *args)) for name, args in orders).encode()


def decode_reply(data: bytes) -> list[ReplyCommand]:
    """Return the commands of a reply: the first one counts, the others are its fields.

    Raises:
        WireError: the bytes are no reply. No other error is raised for any bytes.

    >>> decode_reply(b"move;2;1.0;0.5@speed;1;3")
    [ReplyCommand(name='move', args=('1.0', '0.5')), ReplyCommand(name='speed', args=('3',))]
    >>> decode_reply(b"move;2;1.0")
    Traceback (most recent call last):
    ...
    ai4u_edu.wire.validation.WireError: 'move': expected 2 arguments as it says, got 1
    """
    if len(data) > MAX_DATAGRAM_BYTES:
        raise WireError(
            _(
                "expected at most {most} bytes, got {count}",
                most=MAX_DATAGRAM_BYTES,
                count=len(data),
            )
        )
    try:
        text = data.decode().strip()
    except UnicodeDecodeError:
        raise WireError(_("expected a reply in UTF-8, got {data}", data=shown(data))) from None
    if text == HALT:
        return [ReplyCommand(HALT)]
    return [_order(part) for part in text.split("@")]


def _order(text: str) -> ReplyCommand:
    name, *rest = text.strip().split(";")
    if name and rest and rest[0] == str(len(rest) - 1):  # the common case
        return ReplyCommand(name, tuple(rest[1:]))
    if not name or not rest or not re.fullmatch(r"\d{1,5}", rest[0], re.A):
        raise WireError(
            _("expected a command as in 'move;2;1.0;0.5', got {text}", text=shown(text))
        )
    count, args = int(rest[0]), rest[1:]
    if not count and args == [""]:
        args = []  # the package writes a semicolon after a 0
    if count != len(args):
        raise WireError(
            _(
                "{name}: expected {count} arguments as it says, got {got}",
                name=shown(name),
                count=count,
                got=len(args),
            )
        )
    return ReplyCommand(name, tuple(args))
