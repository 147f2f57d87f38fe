"""An actuator with two wheels."""

from typing import Annotated

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.base.parameters import PositiveMetres, quantity
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.actuators.ground_motion import Speeds, apply_dead_zone, set_body_velocity
from ai4u_edu.world import Body


class DifferentialDriveActuator(Actuator):
    """Drives with two wheels: [left, right], each -1..1, times ``max_wheel_speed`` in m/s.

    The wheels are to the left and right of the centre, ``axle_width`` apart. At equal speeds the
    body drives straight ahead; at opposite speeds it turns on the spot. Otherwise the faster wheel
    is on the outside of the curve:

    - speed = (left + right) / 2, along the heading (m/s);
    - turning speed = (right - left) / axle_width, counter-clockwise (rad/s).

    Connect a light sensor to each wheel, straight or crossed, to build Braitenberg's vehicles. It
    acts only on the ground; wheels don't slip.

    Source: ours; after V. Braitenberg, "Vehicles: Experiments in Synthetic Psychology" (1984).
    """

    action_name: str = "move"
    max_wheel_speed: Annotated[float, quantity("m/s", gt=0, le=100)] = 1.0
    """Speed of a wheel at full power."""
    axle_width: PositiveMetres = 0.5
    """Distance between the two wheels."""

    def space(self) -> Box:
        """Return the range of [left, right]."""
        return Box(-1.0, 1.0, (2,), np.float32)

    def slots(self) -> tuple[str, ...]:
        """Return the names of the wheels."""
        return "left", "right"

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Set the body's velocity if it is on the ground."""
        if body.on_ground:
            set_body_velocity(body, *self._speeds(action))

    def _speeds(self, action: tuple[float, ...]) -> Speeds:
        left, right = (wheel * self.max_wheel_speed for wheel in apply_dead_zone(action))
        return (left + right) / 2, 0.0, (right - left) / self.axle_width
