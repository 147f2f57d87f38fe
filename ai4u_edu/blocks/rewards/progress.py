"""A reward for every metre towards a target."""

from typing import ClassVar

from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class ProgressReward(RewardFunc):
    """Pays ``reward`` for each metre by which a decision brought the agent closer to the target.

    Moving away costs as much, so going back and forth earns nothing: an episode's payments add up
    to the distance after the first decision (which is free) minus the distance at the end.

    Source: ours; after Ng, Harada and Russell, "Policy invariance under reward transformations"
    (1999): the distance is a potential.
    """

    target: str
    """Name of the body to approach."""
    reward: Number = 1.0
    """Amount for each metre towards the target."""

    carried: ClassVar[tuple[str, ...]] = ("_distance", "_came_closer")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        _ = view[self.target]

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget the distance."""
        self._distance: float | None = None

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward for the change of distance."""
        before, self._distance = self._distance, body.distance(view[self.target])
        self._came_closer = before is not None and self._distance < before
        return 0.0 if before is None else self.reward * (before - self._distance)

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if this decision brought the agent closer; the first one does not."""
        return self._came_closer
