"""A cost of contact."""

from typing import ClassVar

from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class CollisionWithRewardFunc(RewardFunc):
    """Pays ``reward`` for each tick in which the agent touches a body of the group.

    Touching two of them at once counts once. With ``group=""`` any body counts; floors are not
    bodies. A decision of five ticks in contact costs five times as much as one of one tick.

    Source: AI4U's CollisionWithRewardFunc.
    """

    group: str = ""
    """Tag of the bodies that must not be touched; left out: any body."""
    reward: Number = -0.1
    """Amount for each tick in contact; below 0 for a cost."""

    carried: ClassVar[tuple[str, ...]] = ("_ticks", "_touched")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the group."""
        if self.group:
            view.check_group(self.group)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget past contacts."""
        self._ticks = 0

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Count the ticks in contact."""
        touched = view.contacts(body)
        if touched and (not self.group or any(self.group in view[name].tags for name in touched)):
            self._ticks += 1

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward for all ticks of the decision."""
        ticks, self._ticks = self._ticks, 0
        self._touched = ticks > 0
        return ticks * self.reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if there was contact in any tick of the decision."""
        return self._touched
