"""Moves a body on the ground and makes it jump."""

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

    Speeds are set, not pushed to: all zeros stop the body. It acts only on the ground; in the air
    nothing steers. A jump of upward speed v rises v² / 2g high and lasts 2 v / g seconds.

    Source: AI4U's RBMoveActuator.

    Differs from AI4U: forward goes down to -1, there only to 0 (no way back). Speeds there carry a
    factor of 100/60 that ours leave out. The ground is any floor or body below, there only what is
    in floorGroup; collisionShapeHalfHeight has no place here. precision is fixed to 0.001.
    """

    def space(self) -> Box:
        """[forward, turn, jump, forward jump]."""
        low = np.array([-1, -1, 0, 0], np.float32)
        return Box(low, np.ones(4, np.float32))

    def slots(self) -> tuple[str, ...]:
        """As AI4U orders them."""
        return "forward", "turn", "jump", "forward jump"

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Sets the body's speeds, if it stands on the ground."""
        if body.on_ground:
            self.drive(body, *apply_dead_zone(action))
