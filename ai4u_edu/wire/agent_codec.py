"""An agent in the terms of AI4U's protocol."""

import base64
import json
import struct
import zlib
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.base.errors import suggest
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext
from ai4u_edu.wire.ai4u import Kind, ReplyCommand, packer
from ai4u_edu.wire.ai4u_dialogue import STANDARD
from ai4u_edu.wire.validation import WireError, shown

SENSOR_TYPES = {
    "sfloat": 0,
    "sstring": 1,
    "sbool": 2,
    "sint": 3,
    "sbytearray": 4,
    "sfloatarray": 5,
    "sintarray": 6,
    "sstrings": 7,
    "simage": 8,
}
"""Numbers of AI4U's types in the metadata; fields on the wire have other numbers (``Kind``)."""
KINDS = {
    "sfloat": Kind.FLOAT,
    "sbool": Kind.BOOL,
    "sint": Kind.INT,
    "sstring": Kind.TEXT,
    "sbytearray": Kind.BYTES,
    "sstrings": Kind.TEXTS,
    "simage": Kind.TEXTS,
}
"""Field types of readings on the wire, by AI4U's type; all others are rows of floats."""

MAX_LISTED_FIELDS = 4
"""Fields that a sentence names; a reply may have hundreds."""
TEXT_TYPES = ("sstring", "sstrings")
"""Types that are sent, but not part of the metadata: a script has no space for texts."""
_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


class ModelInput(NamedTuple):
    """A reading that is part of a policy's observation."""

    name: str
    shape: tuple[int, ...]
    type: str
    """One of :data:`SENSOR_TYPES`."""
    low: float
    high: float


class ModelOutput(NamedTuple):
    """An actuator that a policy drives."""

    name: str
    is_continuous: bool
    shape: tuple[int, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]


def metadata(inputs: Iterable[ModelInput], outputs: Iterable[ModelOutput]) -> str:
    """Return the metadata as JSON.

    An infinite bound is written as JavaScript's ``Infinity``, which Python reads.

    >>> metadata([ModelInput("eyes", (2,), "sfloatarray", 0.0, 1.0)], [])
    '{"inputs": [{"name": "eyes", "shape": [2], "type": 5, "rangeMin": 0.0, "rangeMax": 1.0, \
"dataType": 5}], "outputs": []}'
    """
    return json.dumps(
        {
            "inputs": [
                {
                    "name": name,
                    "shape": list(shape),
                    "type": SENSOR_TYPES[kind],
                    "rangeMin": low,
                    "rangeMax": high,
                    "dataType": SENSOR_TYPES[kind],
                }
                for name, shape, kind, low, high in inputs
            ],
            "outputs": [
                {
                    "name": name,
                    "isContinuous": continuous,
                    "shape": list(shape),
                    "rangeMin": list(low),
                    "rangeMax": list(high),
                }
                for name, continuous, shape, low, high in outputs
            ],
        }
    )


class ReadingLike(Protocol):
    """The description of one sensor's reading in the percept."""

    @property
    def name(self) -> str:
        """Its perception key."""

    @property
    def kind(self) -> str:
        """AI4U's type: sfloatarray, simage, ..."""

    @property
    def space(self) -> spaces.Space[Any]:
        """The space of the values in the percept."""

    @property
    def is_input(self) -> bool:
        """True if it is part of a policy's observation."""


class OutputLike(Protocol):
    """The description of one actuator's action."""

    @property
    def name(self) -> str:
        """The action's name."""

    @property
    def space(self) -> spaces.Space[Any]:
        """The space of its actions."""

    @property
    def is_output(self) -> bool:
        """True if a policy drives it."""


