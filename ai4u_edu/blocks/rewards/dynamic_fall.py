"""A reward, or cost, for falling below a reference body."""

from ai4u_edu.base.parameters import Metres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.fall import FallReward
from ai4u_edu.world import BodyView, WorldView


class DynamicFallReward(FallReward):
    """Pays ``success_reward`` for each decision after which the agent is far below a reference.

    Far means more than ``threshold`` metres below the reference body's present height: for worlds
    in which the ground itself moves up or down. An agent that fell out of the world also counts.

    It pays at most ``max_rewards`` times an episode, and ``fail_reward`` for every other decision.

    Source: AI4U's DynamicFallReward.
    """

    reference: str
    """Name of the body whose height counts."""
    threshold: Metres = 10.0
    """Height below the reference at which the agent counts as fallen."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the reference."""
        _ = view[self.reference]

    def is_below(self, body: BodyView, view: WorldView) -> bool:
        """Return True if the agent is far below the reference."""
        return body.fallen or body.z < view[self.reference].z - self.threshold
