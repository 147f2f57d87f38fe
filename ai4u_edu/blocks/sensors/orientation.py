"""A sensor of the direction and distance of a target."""

import math
from typing import Any, ClassVar, Literal

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.base.parameters import PositiveMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.world import BodyView, WorldView

_SLOTS = {"angle": "cosine", "distance": "distance"}


class OrientationSensor(Sensor):
    """[cosine of the angle between heading and target, distance]: a share of max_distance, or m.

    The cosine is 1 if the target is straight ahead, 0 to either side, -1 behind: it can't tell left
    from right (a BearingSensor can). The distance, from centre to centre, is divided by
    ``max_distance`` by default: 0 at the target, 1 at the largest distance. With
    ``normalized=False`` it is in metres. A target that is too far away or hidden reads [-2, -1].

    Reading: (2,) for ``info="both"``: cosine -1..1, then distance 0..1 (with ``normalized=False``
    0..max_distance in metres). One of the two, (1,), for ``"angle"`` and ``"distance"``.

    Source: AI4U's OrientationSensor.

    Differs from AI4U: ``normalized`` is on; there it is off and the distance is in metres.
    ``max_distance`` covers the world by default; there it is 1 m, and the agent is blind beyond.
    One-value modes read one number, there two. The visibility test always leaves out the agent's
    own body, looks 0.5 m above the underside of both bodies, and hides both angle and distance:
    there are no parameters for excludeAgentFromVisibilityTest, verticalShiftForVisibility and
    ignoreVisibilityTestForAngle or -Dist. A script changes the target with :meth:`set_target`.
    """

    target: str
    """Name of the body that is looked at."""
    reference: str = ""
    """Name of the body from which to look; left out: the agent's own."""
    info: Literal["both", "angle", "distance"] = "both"
    """Numbers to read: ``both``, only the cosine (``angle``), or only the ``distance``."""
    max_distance: PositiveMetres | None = None
    """Largest distance at which the target is perceived; left out: across the whole world."""
    visibility_test: bool = False
    """True hides a target behind any other body."""
    normalized: bool = True

    carried: ClassVar[tuple[str, ...]] = ("target",)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._reach = self.max_distance or 1e4
        self._view: WorldView | None = None
        self._part = {"both": slice(0, 2), "angle": slice(0, 1), "distance": slice(1, 2)}[self.info]

    def space(self) -> Box:
        """Return the range from [-2, -1] (not seen) to [1, max_distance]."""
        low = np.array([-2.0, -1.0], np.float32)[self._part]
        return Box(low, np.array([1.0, self._reach], np.float32)[self._part])

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers that are read."""
        return ("cosine", "distance") if self.info == "both" else (_SLOTS[self.info],)

    def scale(self) -> Any:
        """Return the divisors: 1 for the cosine, max_distance for the distance."""
        return np.array([1.0, self._reach])[self._part]

    def is_sentinel(self, reading: Any) -> bool:
        """Return True if the reading means "not seen"."""
        return bool(reading[-1] == (-2.0 if self.info == "angle" else -1.0))

    def set_target(self, target: str) -> None:
        """Change the target from the next reading on; a reset keeps it.

        Raises:
            NameNotFoundError: no body in the agent's world has that name.
        """
        if self._view is not None:
            _ = self._view[target]
        self.target = target

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target and measure the world."""
        self._view = view
        _ = view[self.target]
        if self.reference:
            _ = view[self.reference]
        if self.max_distance is None:
            self._reach = view.diagonal()

    def read(self, body: BodyView, view: WorldView) -> tuple[float, ...]:
        """Return the reading."""
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
