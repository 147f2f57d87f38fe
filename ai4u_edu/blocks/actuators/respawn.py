"""An actuator that moves its body to a random pose at each reset."""

import math
from typing import Annotated, Any, ClassVar

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field, field_validator

from ai4u_edu.base.errors import shown
from ai4u_edu.base.parameters import Degrees, Metres
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import Body, WorldView

Pose = tuple[Metres, Metres, Degrees]


class RespawnActuator(Actuator):
    """Moves the agent to one of several poses at each reset, at rest, drawn from the world's seed.

    It takes no action. ``early`` is nearly always right: the agent is at its pose before it senses
    anything. With ``early`` off, the first percept still shows the position in the scene, as in an
    AI4U project with ``early`` off.

    Source: AI4U's RBRespawnActuator.

    Differs from AI4U: the places are ``poses``; there the children of the node respawnOptionsPath.
    ``randomise_heading`` is off; in its CBRespawnActuator radomizeDirection is on. There, early
    means before the other blocks' reset; here the world is rebuilt before any block is reset, and
    no block reads the world until all are. flipWhenTurn doesn't exist here.
    """

    action_name: str = "respawn"
    is_output: bool = False
    poses: Annotated[list[Pose], Field(min_length=1)]
    """Poses to choose from: (x, y, heading) of each, in metres and degrees."""
    early: bool = True
    """True moves the body before the first reading of the episode, False after it."""
    randomise_heading: bool = False
    """True draws a random heading instead of the pose's own."""

    carried: ClassVar[tuple[str, ...]] = ("last_selected",)

    @field_validator("poses", mode="before")
    @classmethod
    def _with_headings(cls, poses: Any) -> Any:
        """Say once what a pose is, and not of each of its numbers that it is missing."""
        if not isinstance(poses, list | tuple):
            return poses
        wrong = [
            (number, pose)
            for number, pose in enumerate(poses)
            if isinstance(pose, list | tuple) and len(pose) != 3
        ]
        if wrong:
            (number, pose), *others = wrong
            problem = _(
                "expected x, y, heading in degrees of each pose, as in [1, 2, 90], got {got} as "
                "pose {number}",
                got=shown(pose),
                number=number,
            )
            if others:
                problem = _("{problem}, and {more} more like it", problem=problem, more=len(others))
            raise ValueError(problem)
        return poses

    def __post_init__(self) -> None:
        super().__post_init__()
        self.last_selected = -1
        """Index of the last chosen pose."""
        self._told_by: AgentView | None = None

    def space(self) -> Box:
        """Return a space without numbers."""
        return Box(0.0, 1.0, (0,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Subscribe to the beginning of the episode if ``early`` is off."""
        if not self.early and self._told_by is not agent:
            agent.begin_of_episode.connect(self._on_begin)
            self._told_by = agent

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Move the body to a pose if ``early`` is on."""
        if self.early:
            self._put(agent, view)

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Do nothing."""

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
