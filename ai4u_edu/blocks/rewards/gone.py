"""Pays for what is gone."""

from ai4u_edu.base.parameters import Name, Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class GoneReward(RewardFunc):
    """Pays ``reward`` for each body of the group that goes out of the world.

    It was collected (CollectActuator), or it fell over an edge; who did it does not matter. What
    comes back can go again. With ``only_last`` it pays for the last one alone: when none of the
    group is left.

    Example: +1 for each dirty place that is clean, and the end with +10 when all are =
    ``GoneReward(group="dirty")`` and
    ``GoneReward(name="all", group="dirty", only_last=True, reward=10, cause_episode_to_end=True)``.

    Source: ours.
    """

    group: Name
    """Tag of the bodies that are watched."""
    reward: Number = 1.0
    """Amount for each one that goes."""
    only_last: bool = False
    """True pays only when none of the group is left."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the group."""
        view.check_group(self.group)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Look who is there."""
        self._there = self._look(view)
        self._gone = 0

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Look who went: it may come back before the decision is over."""
        before, self._there = self._there, self._look(view)
        gone = sum(name not in self._there for name in before)
        self._gone += int(gone > 0 and not self._there) if self.only_last else gone

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """The reward for all that went in this decision."""
        gone, self._gone = self._gone, 0
        self._went = gone > 0
        return self.reward * gone

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Tell whether one went in this decision; with only_last, whether the last one did."""
        return self._went

    def _look(self, view: WorldView) -> tuple[str, ...]:
        return tuple(name for name in view.named(self.group) if not view[name].fallen)
