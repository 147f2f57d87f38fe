"""Where a target is: the cosine of the angle to it, and the distance."""

import math
from typing import Any, Literal

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.parameters import PositiveMetres
from ai4u_edu.world import BodyView, WorldView

_SLOTS = {"angle": "cosine", "distance": "distance"}


class OrientationSensor(Sensor):
    """[cosine of the angle between the heading and the direction to the target, distance in m].

    The cosine is 1 where the target is straight ahead, 0 to either side, -1 behind: it can't tell
    left from right (BearingSensor can). Out of reach, or hidden: [-2, -1].

    Reading: (2,) for ``info="both"``, else (1,). Normalised, the distance is divided by
    ``max_distance``.

    Source: AI4U's OrientationSensor; there ``max_distance`` is 1 m, which leaves the agent blind
    beyond; here it covers the world unless it is given.
    """

    target: str
    reference: str = ""
    """The body that looks; left out: the agent's own."""
    info: Literal["both", "angle", "distance"] = "both"
    max_distance: PositiveMetres | None = None
    visibility_test: bool = False
    """Whether something in between hides the target."""
    normalized: bool = True

    def __post_init__(self) -> None:
        super().__post_init__()
        self._reach = self.max_distance or 1e4
        self._part = {"both": slice(0, 2), "angle": slice(0, 1), "distance": slice(1, 2)}[self.info]

    def space(self) -> Box:
        """From [-2, -1] (not to be seen) to [1, max_distance]."""
        low = np.array([-2.0, -1.0], np.float32)[self._part]
        return Box(low, np.array([1.0, self._reach], np.float32)[self._part])

    def slots(self) -> tuple[str, ...]:
        """The parts of it that are read."""
        return ("cosine", "distance") if self.info == "both" else (_SLOTS[self.info],)

    def scale(self) -> Any:
        """The cosine stays; the distance is divided by max_distance."""
        return np.array([1.0, self._reach])[self._part]

    def says_nothing(self, reading: Any) -> bool:
        """Whether it says "not to be seen"."""
        return bool(reading[-1] == (-2.0 if self.info == "angle" else -1.0))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Looks the target up and measures the world."""
        _ = view[self.target]
        if self.reference:
            _ = view[self.reference]
        if self.max_distance is None:
            self._reach = view.diagonal()

    def read(self, body: BodyView, view: WorldView) -> tuple[float, ...]:
        """One reading."""
        looker = view[self.reference] if self.reference else body
        target = view[self.target]
        distance = looker.distance(target)
        hidden = self.visibility_test and not view.sees(looker, target)
        if distance > self._reach or hidden:
            reading: tuple[float, ...] = (-2.0, -1.0)
        elif self.info == "distance":
            return (distance,)
        else:
            reading = (math.cos(looker.bearing(target)), distance)
        return reading[self._part]
