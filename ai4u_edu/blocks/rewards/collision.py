"""Costs for every tick in contact."""

from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class CollisionWithRewardFunc(RewardFunc):
    """Pays ``reward`` for each tick in which the agent touches a body of the group.

    Two of them at once count once. With ``group=""`` any body counts; floors are no bodies. A
    decision of five ticks, all of them along a wall, costs five times as much as one of one tick.

    Source: AI4U's CollisionWithRewardFunc.
    """

    group: str = ""
    """The tag of what is not to be touched; left out: anything."""
    reward: Number = -0.1
    """Amount for each tick in contact; below 0 for a cost."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the group."""
        if self.group:
            view.check_group(self.group)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets what was touched."""
        self._ticks = 0

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Look whether there is contact."""
        touched = view.contacts(body)
        if touched and (not self.group or any(self.group in view[name].tags for name in touched)):
            self._ticks += 1

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """The reward for all ticks of the decision."""
        ticks, self._ticks = self._ticks, 0
        self._touched = ticks > 0
        return ticks * self.reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Tell whether there was contact in any tick of the decision."""
        return self._touched
