"""Names and units of the single numbers of a sensor's reading and of an actuator's action."""

import math
from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any, NamedTuple

from gymnasium import spaces

from ai4u_edu.blocks import Actuator, Sensor
from ai4u_edu.blocks.sensors.composite import FloatArrayCompositeSensor
from ai4u_edu.blocks.sensors.linear_ray_casting import LinearRayCastingSensor
from ai4u_edu.blocks.sensors.orientation import OrientationSensor
from ai4u_edu.blocks.sensors.ray_casting import RayCastingSensor
from ai4u_edu.blocks.sensors.ray_sensor import RaySensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join


class Label(NamedTuple):
    """Name and unit of one number; the unit is empty for shares, codes and counts."""

    name: str
    unit: str


def labels_of_reading(sensor: Sensor) -> list[Label]:
    """Return a label for each number of a reading in the percept, in C order.

    A reading of several decisions (``stacked_observations``) or of a past one (``delay``) has the
    age of each number in its name: ``forward, now`` or ``forward, 2 decisions ago``.
    """
    space = sensor.observation_space()
    found = _labels_of_one(sensor)
    frames = sensor.stacked_observations
    if frames > 1 or sensor.delay:
        ages = reversed(range(sensor.delay, sensor.delay + frames))  # the oldest comes first
        found = [Label(join([name, _age(age)], ", "), unit) for age in ages for name, unit in found]
    if len(found) == count_of(space):
        return found
    # a sensor of one's own may not do as its parameters say
    return [Label(name, "") for name in indices(space.shape or ())][: count_of(space)]


def labels_of_action(actuator: Actuator) -> list[Label]:
    """Return a label for each number of an action; numbers of an action have no unit."""
    space = actuator.space()
    if isinstance(space, spaces.Discrete):
        return [Label("choice", "")]
    return [Label(name, "") for name in _names(actuator.slots(), space)]


def count_of(space: spaces.Space[Any]) -> int:
    """Return the count of numbers in a value of a space; text has none."""
    is_array = isinstance(space, spaces.Box | spaces.MultiBinary | spaces.MultiDiscrete)
    return math.prod(space.shape or ()) if is_array else int(isinstance(space, spaces.Discrete))


def indices(shape: tuple[int, ...]) -> list[str]:
    """Return the names of numbers that have no other than their place in an array.

    >>> indices((2,)), indices((1, 2)), indices(())
    (['[0]', '[1]'], ['[0, 0]', '[0, 1]'], ['value'])
    """
    if math.prod(shape) == 1:
        return ["value"]
    return [str(list(place)) for place in product(*map(range, shape))]


def _age(decisions: int) -> str:
    if decisions == 0:
        return _("now")
    return (
        _("1 decision ago")
        if decisions == 1
        else _("{decisions} decisions ago", decisions=decisions)
    )


def _labels_of_one(sensor: Sensor) -> list[Label]:
    """Return the labels of one reading, before it is stacked."""
    if isinstance(sensor, RaySensor):
        return list(_ray_labels(sensor))
    if isinstance(sensor, FloatArrayCompositeSensor):
        return [
            Label(join([child.perception_key, name], ": "), "" if _is_scaled(sensor) else unit)
            for child in sensor.inner_blocks()
            for name, unit in labels_of_reading(child)
        ]
    names = _names(sensor.slots(), sensor.space())
    return list(map(Label, names, _units(sensor, len(names))))


def _is_scaled(sensor: FloatArrayCompositeSensor) -> bool:
    return sensor.normalize or sensor.normalized


def _names(slots: Sequence[str], space: spaces.Space[Any]) -> list[str]:
    """Return the block's own names, or indices where it has none, or a wrong number of them."""
    count = count_of(space)
    return list(slots) if len(slots) == count else indices(space.shape or ())[:count]


def _units(sensor: Sensor, count: int) -> list[str]:
    if sensor.normalized:
        return [""] * count
    if isinstance(sensor, OrientationSensor):
        return ["m" if name == "distance" else "" for name in sensor.slots()]
    each = sensor.unit.split(", ")
    return each if len(each) == count else [sensor.unit] * count


def _ray_labels(sensor: RaySensor) -> Iterator[Label]:
    code = Label("code", "")
    distance = Label("distance", "" if sensor.normalize_distance else "m")
    parts = [code] * sensor.return_code + [distance] * sensor.return_distance
    if isinstance(sensor, LinearRayCastingSensor):
        for ray, part in product(range(sensor.number_of_rays), parts):
            yield Label(_("{name}, ray {ray}", name=part.name, ray=ray), part.unit)
    elif isinstance(sensor, RayCastingSensor):
        for plane, row, column in product(parts, range(sensor.rows), range(sensor.columns)):
            yield Label(
                _("{name}, row {row}, column {column}", name=plane.name, row=row, column=column),
                plane.unit,
            )
