"""An agent in the terms of AI4U's protocol."""

import base64
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from gymnasium import spaces

from ai4u_edu.wire.ai4u import Kind, Order, packer
from ai4u_edu.wire.ai4u_dialogue import STANDARD
from ai4u_edu.wire.ai4u_metadata import ModelInput, ModelOutput, metadata
from ai4u_edu.wire.png import grey_png
from ai4u_edu.wire.validation import WireError

KINDS = {
    "sfloat": Kind.FLOAT,
    "sbool": Kind.BOOL,
    "sint": Kind.INT,
    "sstring": Kind.TEXT,
    "sbytearray": Kind.BYTES,
    "sstrings": Kind.TEXTS,
    "simage": Kind.TEXTS,
}
"""How a reading goes over the wire, by AI4U's type; all others are rows of floats."""


TEXTS = ("sstring", "sstrings")
"""Types that are sent, but stand in no metadata: a script makes no space of words."""


class Reading(Protocol):
    """What one sensor puts into the percept."""

    @property
    def name(self) -> str:
        """Its perception key."""

    @property
    def kind(self) -> str:
        """AI4U's type: sfloatarray, simage, ..."""

    @property
    def space(self) -> spaces.Space[Any]:
        """Of what stands in the percept."""

    @property
    def is_input(self) -> bool:
        """Whether a policy gets it."""


class Output(Protocol):
    """What one actuator takes."""

    @property
    def name(self) -> str:
        """Its action's name."""

    @property
    def space(self) -> spaces.Space[Any]:
        """Of its actions."""

    @property
    def is_output(self) -> bool:
        """Whether a policy drives it."""


class AgentCodec:
    """Percepts to fields, replies to actions.

    Every sensor's reading is sent, and those that a policy gets stand in the metadata: rows of
    numbers flat, in the order of memory; pictures as one grey PNG a channel; several texts joined
    by spaces. Whole numbers are
    declared as floats, since the script's side would make bytes of them. AI4U's environment has one
    action: it is the first actuator's; a script can drive the others by their names, or by fields.

    Args:
        readings: of the agent's sensors.
        outputs: of its actuators.

    Raises:
        WireError: AI4U's protocol has no words for what a sensor reads.
    """

    def __init__(self, readings: Sequence[Reading], outputs: Sequence[Output]) -> None:
        self._packers = [
            (each.name, _packer(each)) for each in readings if each.name not in STANDARD
        ]
        inputs = [each for each in readings if each.is_input and each.kind not in TEXTS]
        driven = [each for each in outputs if each.is_output][:1]
        self._known = {each.name for each in outputs}
        self.metadata = metadata(map(_input, inputs), map(_output, driven))

    def sensors(self, percept: Mapping[str, Any]) -> list[bytes]:
        """The readings that a script is told, packed."""
        return [pack(percept[name]) for name, pack in self._packers]

    def action(self, orders: Sequence[Order]) -> dict[str, tuple[str, ...]]:
        """The action in a reply: its command, and of its fields those that name an actuator."""
        (name, args), *fields = orders
        return {each: numbers for each, numbers in fields if each in self._known} | {name: args}


def _wire_kind(reading: Reading) -> Kind:
    if reading.kind == "sbytearray" and reading.is_input:
        return Kind.FLOATS  # the script's side leaves the base64 of bytes as it is
    return KINDS.get(reading.kind, Kind.FLOATS)


def _packer(reading: Reading) -> Callable[[Any], bytes]:
    """Makes a field of each of its readings."""
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
            return lambda _: pack(np.zeros(1))  # the script's side stumbles over a row of nothing
    return pack


def _channels_first(picture: Any) -> Any:
    """A picture of shape (height, width) or (height, width, channels), channel by channel."""
    return picture[None] if picture.ndim == 2 else np.moveaxis(picture, -1, 0)


def _input(reading: Reading) -> ModelInput:
    space = reading.space
    shape = space.shape or (1,)
    if isinstance(space, spaces.Discrete):
        low, high = float(space.start), float(space.start + space.n - 1)
    elif isinstance(space, spaces.Box):
        low, high = float(space.low.min()), float(space.high.max())
    else:
        raise WireError(
            f"sensor {reading.name!r}: expected a Box or Discrete space, got {space}; AI4U's "
            "protocol has no words for others, so set its is_input to False"
        )
    if reading.kind == "simage":
        height, width, *channels = shape
        return ModelInput(reading.name, (*(channels or [1]), height, width), "sstrings", low, high)
    kind = "sbytearray" if reading.kind == "sbytearray" else "sfloatarray"
    return ModelInput(reading.name, (int(np.prod(shape)),), kind, low, high)


def _output(output: Output) -> ModelOutput:
    space = output.space
    if isinstance(space, spaces.Discrete):
        return ModelOutput(output.name, False, (int(space.n),), (0.0,), (float(space.n - 1),))
    assert isinstance(space, spaces.Box)  # noqa: S101 - an actuator has no other space
    low, high = space.low.ravel().tolist(), space.high.ravel().tolist()
    return ModelOutput(output.name, True, (len(low),), tuple(low), tuple(high))
