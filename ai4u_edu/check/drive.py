"""A driver that knows nothing: it tries out what its actuators take, from a seed."""

from typing import Any
from zlib import crc32

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import Actuator, Percept

HELD = 6
"""For so many decisions, on average, it goes on with what it does: else it would get nowhere."""

RESTING = 0.4
"""The chance that a number of an action is 0."""


class RandomDrive:
    """Acts at random; what one actuator gets doesn't depend on which others there are.

    Args:
        agent: whose actuators.
    """

    def __init__(self, agent: BasicAgent) -> None:
        self._agent = agent
        self.restart(0)

    def restart(self, seed: int) -> None:
        """Begins again, from a seed."""
        self._seed = seed
        self._chances: dict[str, np.random.Generator] = {}
        self._held: dict[str, Any] = {}

    def __call__(self, _percept: Percept) -> dict[str, Any]:
        """An action for every actuator that takes one."""
        for name, actuator in self._agent.fitting.actuators.items():
            if actuator.is_output:
                chance = self._chances.setdefault(
                    name, np.random.default_rng([self._seed, crc32(name.encode())])
                )
                if name not in self._held or chance.random() < 1 / HELD:
                    self._held[name] = _drawn(actuator, chance)
        return dict(self._held)


def _drawn(actuator: Actuator, chance: np.random.Generator) -> Any:
    low, high = actuator.limits()
    if not actuator.is_continuous:
        return int(chance.integers(int(low[0]), int(high[0]) + 1))
    rests = chance.random(len(low)) < RESTING
    # a number without bounds is tried out a little to either side of 0
    numbers = chance.uniform(np.maximum(low, -10.0), np.minimum(high, 10.0))
    return np.where(rests, np.clip(0.0, low, high), numbers).tolist()
