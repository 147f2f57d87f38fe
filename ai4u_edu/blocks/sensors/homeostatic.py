"""A sensor of the agent's internal variables."""

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.homeostatic import find_homeostatic_reward
from ai4u_edu.blocks.sensors.sensor import Array, Sensor
from ai4u_edu.world import BodyView, WorldView


class HomeostaticSensor(Sensor):
    """The levels of the agent's internal variables.

    0 is the bottom of a variable's range, 1 its top. The variables belong to the HomeostaticReward
    with the name ``source``, and are read in its order.

    Reading: (number of variables,), each 0..1. Source: ours.
    """

    source: str = "homeostatic"
    """Name of the reward function that has the variables."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the source."""
        self._variables = find_homeostatic_reward(agent, self.source).variables

    def space(self) -> Box:
        """Return the range 0..1 for each variable."""
        return Box(0.0, 1.0, (len(self._variables),))

    def slots(self) -> tuple[str, ...]:
        """Return the variables' names."""
        return tuple(variable.name for variable in self._variables)

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Write the reading into ``out``."""
        out[:] = np.array([variable.normalised() for variable in self._variables])
