"""Groups of a percept's numbers: single slots, rays, and whole sensors."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.blocks import CodeLegend, RayPicture, SpotPicture
from ai4u_edu.locale import Text, join
from ai4u_edu.locale import gettext as _
from ai4u_edu.snapshot.block_info import SensorInfo, block_info_of, sensor_pictures_of

Kind = Literal["slot", "sensor"]
KINDS = ("slot", "sensor")
MIN_SIDE = 0.3
"""Least size of a direction's sine or cosine for a side to be named: 17 degrees."""

Mask = npt.NDArray[np.bool_]


class Group(NamedTuple):
    """Numbers of one reading that are replaced together."""

    name: str
    """Name for people, as ``ray 7`` or ``orientation: ahead?``."""
    key: str
    """Perception key of the reading."""
    mask: Mask
    """(size,) True for each number of the flattened reading that belongs to it."""
    sees: str = ""
    """Group that a ray or an eye meets at this moment; ``nothing`` if none, empty for others."""
    says: str = ""
    """Clause on what it says at this moment, as ``the box is behind it``; empty for none."""


def slots_of(percept: Mapping[str, Any], keys: Iterable[str]) -> list[Group]:
    """Return a group for each single number of these readings.

    >>> [group.name for group in slots_of({"eyes": np.zeros(2), "speed": 1.0}, ["eyes", "speed"])]
    ['eyes 0', 'eyes 1', 'speed']
    """
    return [
        Group(f"{key} {index}" if size > 1 else key, key, np.arange(size) == index)
        for key in keys
        for size in [np.asarray(percept[key]).size]
        for index in range(size)
    ]


def sensors_of(percept: Mapping[str, Any], keys: Iterable[str]) -> list[Group]:
    """Return a group for each whole reading."""
    return [Group(key, key, np.ones(np.asarray(percept[key]).size, np.bool_)) for key in keys]


def groups_by(kind: Kind, percept: Mapping[str, Any], keys: Iterable[str]) -> list[Group]:
    """Return groups of one kind, with the names of keys and positions.

    Raises:
        SetupError: there is no such kind.
    """
    if kind not in KINDS:
        hint = suggest(str(kind), KINDS)
        raise SetupError(_("groups: {hint}; expected one of {kinds}", hint=hint, kinds=str(KINDS)))
    return slots_of(percept, keys) if kind == "slot" else sensors_of(percept, keys)


def groups_of_agent(agent: BasicAgent, *, whole: bool = False) -> list[Group]:
    """Return the groups of an agent's present percept, with names for people.

    A number with a name is a group, a ray's code and distance are one, and stacked readings of the
    same number are one, since a beginner sees them as one thing.

    Args:
        agent: its sensors with ``is_input`` count.
        whole: True adds each whole sensor, and all codes and all distances of its rays.
    """
    inputs = {each.perception_key for each in agent.bound_blocks.sensors if each.is_input}
    infos = [info for info in block_info_of(agent).sensor_infos if info.key in inputs]
    pictures = sensor_pictures_of(agent)
    return groups_of(infos, pictures.rays, pictures.spots, agent.percept, whole=whole)


def groups_of(
    infos: Sequence[SensorInfo],
    rays: Mapping[str, RayPicture],
    spots: Mapping[str, SpotPicture],
    percept: Mapping[str, Any],
    *,
    whole: bool = False,
) -> list[Group]:
    """Return the groups of sensors that are described, as :func:`groups_of_agent` does."""
    found: list[Group] = []
    for info in infos:
        parts = _parts(info, rays.get(info.key), spots.get(info.key), percept)
        found += parts
        if whole and len(parts) > 1:
            found += _wholes(info, rays.get(info.key))
    return found


def _parts(
    info: SensorInfo,
    picture: RayPicture | None,
    spots: SpotPicture | None,
    percept: Mapping[str, Any],
) -> list[Group]:
    if picture is not None:
        planes = _planes(info, len(picture.groups))
        if planes:
            return _rays(info, picture, planes)
    count = len(info.low)
    if spots is not None and not info.slots and len(spots.lit) == count:
        seen = info.groups[0] if info.groups else "something"
        return [
            _group(
                _("eye {number}", number=index + 1), info, [index], seen if is_lit else "nothing"
            )
            for index, is_lit in enumerate(spots.lit)
        ]
    names = info.slot_words or tuple(map(str, range(count)))
    return [
        _group(
            join([info.key, name], ": ") if count > 1 else info.key,
            info,
            [index],
            says=_says(info, name, index, percept),
        )
        for index, name in enumerate(names)
    ]


