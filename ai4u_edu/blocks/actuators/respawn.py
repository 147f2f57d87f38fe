"""Puts a body at a random pose at each reset."""

from typing import Annotated

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.parameters import Degrees, Metres
from ai4u_edu.world import Body, WorldView

Pose = tuple[Metres, Metres, Degrees]


class RespawnActuator(Actuator):
    """Puts the agent at one of several poses at each reset, at rest, by the world's seed.

    It takes no action of its own.

    Source: AI4U's RespawnActuator.
    """

    action_name: str = "respawn"
    is_output: bool = False
    poses: Annotated[list[Pose], Field(min_length=1)]
    """(x, y, heading in degrees) of each place."""

    def space(self) -> Box:
        """Nothing."""
        return Box(0.0, 1.0, (0,))

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Chooses a pose."""
        index = int(view.random(f"actuator/{self.action_name}").integers(len(self.poses)))
        x, y, heading = self.poses[index]
        body = agent.body
        if isinstance(body, Body):
            body.move_to(x, y, heading=float(np.radians(heading)))

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Does nothing."""
