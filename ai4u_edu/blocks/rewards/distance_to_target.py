"""A reward for being near a target."""

from ai4u_edu.base.parameters import Number, PositiveMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class DistanceToTargetRewardFunc(RewardFunc):
    """Pays ``max_reward`` within ``min_distance`` of the target, and less farther away.

    At a larger distance d it pays max_reward * (min_distance / d)², or max_reward * min_distance /
    d without ``square_inverse``: a hill with a flat top and a slope that reaches far. With the
    defaults that is 1 within 1 m, then 1 / d² (1 / d). It pays at every decision, so an agent earns
    most by coming quickly and staying.

    Source: AI4U's DistanceToTargetRewardFunc.

    Differs from AI4U: there min_distance is left out of the slope (so the reward jumps at that
    distance unless it is 1), and without the square it pays more the farther away the agent is.
    """

    target: str
    """Name of the body to approach."""
    max_reward: Number = 1.0
    """Amount within min_distance, for each decision."""
    min_distance: PositiveMetres = 1.0
    """Distance within which the full amount is paid."""
    square_inverse: bool = True
    """True: beyond, it falls with the square of the distance. False: with the distance."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        _ = view[self.target]

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward for the present distance."""
        distance = max(body.distance(view[self.target]), self.min_distance)
        share = self.min_distance / distance
        return self.max_reward * (share * share if self.square_inverse else share)

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if the agent is within min_distance, as in AI4U."""
        return body.distance(view[self.target]) <= self.min_distance
