"""A sensor of the position of the agent or of a target."""

from typing import Literal

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView

MARGIN_M = 5.0
"""Distance (metres) beyond the world's bounds up to which a position is not clipped."""


class PositionSensor(Sensor):
    """[x, y, z] of the agent, or of a target: as shares of the world's size, or in metres.

    The target is a body, or an area (its centre, on the floor there).

    ``frame="global"`` is the world frame; ``"local"`` is the agent's own: forward, left, up. In it
    the agent itself is always at 0, 0, 0, so ``"local"`` needs a target.

    By default each number is divided by the largest one possible: in the global frame the world's
    bound on the axis plus 5 m (for z the larger of the two), in the local one the world's diagonal
    plus 5 m. With ``normalized=False`` they are in metres.

    Reading: (3,), each -1..1; with ``normalized=False`` in metres. Source: AI4U's PositionSensor.

    Differs from AI4U: ``frame`` is ``"global"``; there getLocal is on. ``"local"`` is relative to
    the agent; there to the parent node of the target. There everything is divided by 500.
    """

    target: str = ""
    """Name of a body or an area; left out: the agent itself."""
    frame: Literal["global", "local"] = "global"
    """``global``: from the world's origin; ``local``: from the agent (needs a target)."""
    normalized: bool = True
    unit = "m"

    def __post_init__(self) -> None:
        super().__post_init__()
        self._far = np.full(3, 1e4, np.float32)

    def space(self) -> Box:
        """Return the range of the world's size plus a margin."""
        return Box(-self._far, self._far)

    def slots(self) -> tuple[str, ...]:
        """Return the axes of the frame."""
        return ("x", "y", "z") if self.frame == "global" else ("forward", "left", "up")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target and measure the world."""
        if self.frame == "local" and not self.target:
            raise BlockError(
                _(
                    'frame="local" is the way to a target, seen from the agent: expected a target, '
                    'got none; name one, or take frame="global" for the place of the agent itself'
                )
            )
        if self.target:
            view.check_target(self.target)
        (left, low), (right, high) = view.bounds()
        if self.frame == "local":
            across = view.diagonal() + MARGIN_M
            self._far = np.full(3, across, np.float32)
        else:
            x, y = max(abs(left), abs(right)) + MARGIN_M, max(abs(low), abs(high)) + MARGIN_M
            self._far = np.array([x, y, max(x, y)], np.float32)

    def read(self, body: BodyView, view: WorldView) -> tuple[float, ...]:
        """Return the reading."""
        area = view.areas.get(self.target)
        if area is None:
            target = view[self.target] if self.target else body
            (x, y), z = target.position, target.z
        else:
            x, y, z = area.x, area.y, view.ground(area.x, area.y) or 0.0
        place = (x, y, z)
        if self.frame == "local":
            place = (*body.to_local(x, y), z - body.z)
        return tuple(np.clip(place, -self._far, self._far))
