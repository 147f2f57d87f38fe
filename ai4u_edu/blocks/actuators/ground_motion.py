"""The base of actuators that drive on the ground and jump."""

import math
from typing import Annotated

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.world import Body

Speeds = tuple[float, float, float]
"""(forward, left, turning) in a body's own frame: m/s, m/s, rad/s (counter-clockwise positive)."""

DEFAULT_DEAD_ZONE = 0.001
"""Numbers closer to 0 than this count as 0."""


class GroundMotion(Actuator):
    """The parameters of driving and jumping at full power.

    It sets speeds directly: all zeros stop the body. It acts only on the ground; in the air the
    agent can't steer. A jump of upward speed v rises v² / 2g high and lasts 2 v / g seconds.
    """

    abstract = True

    action_name: str = "move"
    move_amount: Annotated[float, quantity("m/s", ge=0, le=100)] = 1.0
    """Speed over the ground at full power."""
    turn_amount: Annotated[float, quantity("rad/s", ge=0, le=100)] = 1.0
    """Turning speed at full power."""
    jump_power: Annotated[float, quantity("m/s", ge=0, le=100)] = 1.0
    """Upward speed of a jump at full power."""
    jump_forward_power: Annotated[float, quantity("m/s", ge=0, le=100)] = 1.0
    """Forward speed that a forward jump adds at full power."""

    def drive(
        self,
        body: Body,
        forward: float,
        turn: float,
        jump: float,
        forward_jump: float,
        strafe: float = 0.0,
    ) -> None:
        """Set the velocity of a body on the ground.

        Args:
            body: the body.
            forward: share of ``move_amount``; below 0 backward.
            turn: share of ``turn_amount``; above 0 to the right (clockwise seen from above).
            jump: share of ``jump_power``.
            forward_jump: share of ``jump_forward_power`` forward and of ``jump_power`` upward.
            strafe: share of ``move_amount``; above 0 to the right.
        """
        set_body_velocity(body, *self._speeds(forward, turn, forward_jump, strafe))
        if jump or forward_jump:
            body.jump((jump + forward_jump) * self.jump_power)

    def _speeds(self, forward: float, turn: float, forward_jump: float, strafe: float) -> Speeds:
        ahead = forward * self.move_amount + forward_jump * self.jump_forward_power
        return ahead, -strafe * self.move_amount, -turn * self.turn_amount


def set_body_velocity(body: Body, forward: float, left: float, turning: float) -> None:
    """Set a body's velocity in its own frame: m/s, m/s, rad/s (counter-clockwise positive)."""
    heading = body.heading
    cos, sin = math.cos(heading), math.sin(heading)
    body.set_velocity(forward * cos - left * sin, forward * sin + left * cos)
    body.set_angular_velocity(turning)


def apply_dead_zone(
    numbers: tuple[float, ...], dead_zone: float = DEFAULT_DEAD_ZONE
) -> tuple[float, ...]:
    """Replace the numbers of an action that are close to 0 by 0.

    >>> apply_dead_zone((0.5, -0.0005))
    (0.5, 0.0)
    """
    return tuple([0.0 if abs(number) < dead_zone else number for number in numbers])
