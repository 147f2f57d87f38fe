"""Pays for falling."""

from typing import Annotated

from pydantic import Field

from ai4u_edu.base.parameters import MAX_COUNT, Metres, quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class FallReward(RewardFunc):
    """Pays ``success_reward`` for each decision after which the agent is below ``threshold``.

    At most ``max_rewards`` times an episode; ``fail_reward`` for every other decision.

    Source: AI4U's FallReward.

    Differs from AI4U: axis and isLocal have no place here; bodies fall along the world's
    z and never tip over.
    """

    threshold: Metres = 0.0
    """Height of the underside below which it counts as a fall."""
    success_reward: Annotated[float, quantity("")] = -1.0
    """Amount for a decision after which it is below the threshold."""
    fail_reward: Annotated[float, quantity("")] = 0.0
    """Amount for every other decision."""
    max_rewards: Annotated[int, Field(ge=1, le=MAX_COUNT)] = 1
    """Most payments of success_reward in an episode."""

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets what was paid."""
        self._paid = 0

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """The reward for having fallen, or for not."""
        if self.is_below(body, view) and self._paid < self.max_rewards:
            self._paid += 1
            return self.success_reward
        return self.fail_reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Tell whether it is below, however often that was paid already."""
        return self.is_below(body, view)

    def is_below(self, body: BodyView, view: WorldView) -> bool:
        """Whether the agent is so low that it counts as fallen."""
        return body.z < self.threshold
