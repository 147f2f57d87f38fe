"""A controller that draws random actions from the actuators' spaces."""

from typing import Any
from zlib import crc32

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import Actuator, Percept

MEAN_DECISIONS_HELD = 6
"""Mean number of decisions for which an action is kept: new ones each time would cancel out."""

ZERO_PROBABILITY = 0.4
"""Probability that a component of an action is 0."""


class RandomDrive:
    """A random controller; one actuator's actions don't depend on which others there are.

    Args:
        agent: the agent whose actuators it drives.
    """

    def __init__(self, agent: BasicAgent) -> None:
        self._agent = agent
        self.restart(0)

    def restart(self, seed: int) -> None:
        """Start again from a seed."""
        self._seed = seed
        self._rngs: dict[str, np.random.Generator] = {}
        self._held: dict[str, Any] = {}

    def __call__(self, _percept: Percept) -> dict[str, Any]:
        """Return an action for every actuator that takes one."""
        for name, actuator in self._agent.bound_blocks.actuators.items():
            if actuator.is_output:
                rng = self._rngs.setdefault(
                    name, np.random.default_rng([self._seed, crc32(name.encode())])
                )
                if name not in self._held or rng.random() < 1 / MEAN_DECISIONS_HELD:
                    self._held[name] = _drawn(actuator, rng)
        return dict(self._held)


def _drawn(actuator: Actuator, rng: np.random.Generator) -> Any:
    low, high = actuator.limits()
    if not actuator.is_continuous:
        return int(rng.integers(int(low[0]), int(high[0]) + 1))
    rests = rng.random(len(low)) < ZERO_PROBABILITY
    # an unbounded component is drawn from -10..10
    numbers = rng.uniform(np.maximum(low, -10.0), np.minimum(high, 10.0))
    return np.where(rests, np.clip(0.0, low, high), numbers).tolist()
