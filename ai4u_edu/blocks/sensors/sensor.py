"""Base class of sensors: key, space, and the path from a raw reading to the percept."""

import math
from collections import deque
from collections.abc import Callable, Mapping
from operator import truediv
from struct import Struct
from typing import Annotated, Any, ClassVar

import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from pydantic import Field

from ai4u_edu.base.errors import BlockError, ReadingError, suggest
from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.block import Block, default_name
from ai4u_edu.blocks.percept import DTYPES, TEXTS
from ai4u_edu.blocks.sensors.pictures import Legend, SpotPicture
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView

Array = npt.NDArray[Any]

_SPACES = (
    spaces.Box,
    spaces.Discrete,
    spaces.MultiBinary,
    spaces.MultiDiscrete,
    spaces.Text,
)
"""Spaces that a reading may have, besides a Tuple or a Sequence of Text."""
KINDS = (*DTYPES, *TEXTS)
"""AI4U's types of readings."""
_ARRAY_KINDS = {"sfloat": "sfloatarray", "sint": "sintarray", "sbool": "sintarray"}
"""Types of several readings of a type of one number."""
NEUTRAL = {"stacked_observations": 1, "normalized": False, "noise": 0, "delay": 0, "dropout": 0}
"""Values with which these attributes of a sensor change nothing."""

_MAX_KEPT_NUMBERS = 2**23
"""Maximum count of numbers that a sensor may keep, over all readings for stack and delay."""


