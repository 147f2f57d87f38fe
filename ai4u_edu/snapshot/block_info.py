"""Names, units and ranges of an agent's readings and actions."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.bound_blocks import BoundBlocks
from ai4u_edu.blocks import (
    Actuator,
    GridSensor,
    Legend,
    LinearRayCastingSensor,
    LocalGridSensor,
    OrientationSensor,
    Percept,
    RayPicture,
    RaySensor,
    Sensor,
    SpotPicture,
)
from ai4u_edu.blocks.actuators.ground_motion import GroundMotion
from ai4u_edu.blocks.sensors.ray_sensor import spread
from ai4u_edu.locale import gettext as _

MIN_VISIBLE = {"cosine": -1.0, "distance": 0.0}
"""Least readings of an OrientationSensor for a visible target."""

SLOT_WORDS = {
    ("BearingSensor", "sine"): _("left?"),
    ("BearingSensor", "cosine"): _("ahead?"),
    ("OrientationSensor", "cosine"): _("ahead?"),
    ("HeadingSensor", "sine"): _("north?"),
    ("HeadingSensor", "cosine"): _("east?"),
}
"""Names for people of numbers that mathematics names, by the sensor's class and the slot."""
WORDS = {
    str(word): word
    for word in (
        _("ahead"),
        _("angle"),
        _("blue"),
        _("brightness"),
        _("colour"),
        _("column"),
        _("cosine"),
        _("distance"),
        _("down"),
        _("forward"),
        _("forward jump"),
        _("green"),
        _("grip"),
        _("heard"),
        _("jump"),
        _("left"),
        _("move"),
        _("red"),
        _("right"),
        _("row"),
        _("sine"),
        _("speak"),
        _("steering"),
        _("strafe"),
        _("throttle"),
        _("turn"),
        _("turning"),
        _("width"),
    )
}
"""Names of numbers and actuators that are translated; others are shown as they are."""

POWERS = {
    "forward": ("move_amount",),
    "strafe": ("move_amount",),
    "turn": ("turn_amount",),
    "jump": ("jump_power",),
    "forward jump": ("jump_power", "jump_forward_power"),
}
"""Parameters of a GroundMotion that each number of its action is multiplied by."""

Floats = npt.NDArray[np.float64]


def in_words(name: str) -> str:
    """Return the name of a number for people."""
    words = name.replace("_", " ")
    return WORDS.get(words, words)


class Window(NamedTuple):
    """The part of the world that a picture from above shows."""

    size: tuple[float, float]
    """Metres, along and across the heading; along x and y for a fixed window."""
    centre: tuple[float, float] | None
    """Centre of a fixed window (m); None if the window moves and turns with the agent."""


@dataclass(frozen=True, slots=True)
class RayLayout:
    """The order of the numbers that a flat fan of rays reads."""

    angles_deg: tuple[float, ...]
    """Angle of each ray from the heading, positive to the left; the rightmost ray is first."""
    has_code: bool
    """True if a ray reads the code of what it hits; it comes before the distance."""
    has_distance: bool
    """True if a ray reads the distance to what it hits; 0 if it hits nothing."""
    codes: tuple[tuple[str, float], ...]
    """Name of each group, and its code in the reading."""
    reach: float
    """Largest distance in the reading: 1, or metres."""
    reach_m: float
    """Length of a ray, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class SensorInfo:
    """Description of one sensor's part of the percept."""

    key: str
    """Its perception key."""
    block: str
    """The sensor's class."""
    unit: str
    """Unit of a reading; empty if it is normalized, or has none."""
    slots: tuple[str, ...]
    """Names of one reading's numbers; empty if they have none."""
    low: Floats
    """Lower bound of each number of one reading."""
    high: Floats
    """Upper bound of each number of one reading."""
    stack: int
    """Number of stacked readings, oldest first."""
    targets: tuple[str, ...]
    """Names of the bodies and areas that it reads."""
    groups: tuple[str, ...]
    """Groups (tags) that it reads."""
    legend: Legend | None
    """Colours for showing the reading as a picture, if it is one."""
    window: Window | None
    """The part of the world that the picture shows, if it is one from above."""
    eye: tuple[float, float, float] | None
    """Position of a ray sensor's origin on the body: (forward, left, up), metres."""
    rays: RayLayout | None = None
    """Order of the numbers of a flat fan of rays."""

    @property
    def slot_words(self) -> tuple[str, ...]:
        """Names of one reading's numbers for people; empty if they have none."""
        return tuple(SLOT_WORDS.get((self.block, slot)) or in_words(slot) for slot in self.slots)


class Component(NamedTuple):
    """One number of an action."""

    name: str
    """Name; empty if it has none."""
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class ActuatorInfo:
    """Description of one actuator's part of the action."""

    name: str
    block: str
    """The actuator's class."""
    components: tuple[Component, ...]
    is_choice: bool
    """True if the number is one of several discrete choices."""
    without_effect: frozenset[str] = frozenset()
    """Names of the components that do nothing with its parameters, as a jump of power 0."""


class BlockInfo(NamedTuple):
    """Descriptions of an agent's sensors and actuators."""

    sensor_infos: tuple[SensorInfo, ...]
    actuator_infos: tuple[ActuatorInfo, ...]
    legends: Mapping[str, Legend]
    """Colours for showing readings as pictures, by perception key."""