class AgentCodec:
    """Converts percepts to fields, and replies to actions.

    Every sensor's reading is sent; the metadata has those of a policy's observation. Rows of
    numbers are flat, in C order; pictures are one grey PNG a channel; several texts are joined by
    spaces. Integers are declared as floats, since the script's side would convert them to bytes.
    AI4U's environment has one action, that of the first actuator; a script can drive the others by
    their names, or by additional fields.

    Args:
        readings: of the agent's sensors.
        outputs: of its actuators.

    Raises:
        WireError: AI4U's protocol can't express what a sensor reads.
    """

    def __init__(self, readings: Sequence[ReadingLike], outputs: Sequence[OutputLike]) -> None:
        self._packers = [
            (each.name, _packer(each)) for each in readings if each.name not in STANDARD
        ]
        inputs = [each for each in readings if each.is_input and each.kind not in TEXT_TYPES]
        driven = [each for each in outputs if each.is_output][:1]
        self._known = [each.name for each in outputs]
        self.metadata = metadata(map(_input, inputs), map(_output, driven))

    def sensors(self, percept: Mapping[str, Any]) -> list[bytes]:
        """Return the encoded readings for a script."""
        return [pack(percept[name]) for name, pack in self._packers]

    def action(self, orders: Sequence[ReplyCommand]) -> dict[str, tuple[str, ...]]:
        """Return the action in a reply: its command, and the fields that name an actuator."""
        (name, args), *fields = orders
        return {each: numbers for each, numbers in fields if each in self._known} | {name: args}

    def fields(self, orders: Sequence[ReplyCommand]) -> dict[str, tuple[str, ...]]:
        """Return the fields of a reply that name no actuator; of several of a name, the last."""
        return {name: args for name, args in orders[1:] if name not in self._known}

    def find_dropped(
        self, orders: Sequence[ReplyCommand], *, is_action: bool, readable: Collection[str] = ()
    ) -> str:
        """Return a sentence about the fields of a reply that have no effect; empty for none.

        Args:
            orders: the reply: its command and its fields.
            is_action: whether the command is an action; another one's fields drive no actuator.
            readable: names of fields that the agent's sensors read.
        """
        if len(orders) == 1:
            return ""
        command, *names = (name for name, _ in orders)
        usable = set(self._known) - {command} if is_action else set()
        usable |= set(readable)
        dropped = [
            name
            for index, name in enumerate(names)
            if name not in usable or name in names[index + 1 :]
        ]
        if not dropped:
            return ""
        listed = ", ".join(map(shown, dropped[:MAX_LISTED_FIELDS]))
        listed += ", ..." if len(dropped) > MAX_LISTED_FIELDS else ""
        hint = suggest(dropped[0], sorted(usable))
        expected = _("expected no fields, since nothing here reads them")
        if usable and readable:
            expected = _(
                "expected names of other actuators or sensors of numbers ({hint}), once each",
                hint=hint,
            )
        elif usable:
            expected = _("expected names of other actuators ({hint}), once each", hint=hint)
        return ngettext(
            "field {names} of {command} had no effect: {expected}",
            "fields {names} of {command} had no effect: {expected}",
            len(dropped),
            names=listed,
            command=shown(command),
            expected=expected,
        )


def _wire_kind(reading: ReadingLike) -> Kind:
    if reading.kind == "sbytearray" and reading.is_input:
        return Kind.FLOATS  # the script's side does not decode the base64 of bytes
    return KINDS.get(reading.kind, Kind.FLOATS)


def _packer(reading: ReadingLike) -> Callable[[Any], bytes]:
    """Return a function that encodes a reading as a field."""
    kind = _wire_kind(reading)
    pack = packer(reading.name, kind)
    match kind:
        case Kind.TEXTS if reading.kind == "simage":
            return lambda picture: pack(
                [base64.b64encode(grey_png(each)).decode() for each in _channels_first(picture)]
            )
        case Kind.BYTES:
            return lambda value: pack(np.asarray(value).tobytes())
        case Kind.FLOATS if not np.prod(reading.space.shape or (1,)):
            return lambda _: pack(np.zeros(1))  # the script's side fails on an empty row
    return pack


def _channels_first(picture: Any) -> Any:
    """Return a picture of shape (height, width[, channels]) with the channels first."""
    return picture[None] if picture.ndim == 2 else np.moveaxis(picture, -1, 0)


def _input(reading: ReadingLike) -> ModelInput:
    space = reading.space
    shape = space.shape or (1,)
    if isinstance(space, spaces.Discrete):
        low, high = float(space.start), float(space.start + space.n - 1)
    elif isinstance(space, spaces.Box):
        low, high = float(space.low.min()), float(space.high.max())
    else:
        raise WireError(
            _(
                "sensor {name!r}: expected a Box or Discrete space, "
                "got {space}; AI4U's protocol has no words for others, "
                "so set its is_input to False",
                name=reading.name,
                space=str(space),
            )
        )
    if reading.kind == "simage":
        height, width, *channels = shape
        return ModelInput(reading.name, (*(channels or [1]), height, width), "sstrings", low, high)
    kind = "sbytearray" if reading.kind == "sbytearray" else "sfloatarray"
    return ModelInput(reading.name, (int(np.prod(shape)),), kind, low, high)


def _output(output: OutputLike) -> ModelOutput:
    space = output.space
    if isinstance(space, spaces.Discrete):
        return ModelOutput(output.name, False, (int(space.n),), (0.0,), (float(space.n - 1),))
    assert isinstance(space, spaces.Box)  # noqa: S101 - an actuator has no other space
    low, high = space.low.ravel().tolist(), space.high.ravel().tolist()
    return ModelOutput(output.name, True, (len(low),), tuple(low), tuple(high))


def grey_png(picture: npt.NDArray[Any]) -> bytes:
    r"""Return a picture of shape (height, width), uint8, as a PNG file.

    >>> grey_png(np.zeros((2, 3), np.uint8))[:4]
    b'\x89PNG'
    """
    height, width = picture.shape
    rows = np.zeros((height, width + 1), np.uint8)  # each begins with its filter type: 0 for none
    rows[:, 1:] = picture
    return b"".join(
        (
            _PNG_SIGNATURE,
            _png_chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)),
            _png_chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)),
            _png_chunk(b"IEND", b""),
        )
    )


def _png_chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
