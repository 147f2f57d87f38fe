"""An actuator that drives like a car."""

import math
from typing import Annotated

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.base.parameters import PositiveMetres, quantity
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.actuators.ground_motion import Speeds, apply_dead_zone, set_body_velocity
from ai4u_edu.world import Body


class CarActuator(Actuator):
    """Drives like a car, with two numbers: [throttle, steering].

    - throttle: -1..1, times ``max_speed`` is the speed of the rear wheels along the heading in m/s;
      < 0 is backward.
    - steering: -1..1, times ``max_steering_deg`` is the angle of the front wheels; > 0 to the
      right, < 0 to the left.

    The axles are ``wheelbase`` apart, with the body's centre in the middle. A car turns only while
    it rolls: with the front wheels at an angle a, the centre of the rear axle moves on a circle of
    radius wheelbase / tan(a), never sideways. To get into a narrow space, one has to plan ahead or
    to back up.

    It sets the speed directly: throttle 0 stops the car. It acts only on the ground; wheels don't
    slip.

    Source: ours; the usual kinematic model of a car ("bicycle model").
    """

    action_name: str = "move"
    max_speed: Annotated[float, quantity("m/s", gt=0, le=100)] = 2.0
    """Speed of the rear wheels at full throttle."""
    max_steering_deg: Annotated[float, quantity("deg", gt=0, le=80)] = 35.0
    """Angle of the front wheels at full steering."""
    wheelbase: PositiveMetres = 1.5
    """Distance between the axles."""

    def space(self) -> Box:
        """Return the range of [throttle, steering]."""
        return Box(-1.0, 1.0, (2,), np.float32)

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers."""
        return "throttle", "steering"

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Set the body's velocity if it is on the ground."""
        if body.on_ground:
            set_body_velocity(body, *self._speeds(action))

    def _speeds(self, action: tuple[float, ...]) -> Speeds:
        throttle, steering = apply_dead_zone(action)
        speed = throttle * self.max_speed
        angle = -steering * math.radians(self.max_steering_deg)
        turning = speed * math.tan(angle) / self.wheelbase
        return speed, turning * self.wheelbase / 2, turning
