"""A sensor of the agent's internal variables."""

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.homeostatic import keeper_of
from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.world import BodyView, WorldView


class HomeostaticSensor(Sensor):
    """The agent's internal variables: how full each one is.

    0 is the bottom of a variable's range, 1 its top. The variables live in the HomeostaticReward
    called ``source``, and are read in its order.

    Reading: (number of variables,), each 0..1. Source: ours.
    """

    source: str = "homeostatic"
    """The name of the reward function that keeps the variables."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Looks the source up."""
        self._variables = keeper_of(agent, self.source).variables

    def space(self) -> Box:
        """One number a variable."""
        return Box(0.0, 1.0, (len(self._variables),))

    def slots(self) -> tuple[str, ...]:
        """The variables' names."""
        return tuple(variable.name for variable in self._variables)

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """One reading."""
        out[:] = np.array([variable.normalised() for variable in self._variables])