class Sensor(Block):
    """The base of all sensors: implement :meth:`space` and :meth:`read`.

    The base class adds dropout, noise, delay, normalising and stacking, in this order, and
    switches a sensor off.

    >>> from gymnasium.spaces import Box
    >>> from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, World
    >>> class DistanceTo(Sensor):
    ...     '''Distance from the agent's centre to a named body, in metres.'''
    ...     target: str
    ...     reach: float = 20.0
    ...     unit = "m"
    ...     def space(self): return Box(0.0, self.reach, (1,))
    ...     def read(self, body, view): return min(view[self.target].distance(body), self.reach)
    >>> world = World()
    >>> robot = world.add_body("robot", CircleShape(radius=0.5))
    >>> box = world.add_body("box", CircleShape(radius=0.5), position=(3, 4))
    >>> agent = BasicAgent(
    ...     body="robot",
    ...     sensors=[DistanceTo(target="box")],
    ...     brains=[LocalBrain(controller=lambda percept: {})],
    ... )
    >>> sim = ControlRequestor(world, [agent])
    >>> sim.reset()
    >>> agent.percept["distance_to"].tolist()
    [5.0]
    """

    perception_key: str = ""
    """The reading's name in the percept; by default made from the class's name."""
    stacked_observations: Annotated[int, Field(ge=1, le=1000)] = 1
    """Number of latest readings that the percept holds, oldest first."""
    is_active: bool = True
    """False leaves the sensor out; one that is switched off during an episode reads zeros."""
    normalized: bool = False
    """True divides the reading by its largest possible magnitude (AI4U's default)."""
    resetable: bool = True
    """True runs on_reset at every reset and fills stack and delay with the episode's first
    reading. False never runs on_reset, not even at the first reset (prepare in on_setup what a
    reading needs), and keeps stack and delay across resets."""
    is_input: bool = True
    """True makes the reading part of a policy's observation."""
    noise: Annotated[float, quantity("the reading's", ge=0)] = 0.0
    """Standard deviation of Gaussian noise."""
    delay: Annotated[int, quantity("decisions", ge=0, le=1000)] = 0
    """Age of the reading in the percept: 0 is the present one, 1 that of the decision before."""
    dropout: Annotated[float, quantity("1", ge=0, le=1)] = 0.0
    """Probability that a reading is lost and the one before it stays."""

    unit: ClassVar[str] = ""
    kind: ClassVar[str] = ""
    """AI4U's type of the reading; by default it follows from the space."""
    stackable: ClassVar[bool] = True
    reads_status: ClassVar[bool] = False
    """True for a sensor that reads its agent's reward or the end of its episode: it reads again if
    other sensors or handlers change these while the agent senses."""
    carried: ClassVar[tuple[str, ...]] = (
        "_raw",
        "_past",
        "_fresh",
        "_ever_read",
        "_is_range_checked",
    )
    is_held = False
    """True on a sensor inside another one while only the others inside it read again."""

    def __post_init__(self) -> None:
        self.perception_key = self.perception_key or default_name(type(self), "Sensor")

    def fixed_at_setup(self) -> dict[str, object]:
        """Return what decides on the reading's place and on its path to the percept."""
        return {
            "perception_key": self.perception_key,
            "stacked_observations": self.stacked_observations,
            "normalized": self.normalized,
            "is_input": self.is_input,
            "delay": self.delay,
            "noise": self.noise > 0,
            "dropout": self.dropout > 0,
        }

    @property
    def has_ticks(self) -> bool:
        """True if :meth:`on_tick` has something to do; only then is it called."""
        return type(self).on_tick is not Sensor.on_tick

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Run after every tick of a decision, for what a reading at its end would miss.

        It is called only where a subclass implements it, in every tick: keep it short.

        Args:
            body: the agent's body.
            view: read access to the world.
        """

    # -- methods that a sensor implements --------------------------------------------------------

    def space(self) -> spaces.Space[Any]:
        """Return the space of one raw reading, in the sensor's unit."""
        raise BlockError(
            _(
                "{type} has no space(self): it must say what it can read, as a Box",
                type=type(self).__name__,
            )
        )

    def read(self, body: BodyView, view: WorldView) -> Any:
        """Return one raw reading, inside :meth:`space`.

        Args:
            body: the agent's body.
            view: read access to the world.
        """
        raise BlockError(
            _(
                "{type} has no read(self, body, view): it must return its reading",
                type=type(self).__name__,
            )
        )

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write one raw reading into ``out``; arrays are faster filled in place than by read."""
        out[...] = self._checked(self.read(body, view))

    def scale(self) -> Any:
        """Return the divisor of normalising; by default the largest bound, without its sign."""
        space = _as_box(self.space())
        if not isinstance(space, spaces.Box):
            return 1.0
        largest = np.maximum(np.abs(space.low), np.abs(space.high)).astype(np.float64)
        return np.where(np.isfinite(largest) & (largest > 0), largest, 1.0)

    def is_sentinel(self, reading: Any) -> bool:
        """Return True for a raw reading that means "nothing there" and is not normalised."""
        return False

    def slots(self) -> tuple[str, ...]:
        """Return display names of the numbers of one reading; empty if they have none."""
        return ()

    def spots(self) -> SpotPicture | None:
        """Return the places at which the last reading looked, to draw them; most have none."""
        return None

    def legend(self) -> Legend | None:
        """Return how to draw the reading as a picture; None if it is no picture."""
        return None

    # -- the path from a raw reading to the percept ----------------------------------------------

    def reading_kind(self) -> str:
        """Return AI4U's type of the reading: sfloat, sfloatarray, sbool, sint, sstring, ...

        Raises:
            BlockError: there is no such type, the space is of no kind that a sensor may have, or
                an attribute can't take effect on such readings.
        """
        kind = self._declared_kind()
        self._check_attributes(kind)
        if self._is_normalized() and kind in DTYPES and DTYPES[kind] is not np.float32:
            kind = "sfloatarray" if self.space().shape else "sfloat"
        return _ARRAY_KINDS.get(kind, kind) if self.stacked_observations > 1 else kind

    def _declared_kind(self) -> str:
        """Return AI4U's type of one reading as it is."""
        space = self.space()
        if not _can_be_read(space):
            raise BlockError(
                _(
                    "expected space() to return a Box, a Discrete or a Text (for texts a Tuple or "
                    "Sequence of Text), got {space}; for one number from 0 to 1 that is Box(0.0, "
                    "1.0, (1,))",
                    space=repr(space),
                )
            )
        if self.kind:
            if self.kind not in KINDS:
                raise BlockError(
                    _(
                        "no type of reading is called {kind}; {hint}",
                        kind=repr(self.kind),
                        hint=suggest(self.kind, KINDS),
                    )
                )
            return self.kind
        if isinstance(space, spaces.Box) and self.normalized:
            return "sfloatarray"
        if isinstance(space, spaces.Text):
            return "sstring"
        if isinstance(space, spaces.Tuple | spaces.Sequence):
            return "sstrings"
        if isinstance(space, spaces.Discrete):
            return "sint"
        if space.dtype == np.uint8:
            return "sbytearray"
        whole = space.dtype is not None and np.issubdtype(space.dtype, np.integer)
        return "sintarray" if whole else "sfloatarray"

    def _is_normalized(self) -> bool:
        """Return True if normalising changes the numbers; choices of 0 and 1 stay what they are."""
        space = self.space()
        return self.normalized and (
            isinstance(space, spaces.Box) or bool((np.asarray(self.scale()) != 1.0).any())
        )

    def _check_attributes(self, kind: str) -> None:
        """Raise a BlockError if an attribute can't take effect on readings of a type."""
        if kind in TEXTS:
            self._expect_none(_("texts are no numbers"), *NEUTRAL)
        if not self.stackable:
            self._expect_none(_("its readings don't stack"), "stacked_observations")
        if not isinstance(self.space(), spaces.Box):
            self._expect_none(_("choices can't be a little wrong; there is dropout"), "noise")

    def _expect_none(self, reason: str, *names: str) -> None:
        for name in names:
            if (value := getattr(self, name)) != NEUTRAL[name]:
                raise BlockError(
                    _(
                        "expected {name} {neutral} ({reason}), got {value}",
                        name=name,
                        neutral=NEUTRAL[name],
                        reason=reason,
                        value=value,
                    )
                )

    def observation_space(self) -> spaces.Space[Any]:
        """Return the space of the reading in the percept: normalised and stacked.

        Choices that are stacked or normalised are numbers there: their space is a Box.
        """
        space = self.space()
        if self.stacked_observations > 1 or self._is_normalized():
            space = _as_box(space)
        if not isinstance(space, spaces.Box):
            return space
        low, high = space.low, space.high
        check_memory(self, low.shape)
        if self.normalized:
            low, high = (
                each if self.is_sentinel(each) else np.asarray(each / self.scale())
                for each in (low, high)
            )
        if self.stacked_observations > 1:
            times = (self.stacked_observations, *([1] * low.ndim))
            low, high = np.tile(low, times), np.tile(high, times)
        dtype: Any = np.float32 if self._is_normalized() else space.dtype
        return spaces.Box(low.astype(dtype), high.astype(dtype), dtype=dtype)

    def attach(self, out: Array, get_rng: Callable[[], np.random.Generator]) -> None:
        """Prepare for an agent.

        Args:
            out: the reading's place in the agent's memory; every reading is written there.
            get_rng: returns the episode's generator for noise and dropout; called when needed.
        """
        space = self.space()
        self._out, self._get_rng, self._declared = out, get_rng, space
        shape = space.shape or ()
        self._raw = np.zeros(shape, np.float64 if out.dtype == np.float32 else out.dtype)
        self._past: deque[Array] = deque(maxlen=self.delay + 1)
        self._fresh = True
        self._ever_read = self._is_range_checked = False
        self._scale = np.broadcast_to(np.asarray(self.scale(), np.float64), shape)
        # dividing by 1 leaves a number as it is
        self._is_scaled = self._is_normalized() and bool((self._scale != 1.0).any())
        is_filtered = self.stacked_observations > 1 or self.noise or self.delay or self.dropout
        has_own_write = type(self).write is not Sensor.write
        self._reads_numbers = not has_own_write and out.dtype == np.float32 and bool(out.size)
        is_direct = not is_filtered and (self._reads_numbers or not self._is_scaled)
        self._read_into_memory = self._read_direct if is_direct else self._read_filtered
        if self._reads_numbers:
            self._memory = out.reshape(-1).data.cast("B")
            self._pack = Struct(f"={out.size}f").pack_into
            self._divisors = self._scale.ravel().tolist()

    def restart(self) -> None:
        """Begin an episode: the next reading fills stack and delay."""
        self._fresh = self.resetable or not self._ever_read

    def get_state(self) -> dict[str, Any]:
        """Return the readings that it keeps, besides all else that an episode changes."""
        state = super().get_state()
        if "_out" in vars(self):
            state["_out"] = self._out.copy()
        return state

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Take over the state of an equal sensor; its place in its agent's memory stays its own."""
        super().set_state({name: value for name, value in state.items() if name != "_out"})
        if "_out" in state:
            self._out[...] = state["_out"]

    def blank(self) -> None:
        """Replace the reading by zeros: the sensor is switched off."""
        self._out[...] = 0

    def take(self, body: BodyView, view: WorldView) -> None:
        """Take one reading and put it into the agent's memory.

        Raises:
            ReadingError: the reading does not fit the space; its range is checked once.
        """
        self._read_into_memory(body, view)
        if not self._is_range_checked:
            self._ever_read = True
            self._check_range()
            self._is_range_checked = True

    def _read_direct(self, body: BodyView, view: WorldView) -> None:
        """Put a reading into memory that needs no filter; same bits as _read_filtered."""
        if not self._reads_numbers:
            self.write(self._out, body, view)
            return
        # a few Python numbers are packed faster than put through arrays
        reading = self.read(body, view)
        numbers = (reading,) if type(reading) is float else reading
        try:
            fits = len(numbers) == len(self._divisors) and math.isfinite(sum(numbers))
        except TypeError:
            fits = False
        if not fits:
            numbers = self._checked(reading).ravel().tolist()
        if self._is_scaled and not self.is_sentinel(numbers):
            numbers = map(truediv, numbers, self._divisors)
        self._pack(self._memory, 0, *numbers)

    def _read_filtered(self, body: BodyView, view: WorldView) -> None:
        """Put a reading into memory with dropout, noise, delay, normalising and stacking."""
        is_lost = self.dropout and not self._fresh and self._get_rng().random() < self.dropout
        if not is_lost:
            self.write(self._raw, body, view)
        reading = self._raw
        if self.noise:
            space = self._declared
            reading = reading + self._get_rng().normal(0.0, self.noise, reading.shape)
            if isinstance(space, spaces.Box):
                reading = np.clip(reading, space.low, space.high)
        if self.delay:
            if self._fresh:
                self._past.clear()
            self._past.append(reading.copy())
            reading = self._past[0]
        if self._is_scaled and not self.is_sentinel(reading):
            reading = reading / self._scale
        self._stack(reading)
        self._fresh = False

    def _stack(self, reading: Array) -> None:
        out = self._out
        if self.stacked_observations == 1:
            out[...] = reading
        elif self._fresh:
            out[:] = reading
        else:
            out[:-1] = out[1:]
            out[-1] = reading

    def _unstack(self) -> None:
        """Make place for the newest reading to be put on the stack once more."""
        self._out[1:] = self._out[:-1].copy()

    def _checked(self, reading: Any) -> Array:
        shape = self._declared.shape or ()
        try:
            # numpy would make nan of None
            array = np.asarray("" if reading is None else reading, self._raw.dtype)
        except (TypeError, ValueError):
            self._refuse(_("numbers of shape {shape}", shape=str(shape)), repr(reading))
        if array.shape != shape and array.size == self._raw.size:
            array = array.reshape(shape)  # a plain number for (1,), a list for (m, n)
        if array.shape != shape:
            self._refuse(
                _("shape {shape} as its space() says", shape=str(shape)),
                _("shape {shape}", shape=str(array.shape)),
            )
        if not math.isfinite(array.sum()):
            self._refuse(_("finite numbers"), str(array.tolist()))
        return array

    def _check_range(self) -> None:
        space = self.observation_space()
        if isinstance(space, spaces.Box):
            slack = 1e-5 * (1 + np.abs(self._out))
            if (self._out < space.low - slack).any() or (self._out > space.high + slack).any():
                self._refuse(
                    _(
                        "numbers from {low:g} to {high:g} as its space() says",
                        low=float(space.low.min()),
                        high=float(space.high.max()),
                    ),
                    str(self._out.tolist()),
                )

    def _refuse(self, expected: str, got: str) -> None:
        raise ReadingError(
            _(
                "{type} {perception_key!r}: expected {expected}, got {got}",
                type=type(self).__name__,
                perception_key=self.perception_key,
                expected=expected,
                got=got,
            )
        )


