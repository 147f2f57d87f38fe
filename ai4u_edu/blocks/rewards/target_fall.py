"""A reward for the fall of another body."""

from typing import Annotated

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.fall import FallReward
from ai4u_edu.world import BodyView, WorldView


class TargetFallReward(FallReward):
    """Pays ``success_reward`` for each decision after which the target is below ``threshold``.

    Like FallReward, for another body: an opponent that was pushed out of a ring, a box that fell
    over the edge. A body that left the world also counts.

    It pays at most ``max_rewards`` times an episode, and ``fail_reward`` for every other decision.

    Source: ours.
    """

    target: str
    """Name of the body."""
    success_reward: Annotated[float, quantity("")] = 1.0
    """Amount for a decision after which the target is below the threshold."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        _ = view[self.target]

    def is_below(self, body: BodyView, view: WorldView) -> bool:
        """Return True if the target counts as fallen."""
        target = view[self.target]
        return target.fallen or target.z < self.threshold
