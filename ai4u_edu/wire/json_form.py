"""Frames of our own protocol as JSON, for programs in languages without msgpack.

A message is an object: its type, then its fields by name::

    {"type": "reset", "seq": 3, "seed": null}

It is the same message as in msgpack, but for two places. In a percept, ``readings`` has the reading
of each key in place of ``data`` and ``texts``: a number, true or false, a text, a list of texts, or
an array, such as a picture, as nested lists. The bounds of a reading in a welcome are numbers.

JSON has no NaN and no infinity. A bound that is infinite is ``null``: there is no bound. Any other
such number is refused, in both directions.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any, get_args

import msgspec
import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import suggest, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.wire import native
from ai4u_edu.wire.message_codec import Record
from ai4u_edu.wire.texts import SEVERAL, pack_texts, unpack_texts
from ai4u_edu.wire.validation import WireError, shown

_MESSAGES: dict[str, type[Record]] = {
    kind.__name__.lower(): kind for kind in get_args(native.Message)
}
_PARTS: dict[str, type[Record]] = {"readings": native.Reading, "outputs": native.Output}
"""Records inside of a welcome, by its field."""
_BOUNDS = {"low": -math.inf, "high": math.inf}
"""Fields of bounds, and the value of one that is missing."""
_TYPE = "type"
_READINGS = "readings"
_BLOCK = ("data", "texts")
"""Fields of a percept that have its readings in msgpack."""
_ABSENT = _("JSON has no NaN and no infinity")


class JsonForm:
    """Converter between frames and JSON, for one connection.

    It remembers the readings of the latest welcome, which tell what a percept consists of.
    """

    def __init__(self) -> None:
        self._readings: tuple[native.Reading, ...] = ()

    def text_of(self, frame: bytes) -> str:
        """Return a frame's message as JSON.

        Raises:
            WireError: there is no message in it, or one with a number that JSON lacks.
        """
        message = native.decode(frame, native.MAX_WORLD_FRAME_BYTES)
        if isinstance(message, native.Welcome):
            self._readings = message.readings
        fields = {_TYPE: type(message).__name__.lower()} | _object(message)
        if isinstance(message, native.Percept):
            for name in _BLOCK:
                del fields[name]
            fields[_READINGS] = {each.key: _value(each, message) for each in self._readings}
        return msgspec.json.encode(fields).decode()

    def frame_of(self, text: bytes) -> bytes:
        """Return the frame of a message in JSON; its fields are checked when it is decoded.

        Raises:
            WireError: it is no object that has a message's fields. No other error is raised for
                any bytes.
        """
        try:
            said = msgspec.json.decode(text)
        except Exception as error:  # any error is due to the bytes, such as nesting too deep
            absent = join(["; ", _ABSENT], "") if b"NaN" in text or b"Infinity" in text else ""
            raise WireError(
                _(
                    "expected JSON, got {text} ({error}){absent}",
                    text=shown(text),
                    error=text_of(error),
                    absent=absent,
                )
            ) from None
        kind = said.pop(_TYPE, None) if type(said) is dict else None
        if type(kind) is not str or kind not in _MESSAGES:
            raise WireError(
                _(
                    "expected an object with a type ({messages}), got {kind}",
                    messages=", ".join(_MESSAGES),
                    kind=shown(kind),
                )
            )
        if kind == "percept" and _READINGS in said:
            said |= self._block(said.pop(_READINGS))
        if kind == "action":
            _refuse_null(said.get("values"))
        parts = _fields(_MESSAGES[kind], kind, said)
        try:
            frame = msgspec.msgpack.encode((kind, *parts))
        except (OverflowError, RecursionError, ValueError) as error:
            raise WireError(
                _(
                    "{kind}: expected numbers of up to 64 bits, and text ({error})",
                    kind=kind,
                    error=text_of(error),
                )
            ) from None
        if kind == "welcome":
            message = native.decode(frame, native.MAX_WORLD_FRAME_BYTES)
            self._readings = message.readings if isinstance(message, native.Welcome) else ()
        return frame

    def _block(self, readings: Any) -> dict[str, Any]:
        """Return the fields of a percept in which msgpack has its readings."""
        if type(readings) is not dict or readings.keys() != {each.key for each in self._readings}:
            keys = ", ".join(each.key for each in self._readings)
            raise WireError(
                _(
                    "readings: expected an object with {keys}, got {readings}",
                    keys=keys,
                    readings=shown(readings),
                )
            )
        data = bytearray()
        texts: dict[int, str] = {}
        for each in self._readings:
            value = readings[each.key]
            if each.kind == "text":
                is_list = each.sensor_type == SEVERAL and type(value) is list
                texts[each.offset] = (
                    pack_texts(value, native.MAX_READING_CHARS) if is_list else value
                )
                continue
            numbers = _array(each.key, value, each.dtype).reshape(-1)
            if numbers.size != math.prod(each.shape):
                raise WireError(
                    _(
                        "readings: {key!r}: expected the shape {shape}, got {value}",
                        key=each.key,
                        shape=str(each.shape),
                        value=shown(value),
                    )
                )
            packed = numbers.tobytes()
            data.extend(bytes(max(0, each.offset + len(packed) - len(data))))
            data[each.offset : each.offset + len(packed)] = packed
        return {"data": bytes(data), "texts": [text for _, text in sorted(texts.items())]}


def _object(record: Record) -> dict[str, Any]:
    """Return the fields of a message or a part of one by name."""
    fields = {}
    for name in record.__struct_fields__:
        value = getattr(record, name)
        if name in _BOUNDS:
            fields[name] = _bounds(record, name, value)
        else:
            fields[name] = _plain(name, value)
    return fields


def _plain(name: str, value: Any) -> Any:
    match value:
        case Record():
            return _object(value)
        case float() if not math.isfinite(value):
            raise WireError(
                _(
                    "{name}: expected a finite number, got {value}; {absent}",
                    name=name,
                    value=value,
                    absent=_ABSENT,
                )
            )
        case tuple() | list():
            return [_plain(name, each) for each in value]
        case Mapping():
            return {key: _plain(name, each) for key, each in value.items()}
    return value


def _bounds(record: Record, name: str, value: Any) -> list[Any]:
    """Return bounds as numbers, and None for those that are infinite."""
    numbers: Sequence[Any] = value
    if isinstance(record, native.Reading):
        numbers = _unpacked(record, value).tolist() if record.dtype else []
    missing = _BOUNDS[name]
    return [None if each == missing else _plain(name, each) for each in numbers]


def _value(reading: native.Reading, percept: native.Percept) -> Any:
    """Return a reading as JSON has it."""
    if reading.kind == "text":
        try:
            text = percept.texts[reading.offset]
            return list(unpack_texts(text)) if reading.sensor_type == SEVERAL else text
        except (IndexError, ValueError) as error:
            raise WireError(
                _(
                    "{key}: expected text in the percept ({error})",
                    key=reading.key,
                    error=text_of(error),
                )
            ) from None
    count = math.prod(reading.shape)
    size = count * np.dtype(reading.dtype).itemsize
    numbers = _unpacked(reading, percept.data[reading.offset : reading.offset + size])
    if numbers.size != count:
        raise WireError(
            _(
                "{key}: expected {count} numbers, got {size}",
                key=reading.key,
                count=count,
                size=numbers.size,
            )
        )
    if not np.isfinite(numbers).all():
        text = shown(numbers.tolist())
        raise WireError(
            _(
                "{key}: expected finite numbers, got {text}; {absent}",
                key=reading.key,
                text=text,
                absent=_ABSENT,
            )
        )
    return numbers.reshape(reading.shape).tolist()


def _unpacked(reading: native.Reading, data: bytes) -> npt.NDArray[Any]:
    try:
        return np.frombuffer(data, reading.dtype)
    except ValueError as error:
        raise WireError(
            _(
                "{key}: expected numbers of {dtype} ({error})",
                key=reading.key,
                dtype=reading.dtype,
                error=text_of(error),
            )
        ) from None


def _fields(kind: type[Record], where: str, said: Mapping[str, Any]) -> list[Any]:
    """Return an object's fields in the order of the message, or of a part of it."""
    known = msgspec.structs.fields(kind)
    names = [field.name for field in known]
    for name in said:
        if name not in names:
            raise WireError(
                _(
                    "{where}: no field is called {name}; {hint}",
                    where=where,
                    name=shown(name),
                    hint=suggest(name, names),
                )
            )
    missing = [field.name for field in known if field.required and field.name not in said]
    if missing:
        raise WireError(
            _(
                "{where}: expected the fields {names}; missing: {missing}",
                where=where,
                names=", ".join(names),
                missing=missing[0],
            )
        )
    values = []
    for field in known:
        value = said.get(field.name, field.default)
        if field.name in _PARTS:
            value = _parts(field.name, value)
        elif field.name in _BOUNDS:
            value = _packed_bounds(kind, field.name, value, str(said.get("dtype", "")))
        values.append(value)
    return values