class RayPictures(Mapping[str, RayPicture]):
    """Lazily made pictures of the rays of one percept, by perception key.

    Args:
        makers: functions that make the pictures.
    """

    def __init__(self, makers: Mapping[str, Callable[[], RayPicture]]) -> None:
        self._makers = makers
        self._made: dict[str, RayPicture] = {}

    def __getitem__(self, key: str) -> RayPicture:
        made = self._made.get(key)
        if made is None:
            made = self._made[key] = self._makers[key]()
        return made

    def __contains__(self, key: object) -> bool:
        return key in self._makers

    def __iter__(self) -> Iterator[str]:
        return iter(self._makers)

    def __len__(self) -> int:
        return len(self._makers)


class SensorPictures(NamedTuple):
    """Pictures of what sensors read for one percept, by perception key."""

    rays: Mapping[str, RayPicture]
    spots: dict[str, SpotPicture]


_info_cache: "WeakKeyDictionary[BoundBlocks, BlockInfo]" = WeakKeyDictionary()
_picture_cache: "WeakKeyDictionary[BoundBlocks, tuple[Percept, SensorPictures]]" = (
    WeakKeyDictionary()
)


def block_info_of(agent: BasicAgent) -> BlockInfo:
    """Return the description of an agent's blocks; cached until they are rebound."""
    bound = agent.bound_blocks
    known = _info_cache.get(bound)
    if known is None:
        senses = tuple(_sense(sensor) for sensor in bound.sensors)
        known = _info_cache[bound] = BlockInfo(
            senses,
            tuple(_control(actuator) for actuator in bound.actuators.values()),
            {sense.key: sense.legend for sense in senses if sense.legend is not None},
        )
    return known


def sensor_pictures_of(agent: BasicAgent) -> SensorPictures:
    """Return pictures of an agent's present percept; cached for each percept."""
    bound, percept = agent.bound_blocks, agent.percept
    known = _picture_cache.get(bound)
    if known is None or known[0] is not percept:
        active = [sensor for sensor in bound.sensors if sensor.is_active]
        spots = {sensor.perception_key: sensor.spots() for sensor in active}
        rays = RayPictures(
            {
                sensor.perception_key: sensor.capture()
                for sensor in active
                if isinstance(sensor, RaySensor)
            }
        )
        seen = SensorPictures(rays, {key: each for key, each in spots.items() if each is not None})
        known = _picture_cache[bound] = percept, seen
    return known[1]


def _sense(sensor: Sensor) -> SensorInfo:
    low, high = _range(sensor)
    slots = sensor.slots()
    return SensorInfo(
        key=sensor.perception_key,
        block=type(sensor).__name__,
        unit="" if sensor.normalized else sensor.unit,
        # names of the wrong number, from a student's sensor, are ignored
        slots=slots if len(slots) == len(low) else (),
        low=low,
        high=high,
        stack=sensor.stacked_observations,
        targets=_named(sensor, "target", "area"),
        groups=_named(sensor, "group", "target_group"),
        legend=sensor.legend(),
        window=_window(sensor),
        eye=sensor.eye if isinstance(sensor, RaySensor) else None,
        rays=_ray_layout_of(sensor),
    )


def _range(sensor: Sensor) -> tuple[Floats, Floats]:
    """Return the lower and upper bounds of one reading's numbers."""
    space = sensor.observation_space()
    if not isinstance(space, spaces.Box):
        high = float(space.n - 1) if isinstance(space, spaces.Discrete) else 1.0
        return np.zeros(1), np.full(1, high)
    count = space.low.size // sensor.stacked_observations
    ends: tuple[Any, Any] = (space.low, space.high)
    low, high_each = (each.ravel()[:count].astype(np.float64) for each in ends)
    if isinstance(sensor, OrientationSensor):  # its lowest values mean "not visible"
        low = np.array([MIN_VISIBLE[slot] for slot in sensor.slots()])
    return low, high_each


def _window(sensor: Sensor) -> Window | None:
    if isinstance(sensor, LocalGridSensor):
        side = sensor.cell_size
        return Window((sensor.height * side, sensor.width * side), None)
    if isinstance(sensor, GridSensor) and not sensor.around:
        side = sensor.cell_size
        return Window((sensor.columns * side, sensor.rows * side), sensor.centre)
    return None


def _named(block: object, *fields: str) -> tuple[str, ...]:
    found = (getattr(block, field, "") for field in fields)
    return tuple(name for name in found if isinstance(name, str) and name)


def _control(actuator: Actuator) -> ActuatorInfo:
    low, high = actuator.limits()
    slots = actuator.slots()
    names = slots if len(slots) == len(low) else ("",) * len(low)
    return ActuatorInfo(
        name=actuator.action_name,
        block=type(actuator).__name__,
        components=tuple(map(Component, names, low, high)),
        is_choice=isinstance(actuator.space(), spaces.Discrete),
        without_effect=frozenset(name for name in names if not _has_effect(actuator, name)),
    )


def _has_effect(actuator: Actuator, slot: str) -> bool:
    powers = POWERS.get(slot, ()) if isinstance(actuator, GroundMotion) else ()
    return not powers or any(getattr(actuator, power) > 0 for power in powers)


def _ray_layout_of(sensor: object) -> RayLayout | None:
    """Return the layout of a sensor's rays; None if it reads no flat fan."""
    if not isinstance(sensor, LinearRayCastingSensor):
        return None
    angles = np.degrees(spread(sensor.number_of_rays, sensor.field_of_view))
    largest = sensor.largest_code if sensor.normalized else 1.0
    return RayLayout(
        angles_deg=tuple((angles - sensor.horizontal_shift).round(2).tolist()),
        has_code=sensor.return_code,
        has_distance=sensor.return_distance,
        codes=tuple((name, code / largest) for name, code in sensor.group_code.items()),
        reach=sensor.farthest,
        reach_m=sensor.vision_max_distance,
    )
