"""A reward for a new smallest distance to a target."""

import math
from typing import Annotated, ClassVar

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class MinDistReward(RewardFunc):
    """Pays ``success_reward`` for a decision that brought the agent closer to the target than ever.

    "Ever" means in this episode; every other decision costs ``step_reward``. The first one is free.

    Source: AI4U's MinDistReward.
    """

    target: str
    """Name of the body to approach."""
    success_reward: Annotated[float, quantity("")] = 0.01
    """Amount for a decision that came closer than ever in this episode."""
    step_reward: Annotated[float, quantity("")] = -0.001
    """Amount for every other decision but the first; below 0 for a cost."""

    carried: ClassVar[tuple[str, ...]] = ("_best", "_is_best")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        _ = view[self.target]

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget the smallest distance."""
        self._best = math.inf

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward for a new smallest distance, or the cost of a step."""
        distance = body.distance(view[self.target])
        first = self._best == math.inf
        self._is_best = not first and distance < self._best
        if distance < self._best:
            self._best = distance
            return 0.0 if first else self.success_reward
        return self.step_reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if this decision gave a new smallest distance; the first one does not."""
        return self._is_best
