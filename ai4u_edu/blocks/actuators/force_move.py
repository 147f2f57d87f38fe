"""Pushes a body forward and turns it."""

from typing import Annotated

from gymnasium.spaces import Box

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.world import Body


class ForceMoveActuator(Actuator):
    """Drives with two numbers: [forward, turn], each -1..1.

    - forward: times ``force`` is a push along the heading in newtons; < 0 is backward.
    - turn: times ``turn_amount`` is the turning speed in rad/s; > 0 turns right (clockwise seen
      from above), < 0 left.

    The speed is not set but follows: a body picks it up over several ticks, drifts through a curve
    and rolls on when nobody pushes, as long as the world's damping lets it. With mass m and damping
    d (the share of its speed that it keeps for a second) it ends up at about
    ``force / (m * -ln d)`` m/s. It acts only on the ground.

    Source: ours.
    """

    action_name: str = "move"
    force: Annotated[float, quantity("N", ge=0, le=1e6)] = 10.0
    """Push at full power."""
    turn_amount: Annotated[float, quantity("rad/s", ge=0, le=100)] = 3.0
    """Turning speed at full power."""

    def space(self) -> Box:
        """[forward, turn]."""
        return Box(-1.0, 1.0, (2,))

    def slots(self) -> tuple[str, ...]:
        """Push and turn."""
        return "forward", "turn"

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Pushes for one tick, and sets how fast the body turns."""
        if body.on_ground:
            forward, turn = action
            body.apply_force(forward * self.force, 0.0)
            body.set_angular_velocity(-turn * self.turn_amount)