def _parts(name: str, value: Any) -> list[Any]:
    if type(value) is not list or not all(type(each) is dict for each in value):
        raise WireError(
            _("{name}: expected a list of objects, got {value}", name=name, value=shown(value))
        )
    return [_fields(_PARTS[name], name, each) for each in value]


def _packed_bounds(kind: type[Record], name: str, value: Any, dtype: str) -> Any:
    if type(value) is not list:
        raise WireError(
            _("{name}: expected a list of numbers, got {value}", name=name, value=shown(value))
        )
    numbers = [_BOUNDS[name] if each is None else each for each in value]
    if kind is native.Output:
        return numbers
    return _array(name, numbers, dtype, may_be_infinite=True).tobytes() if dtype else b""


def _array(name: str, value: Any, dtype: str, *, may_be_infinite: bool = False) -> npt.NDArray[Any]:
    """Return numbers as an array.

    Raises:
        WireError: there is something else among them.
    """
    try:
        array = np.asarray(value if value != [] else np.zeros(0))
        if array.dtype.kind in "biuf" and (may_be_infinite or np.isfinite(array).all()):
            return array.astype(dtype)
    except (TypeError, ValueError, OverflowError):
        pass
    raise WireError(
        _(
            "{name}: expected numbers, got {value}; {absent}",
            name=name,
            value=shown(value),
            absent=_ABSENT,
        )
    )


def _refuse_null(values: Any) -> None:
    """Raise a WireError for an action with a null, which other languages make of NaN."""
    for name, numbers in values.items() if type(values) is dict else ():
        if type(numbers) is list and None in numbers:
            raise WireError(
                _(
                    "values: {name}: expected finite numbers, got null; {absent}",
                    name=shown(name),
                    absent=_ABSENT,
                )
            )