def _says(info: SensorInfo, name: str, index: int, percept: Mapping[str, Any]) -> str:
    """Return in a clause what a number says at this moment; empty for one without such words."""
    reading = np.asarray(percept[info.key])
    if reading.size != info.stack * len(info.low):
        return ""
    now = [float(each) for each in reading.reshape(info.stack, -1)[-1]]
    value, high = now[index], float(info.high[index])
    target = info.targets[0].replace("_", " ") if len(info.targets) == 1 else ""
    match info.block:
        case "BearingSensor" | "OrientationSensor" if target and name in _SIDES:
            is_seen = info.low[index] <= value and abs(value) <= 1
            return _side(name, value, target) if is_seen else ""
        case "BearingSensor" | "OrientationSensor" if target and name == "distance" and high > 0:
            return _third(value / high, _DISTANCES, target)
        case "PositionSensor" if target and name in ("forward", "left"):
            length = float(np.hypot(now[0], now[1])) or 1.0
            side = "ahead?" if name == "forward" else "left?"
            return _side(side, value / length, target)
        case "HeadingSensor" if name in _SIDES:
            return _side(name, value)
        case "HomeostaticSensor" if high > info.low[index]:
            share = (value - info.low[index]) / (high - info.low[index])
            return _third(share, _LEVELS, name)
        case _other:
            return ""


_SIDES = {
    "ahead?": (
        _("the {thing} is ahead of it"),
        _("the {thing} is behind it"),
        _("the {thing} is beside it"),
    ),
    "left?": (
        _("the {thing} is to its left"),
        _("the {thing} is to its right"),
        _("the {thing} is neither to its left nor to its right"),
    ),
    "east?": (_("it faces east"), _("it faces west"), _("it faces neither east nor west")),
    "north?": (_("it faces north"), _("it faces south"), _("it faces neither north nor south")),
}
"""Clauses for a direction's sine or cosine above 0, below 0 and near 0, by the number's name."""
_DISTANCES = (
    _("the {thing} is near"),
    _("the {thing} is not far"),
    _("the {thing} is far away"),
)
_LEVELS = _("its {thing} is low"), _("its {thing} is in the middle"), _("its {thing} is high")


def _side(name: str, value: float, thing: str = "") -> str:
    above, below, neither = _SIDES[name]
    words = neither if abs(value) < MIN_SIDE else above if value > 0 else below
    return Text(words.msgid, {"thing": thing})


def _third(share: float, thirds: tuple[Text, Text, Text], thing: str) -> str:
    low, middle, high = thirds
    words = low if share < 1 / 3 else middle if share < 2 / 3 else high
    return Text(words.msgid, {"thing": thing})


def _rays(info: SensorInfo, picture: RayPicture, planes: int) -> list[Group]:
    """Return a group for each ray, from the leftmost on."""
    count = len(picture.groups)
    found = []
    for name, ray in _ray_names(info, count):
        met = picture.groups[ray] or "nothing"
        met = "something" if met == "?" else met
        found.append(_group(name, info, _numbers(info, ray, count, planes), met))
    return found


def _ray_names(info: SensorInfo, count: int) -> list[tuple[str, int]]:
    """Return each ray's name, and its index in the picture."""
    if isinstance(info.legend, CodeLegend):
        rows, columns = info.legend.shape
        one = rows == 1
        return [
            (
                _("ray {number}", number=column + 1)
                if one
                else _("ray {number} of row {row}", number=column + 1, row=row + 1),
                row * columns + column,
            )
            for row in range(rows)
            for column in range(columns)
        ]
    # a fan reads its rightmost ray first
    return [(_("ray {number}", number=count - ray), ray) for ray in reversed(range(count))]


def _numbers(info: SensorInfo, ray: int, count: int, planes: int) -> list[int]:
    """Return the positions of a ray's numbers in one reading: its code, its distance, or both."""
    if isinstance(info.legend, CodeLegend):
        return [plane * count + ray for plane in range(planes)]
    return [planes * ray + plane for plane in range(planes)]


def _wholes(info: SensorInfo, picture: RayPicture | None) -> list[Group]:
    """Return a whole sensor, and of rays with both all codes and all distances."""
    count = len(info.low)
    found = [_group(_("all of {sensor}", sensor=info.key), info, range(count))]
    if picture is None or _planes(info, len(picture.groups)) != 2:
        return found
    half = count // 2
    codes = range(half) if isinstance(info.legend, CodeLegend) else range(0, count, 2)
    distances = sorted(set(range(count)) - set(codes))
    found.append(_group(_("all codes of {sensor}", sensor=info.key), info, codes))
    found.append(_group(_("all distances of {sensor}", sensor=info.key), info, distances))
    return found


def _planes(info: SensorInfo, rays: int) -> int:
    """Return how many numbers a ray has; 0 if that is not known."""
    return next((planes for planes in (1, 2) if rays and len(info.low) == planes * rays), 0)


def _group(
    name: str, info: SensorInfo, numbers: Iterable[int], sees: str = "", says: str = ""
) -> Group:
    mask = np.zeros(len(info.low), np.bool_)
    mask[list(numbers)] = True
    return Group(name, info.key, np.tile(mask, info.stack), sees, says)
