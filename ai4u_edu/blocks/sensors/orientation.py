"""Direction and distance of a target: the cosine of the angle to it, and how far it is."""

import math
from typing import Any, Literal

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.base.parameters import PositiveMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView

_SLOTS = {"angle": "cosine", "distance": "distance"}


class OrientationSensor(Sensor):
    """[cosine of the angle between heading and target, distance]: a share of max_distance, or m.

    The cosine is 1 where the target is straight ahead, 0 to either side, -1 behind: it can't tell
    left from right (BearingSensor can). The distance, from centre to centre, is divided by
    ``max_distance`` by default: 0 at the target, 1 at the end of the reach. With
    ``normalized=False`` it is in metres. Out of reach, or hidden: [-2, -1].

    Reading: (2,) for ``info="both"``: cosine -1..1, then distance 0..1 (with ``normalized=False``
    0..max_distance in metres). One of the two, (1,), for ``"angle"`` and ``"distance"``.

    Source: AI4U's OrientationSensor.

    Differs from AI4U: ``normalized`` is on, there it is off and the distance is in metres.
    ``max_distance`` covers the world unless it is given, there it is 1 m, which leaves the agent
    blind beyond. One-value modes read one number, there two. The visibility test always leaves the
    agent's own body out, looks 0.5 m above the underside of both bodies, and hides angle and
    distance alike: there are no parameters for excludeAgentFromVisibilityTest,
    verticalShiftForVisibility and ignoreVisibilityTestForAngle or -Dist. A script chooses another
    target by :meth:`set_target`.
    """

    target: str
    """Name of the body that is looked at."""
    reference: str = ""
    """Name of the body that looks; left out: the agent's own."""
    info: Literal["both", "angle", "distance"] = "both"
    """Numbers that are read: ``both``, or the cosine (``angle``) or the ``distance`` alone."""
    max_distance: PositiveMetres | None = None
    """Farthest distance at which the target is perceived; left out: across the whole world."""
    visibility_test: bool = False
    """True hides a target behind whatever stands in between."""
    normalized: bool = True

    def __post_init__(self) -> None:
        super().__post_init__()
        self._reach = self.max_distance or 1e4
        self._view: WorldView | None = None
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

    def is_sentinel(self, reading: Any) -> bool:
        """Whether it says "not to be seen"."""
        return bool(reading[-1] == (-2.0 if self.info == "angle" else -1.0))

    def set_target(self, target: str) -> None:
        """Looks at another body from the next reading on, also after a reset.

        Raises:
            NameNotFoundError: the agent is in a world, and no body there has that name.
        """
        if self._view is not None:
            _ = self._view[target]
        self.target = target

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Looks the target up and measures the world."""
        self._view = view
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
