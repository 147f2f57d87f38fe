"""Description of an environment's numbers: which sensor or actuator each one belongs to."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.agent import BasicAgent
from ai4u_edu.learn.envs.element_names import Label, count_of, labels_of_action, labels_of_reading
from ai4u_edu.learn.envs.spaces_of import outputs_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext, translate

MAX_LINES = 200
"""Longest list of numbers that is shown of one sensor, as text."""


@dataclass(frozen=True, slots=True)
class Element:
    """One number of an observation or an action."""

    index: int
    """Place in the flat observation; in a dict, place in the value of that key in C order."""
    key: str
    """The sensor's perception key, or the actuator's action name."""
    element: str
    """Name of the number, with its age where the sensor stacks or delays its readings."""
    unit: str
    """Its unit; empty for a normalised reading, a share, a code or a count."""
    low: float
    """Lowest value."""
    high: float
    """Highest value."""


@dataclass(frozen=True)
class EnvDescription:
    """Every number of an environment's observations and actions; as text, a table of them."""

    observations: tuple[Element, ...]
    """The numbers of an observation, in their order."""
    actions: tuple[Element, ...]
    """The numbers of an action, in their order."""

    @property
    def by_sensor(self) -> dict[str, tuple[Element, ...]]:
        """The numbers of an observation by perception key; text has none."""
        return _by_key(self.observations)

    @property
    def by_actuator(self) -> dict[str, tuple[Element, ...]]:
        """The numbers of an action by action name."""
        return _by_key(self.actions)

    def __str__(self) -> str:
        """Return a table of the observation and one of the action."""
        readings = _table(_("sensor"), self.by_sensor.values())
        return f"{readings}\n\n{_table(_('actuator'), self.by_actuator.values())}"


def describe_agent(
    agent: BasicAgent, space: spaces.Space[Any], action_space: spaces.Space[Any]
) -> EnvDescription:
    """Return the description of an agent's observations and actions.

    Args:
        agent: its sensors with ``is_input`` are observed, its actuators with ``is_output`` driven.
        space: the observation space, in any form: its bounds are those of the description.
        action_space: the action space.
    """
    sensors = {
        sensor.perception_key: sensor for sensor in agent.bound_blocks.sensors if sensor.is_input
    }
    labels = {key: labels_of_reading(sensor) for key, sensor in sensors.items()}
    done = {name: labels_of_action(actuator) for name, actuator in outputs_of(agent).items()}
    return EnvDescription(tuple(_elements(labels, space)), tuple(_elements(done, action_space)))


def _elements(labels: Mapping[str, Sequence[Label]], space: spaces.Space[Any]) -> Iterable[Element]:
    if isinstance(space, spaces.Dict):
        for key, part in space.items():
            yield from _elements({key: labels[key]}, part)
        return
    low, high = _bounds(space)
    found = [(key, *label) for key, each in labels.items() for label in each]
    for index, (label, least, most) in enumerate(
        zip(found, low.tolist(), high.tolist(), strict=True)
    ):
        yield Element(index, *label, float(least), float(most))


def _bounds(space: spaces.Space[Any]) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Return the lowest and the highest value of each number of a space, in C order."""
    if isinstance(space, spaces.Box):
        return space.low.ravel(), space.high.ravel()
    if isinstance(space, spaces.Discrete):
        start = np.array([space.start])
        return start, start + int(space.n) - 1
    if isinstance(space, spaces.MultiDiscrete):
        start = np.ravel(space.start)
        return start, start + np.ravel(space.nvec) - 1
    if isinstance(space, spaces.MultiBinary):
        return np.zeros(count_of(space)), np.ones(count_of(space))
    return np.zeros(0), np.zeros(0)


def _by_key(elements: Iterable[Element]) -> dict[str, tuple[Element, ...]]:
    found: dict[str, list[Element]] = {}
    for each in elements:
        found.setdefault(each.key, []).append(each)
    return {key: tuple(each) for key, each in found.items()}


def _table(heading: str, groups: Iterable[Sequence[Element]]) -> str:
    head = (_("index"), heading, _("element"), _("unit"), _("low"), _("high"))
    rows = [tuple(map(translate, head))]
    for group in groups:
        for each in group[:MAX_LINES]:
            low, high = f"{each.low:g}", f"{each.high:g}"
            element = translate(each.element)
            rows.append((str(each.index), each.key, element, each.unit, low, high))
        if len(group) > MAX_LINES:
            more = translate(ngettext("{n} more", "{n} more", len(group) - MAX_LINES))
            rows.append(("...", group[0].key, more, "", "", ""))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    aligned = "  ".join(f"{{:{side}{width}}}" for side, width in zip("><<<>>", widths, strict=True))
    return "\n".join(aligned.format(*row) for row in rows)
