"""An actuator that drives in any direction, with noise."""

from typing import Annotated

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.actuators.ground_motion import DEFAULT_DEAD_ZONE, GroundMotion, apply_dead_zone
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.world import Body, WorldView

Deviation = Annotated[float, quantity("1", ge=0, le=10)]


class CBMoveActuator(GroundMotion):
    """Drives with five numbers: [forward, strafe, turn, jump, forward jump].

    Like RBMoveActuator, and sideways too: strafe -1..1, times ``move_amount`` is the speed to the
    right in m/s. It moves in any direction without turning, like a robot on omni wheels.

    Real motors are not exact. With ``move_noise`` 0.1, "forward 0.5" becomes a new number in every
    tick, around 0.5 with a standard deviation of 0.1; likewise ``turn_noise``, and ``jump_noise``
    (which never makes a jump point down or back). 0 stays 0: a body at rest stays at rest. The
    noise comes from the world's seed, so it repeats with the same seed.

    Source: AI4U's CBMoveActuator.

    Differs from AI4U: ``move_amount`` is 1 m/s, there 10. ``turn_amount`` is a speed of 1 rad/s;
    there it is an angle of 20 degrees for each application. It always drives sideways and backward;
    there only with keepForward off. jumpForwardPower moves the body; there it is only signalled.
    The ranges are fixed (no actionRange), gravity is the world's, and velocityDump, extraActions,
    SpeedUp and the signal OnMoveStep have no counterpart.
    """

    dead_zone: Annotated[float, quantity("1", ge=0, le=1)] = DEFAULT_DEAD_ZONE
    """Numbers closer to 0 than this count as 0."""
    move_noise: Deviation = 0.0
    """Standard deviation of the noise on forward and strafe, as a share of full power."""
    turn_noise: Deviation = 0.0
    """Standard deviation of the noise on turn, as a share of full power."""
    jump_noise: Deviation = 0.0
    """Standard deviation of the noise on both jumps, as a share of full power."""

    def space(self) -> Box:
        """Return the range of [forward, strafe, turn, jump, forward jump]."""
        low = np.array([-1, -1, -1, 0, 0], np.float32)
        return Box(low, np.ones(5, np.float32))

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Get the random generator for the episode."""
        self._rng = view.random(f"{agent.id}/actuator/{self.action_name}")

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers, in AI4U's order."""
        return "forward", "strafe", "turn", "jump", "forward jump"

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Set the body's velocity if it is on the ground."""
        if not body.on_ground:
            return
        forward, strafe, turn, jump, forward_jump = apply_dead_zone(action, self.dead_zone)
        self.drive(
            body,
            self._with_noise(forward, self.move_noise),
            self._with_noise(turn, self.turn_noise),
            self._with_noise(jump, self.jump_noise),
            max(0.0, self._with_noise(forward_jump, self.jump_noise)),
            self._with_noise(strafe, self.move_noise),
        )

    def _with_noise(self, number: float, deviation: float) -> float:
        if not (number and deviation):
            return number
        return number + float(self._rng.normal(0.0, deviation))
