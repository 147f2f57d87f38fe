"""Puts a body at a random pose at each reset."""

import math
from typing import Annotated, Any

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.parameters import Degrees, Metres
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.world import Body, WorldView

Pose = tuple[Metres, Metres, Degrees]


class RespawnActuator(Actuator):
    """Puts the agent at one of several poses at each reset, at rest, by the world's seed.

    It takes no action of its own. ``early`` is right nearly always: the agent is in its place
    before it senses anything. Late, its first percept still shows the place where the scene puts
    its body, as in an AI4U project that has ``early`` off.

    Source: AI4U's RBRespawnActuator.

    Differs from AI4U: the places are ``poses``, there the children of the node respawnOptionsPath.
    ``randomise_heading`` is off, in its CBRespawnActuator radomizeDirection is on. There early
    means before the other blocks' reset; here the world is built anew before any block is reset,
    and no block looks at the world until all are. flipWhenTurn has no place here.
    """

    action_name: str = "respawn"
    is_output: bool = False
    poses: Annotated[list[Pose], Field(min_length=1)]
    """Places to choose from: (x, y, heading) of each, in metres and degrees."""
    early: bool = True
    """True moves the body before the first reading of the episode, False after it."""
    randomise_heading: bool = False
    """True draws the heading as well, out of all there are, in place of the pose's own."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.last_selected = -1
        """Which of the poses the last one was, counted from 0."""
        self._told_by: AgentView | None = None

    def space(self) -> Box:
        """Nothing."""
        return Box(0.0, 1.0, (0,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Listens for the beginning of the episode, if that is its moment."""
        if not self.early and self._told_by is not agent:
            agent.begin_of_episode.connect(self._on_begin)
            self._told_by = agent

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Chooses a pose."""
        if self.early:
            self._put(agent, view)

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Does nothing."""

    def _on_begin(self, agent: Any) -> None:
        if self.is_active and any(each is self for each in agent.actuators):  # still on the agent
            self._put(agent, agent.view)

    def _put(self, agent: AgentView, view: WorldView) -> None:
        rng = view.random(f"actuator/{self.action_name}")
        self.last_selected = int(rng.integers(len(self.poses)))
        x, y, degrees = self.poses[self.last_selected]
        heading = float(np.radians(degrees))
        if self.randomise_heading:
            heading = float(rng.uniform(-math.pi, math.pi))
        body = agent.body
        if isinstance(body, Body):
            body.move_to(x, y, heading=heading)