def _as_box(space: spaces.Space[Any]) -> spaces.Space[Any]:
    """Return choices as the numbers that they are read as; any other space as it is."""
    match space:
        case spaces.Discrete():
            low, high = np.array(space.start), np.array(space.start + space.n - 1)
        case spaces.MultiDiscrete():
            low, high = space.start, space.start + space.nvec - 1
        case spaces.MultiBinary():
            low, high = np.zeros(space.shape), np.ones(space.shape)
        case _:
            return space
    return spaces.Box(low.astype(np.int32), high.astype(np.int32), dtype=np.int32)


def _can_be_read(space: object) -> bool:
    if isinstance(space, spaces.Tuple):
        return all(isinstance(each, spaces.Text) for each in space.spaces)
    if isinstance(space, spaces.Sequence):
        return isinstance(space.feature_space, spaces.Text)
    return isinstance(space, _SPACES)


def check_memory(sensor: Sensor, shape: tuple[int, ...]) -> None:
    """Raise a BlockError if a sensor's readings would need too much memory.

    Args:
        sensor: the sensor.
        shape: shape of one reading.
    """
    size, kept = math.prod(shape), sensor.stacked_observations + sensor.delay
    if size * kept > _MAX_KEPT_NUMBERS:
        raise BlockError(
            _(
                "{type} {perception_key!r}: expected at most {max_kept_numbers} numbers in the "
                "readings that it keeps, got {kept} of {size}; choose a lower resolution, or less "
                "of stacked_observations and delay",
                type=type(sensor).__name__,
                perception_key=sensor.perception_key,
                max_kept_numbers=_MAX_KEPT_NUMBERS,
                kept=kept,
                size=size,
            )
        )
