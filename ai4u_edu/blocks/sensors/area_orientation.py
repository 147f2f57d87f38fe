"""A sensor of the kind, direction and nearness of the nearest bodies."""

import math
from typing import Annotated, ClassVar

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import BlockError, NameNotFoundError, suggest
from ai4u_edu.base.parameters import MAX_COUNT, Name, PositiveMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.groups import check_groups
from ai4u_edu.blocks.sensors.ray_sensor import Code
from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView


class AreaOrientationSensor(Sensor):
    """[kind, cosine, nearness] of each of the nearest bodies around: like a sense of smell.

    It reports the bodies with the tag ``target_group`` whose centre is inside ``area`` and within
    ``radius`` of the agent (or of ``reference``). Without either limit the whole world counts.

    - kind: the body's code in ``group_code``, divided by ``max_code_value``: 0..1.
    - cosine: of the angle between the heading and the direction to the body: -1..1.
    - nearness: 1 up to ``min_distance``, beyond it min_distance / distance: 0..1.

    The nearest body comes first; at equal distance, the first in alphabetical order. The rest of
    the reading is filled with zeros (a body's nearness is never 0).

    Reading: (3 * max_detection_reported,). Source: AI4U's AreaOrientationSensor.

    Differs from AI4U: the reading is one row of numbers; there its shape is (3, 20). ``area`` and
    ``reference`` may be left out; ``radius`` is ours. There is no collision mask.
    """

    perception_key: str = "areasensor"
    area: str = ""
    """Name of the area in which bodies are reported; left out: everywhere."""
    radius: PositiveMetres | None = None
    """Largest distance of a body that is reported; left out: any distance."""
    reference: str = ""
    """Name of the body from which to look; left out: the agent's own."""
    max_detection_reported: Annotated[int, Field(ge=1, le=500)] = 20
    """Maximum number of bodies that are reported, nearest first."""
    min_distance: PositiveMetres = 1.0
    """Distance up to which the nearness is 1."""
    target_group: str = "EMITTER"
    """Tag of the bodies that are reported."""
    group_code: dict[Name, Code] = Field(default_factory=dict)
    """Code of each group (tag), 0..max_code_value; a body without a code reads 0. Of a body's
    tags, the first that has a code counts."""
    max_code_value: Annotated[int, Field(ge=1, le=MAX_COUNT)] = 100
    """Code that reads as 1; no code may be larger."""
    visibility_test: bool = True
    """True hides a body behind any other body."""

    looks_at: ClassVar[tuple[str, ...]] = ("bodies",)

    def __post_init__(self) -> None:
        super().__post_init__()
        for group, code in self.group_code.items():
            if code > self.max_code_value:
                raise BlockError(
                    _(
                        "{type} {perception_key!r}: group_code: expected codes up to "
                        "max_code_value ({max_code_value}), got {code} for {group}",
                        type=type(self).__name__,
                        perception_key=self.perception_key,
                        max_code_value=self.max_code_value,
                        code=code,
                        group=repr(group),
                    )
                )

    def space(self) -> Box:
        """Return the ranges of [kind, cosine, nearness] for each body that can be reported."""
        low = np.tile(np.array([0.0, -1.0, 0.0], np.float32), self.max_detection_reported)
        return Box(low, np.ones_like(low))

    def slots(self) -> tuple[str, ...]:
        """Return three names for each body that can be reported."""
        return tuple(
            f"{part} {number}"
            for number in range(1, self.max_detection_reported + 1)
            for part in ("kind", "cosine", "nearness")
        )

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the area, the reference and the groups."""
        if self.area and self.area not in view.areas:
            raise NameNotFoundError(
                _(
                    "no area is named {area}; {hint}",
                    area=repr(self.area),
                    hint=suggest(self.area, view.areas),
                )
            )
        if self.reference:
            _place = view[self.reference]
        view.check_group(self.target_group)
        check_groups(self, "group_code", view)

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write the reading into ``out``."""
        looker = view[self.reference] if self.reference else body
        found: list[float] = []
        for distance, other in self._around(looker, view):
            if self.visibility_test and not view.sees(looker, other):
                continue
            near = max(distance, self.min_distance)
            found += self._kind(other), math.cos(looker.bearing(other)), self.min_distance / near
            if len(found) == len(out):
                break
        out[: len(found)] = found
        out[len(found) :] = 0.0

    def _around(self, looker: BodyView, view: WorldView) -> list[tuple[float, BodyView]]:
        """Return (distance, body) of all bodies that may be reported, nearest first."""
        area = view.areas[self.area] if self.area else None
        reach = math.inf if self.radius is None else self.radius
        found = []
        for name in view.named(self.target_group):
            other = view[name]
            if other is looker or other.fallen:
                continue
            distance = looker.distance(other)
            if distance <= reach and (area is None or area.contains(*other.position)):
                found.append((distance, other))
        return sorted(found, key=lambda each: (each[0], each[1].name))

    def _kind(self, other: BodyView) -> float:
        for tag in other.tags:
            if tag in self.group_code:
                return self.group_code[tag] / self.max_code_value
        return 0.0
