"""An actuator that drives on the ground and jumps."""

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.blocks.actuators.ground_motion import GroundMotion, apply_dead_zone
from ai4u_edu.world import Body


class RBMoveActuator(GroundMotion):
    """Drives with four numbers: [forward, turn, jump, forward jump].

    - forward: -1..1, times ``move_amount`` is the speed along the heading in m/s; < 0 is backward.
    - turn: -1..1, times ``turn_amount`` is the turning speed in rad/s; > 0 turns right (clockwise
      seen from above), < 0 left.
    - jump: 0..1, times ``jump_power`` is the upward speed in m/s.
    - forward jump: 0..1, adds ``jump_forward_power`` m/s forward and ``jump_power`` m/s upward.

    It sets speeds directly: all zeros stop the body. It acts only on the ground; in the air the
    agent can't steer. A jump of upward speed v rises v² / 2g high and lasts 2 v / g seconds.

    Source: AI4U's RBMoveActuator.

    Differs from AI4U: forward goes down to -1; there only to 0 (no backward motion). Speeds there
    have a factor of 100/60 that is left out here. The ground is any floor or body below; there only
    members of floorGroup. collisionShapeHalfHeight doesn't exist here. precision is fixed to 0.001.
    """

    def space(self) -> Box:
        """Return the range of [forward, turn, jump, forward jump]."""
        low = np.array([-1, -1, 0, 0], np.float32)
        return Box(low, np.ones(4, np.float32))

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers, in AI4U's order."""
        return "forward", "turn", "jump", "forward jump"

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Set the body's velocity if it is on the ground."""
        if body.on_ground:
            self.drive(body, *apply_dead_zone(action))
