"""A reward, or cost, for falling."""

from typing import Annotated, ClassVar

from pydantic import Field

from ai4u_edu.base.parameters import MAX_COUNT, Metres, quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class FallReward(RewardFunc):
    """Pays ``success_reward`` for each decision after which the agent is below ``threshold``.

    It pays at most ``max_rewards`` times an episode, and ``fail_reward`` for every other decision.

    Source: AI4U's FallReward.

    Differs from AI4U: axis and isLocal don't exist here. Bodies fall along the world's z axis and
    never tip over.
    """

    threshold: Metres = 0.0
    """Height of the underside below which it counts as a fall."""
    success_reward: Annotated[float, quantity("")] = -1.0
    """Amount for a decision after which it is below the threshold."""
    fail_reward: Annotated[float, quantity("")] = 0.0
    """Amount for every other decision."""
    max_rewards: Annotated[int, Field(ge=1, le=MAX_COUNT)] = 1
    """Maximum number of payments of success_reward in an episode."""

    carried: ClassVar[tuple[str, ...]] = ("_paid",)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget past payments."""
        self._paid = 0

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward for a fall, or for none."""
        if self.is_below(body, view) and self._paid < self.max_rewards:
            self._paid += 1
            return self.success_reward
        return self.fail_reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if the agent is below the threshold, paid already or not."""
        return self.is_below(body, view)

    def is_below(self, body: BodyView, view: WorldView) -> bool:
        """Return True if the agent counts as fallen."""
        return body.z < self.threshold
