"""An actuator that drives a body by force."""

from typing import Annotated

from gymnasium.spaces import Box

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.world import Body


class ForceMoveActuator(Actuator):
    """Drives with two numbers: [forward, turn], each -1..1.

    - forward: times ``force`` is the force along the heading in newtons; < 0 is backward.
    - turn: times ``turn_amount`` is the turning speed in rad/s; > 0 turns right (clockwise seen
      from above), < 0 left.

    It sets a force, not a speed: a body accelerates over several ticks, drifts in curves, and rolls
    on without force until the world's damping stops it. With mass m and damping d (the share of its
    speed that a body keeps after a second) the final speed is about ``force / (m * -ln d)`` m/s. It
    acts only on the ground.

    Source: ours.
    """

    action_name: str = "move"
    force: Annotated[float, quantity("N", ge=0, le=1e6)] = 10.0
    """Force at full power."""
    turn_amount: Annotated[float, quantity("rad/s", ge=0, le=100)] = 3.0
    """Turning speed at full power."""

    def space(self) -> Box:
        """Return the range of [forward, turn]."""
        return Box(-1.0, 1.0, (2,))

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers."""
        return "forward", "turn"

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Apply the force for one tick, and set the turning speed."""
        if body.on_ground:
            forward, turn = action
            body.apply_force(forward * self.force, 0.0)
            body.set_angular_velocity(-turn * self.turn_amount)
