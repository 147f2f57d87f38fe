"""A reward for bodies that leave the world."""

from typing import ClassVar

from ai4u_edu.base.parameters import Name, Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc, Stages
from ai4u_edu.world import BodyView, WorldView


class GoneReward(RewardFunc):
    """Pays ``reward`` for each body of the group that leaves the world.

    A body leaves when it is collected (CollectActuator) or falls over an edge, whoever caused it. A
    body that came back can leave again. With ``only_last`` it pays only when none of the group is
    left.

    Example: +1 for each dirty place that was cleaned, and the end with +10 when all are clean =
    ``GoneReward(group="dirty")`` and
    ``GoneReward(name="all", group="dirty", only_last=True, reward=10, cause_episode_to_end=True)``.

    Source: ours.
    """

    group: Name
    """Tag of the bodies that count."""
    reward: Number = 1.0
    """Amount for each body that leaves."""
    only_last: bool = False
    """True pays only when none of the group is left."""

    carried: ClassVar[tuple[str, ...]] = ("_there", "_gone", "_went")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the group."""
        view.check_group(self.group)
        self._targets = tuple(view.named(self.group))

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Store which bodies are in the world."""
        self._there = self._look(view)
        self._gone = 0

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Count the bodies that left; in each tick, since one may come back within a decision."""
        before, self._there = self._there, self._look(view)
        gone = sum(name not in self._there for name in before)
        self._gone += int(gone > 0 and not self._there) if self.only_last else gone

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward for all bodies that left in this decision."""
        gone, self._gone = self._gone, 0
        self._went = gone > 0
        return self.reward * gone

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if a body left in this decision; with only_last, if the last one did."""
        return self._went

    def stages(self) -> Stages:
        """Return how many bodies of the group are gone now."""
        total = len(self._targets)
        there = self._there
        return Stages(total - len(there), total, self._targets, there, there)

    def _look(self, view: WorldView) -> tuple[str, ...]:
        return tuple(name for name in view.named(self.group) if not view[name].fallen)
