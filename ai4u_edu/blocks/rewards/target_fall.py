"""Pays when somebody else falls."""

from typing import Annotated

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.fall import FallReward
from ai4u_edu.world import BodyView, WorldView


class TargetFallReward(FallReward):
    """Pays ``success_reward`` for each decision after which the target is below ``threshold``.

    As FallReward, but it is another body that falls: an opponent that was pushed out of a ring, a
    box that went over the edge. What has left the world is below anything.

    At most ``max_rewards`` times an episode; ``fail_reward`` for every other decision.

    Source: ours.
    """

    target: str
    """The body's name."""
    success_reward: Annotated[float, quantity("")] = 1.0
    """Amount for a decision after which the target is below the threshold."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        _ = view[self.target]

    def is_below(self, body: BodyView, view: WorldView) -> bool:
        """Whether the target is so low that it counts as fallen."""
        target = view[self.target]
        return target.fallen or target.z < self.threshold
