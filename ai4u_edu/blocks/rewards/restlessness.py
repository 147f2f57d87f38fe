"""Costs for standing still."""

import math
from typing import Literal

from ai4u_edu.base.parameters import NonNegativeMetres, Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class RestlessnessRewardFunc(RewardFunc):
    """Pays ``reward`` (a cost) for each decision in which the agent moved less than ``min_dist``.

    What counts is how far it is from where it was after the decision before, height included;
    turning on the spot is standing still. The first decision of an episode is free. A ``min_dist``
    that no decision can reach makes it a cost of every decision but the first.

    Source: AI4U's RestlessnessRewardFunc2D.

    Differs from AI4U: each decision stands alone. There the place is compared with the last one at
    which the agent had moved enough, so small ways add up: a crawl of 0.7 mm a decision costs at
    every second one there, and at each here. The first decision is not free there. Its 3D version
    (with increseRate and decreaseRate) punishes moving.
    """

    min_dist: NonNegativeMetres = 0.001
    """Shortest way in a decision that counts as moving."""
    reward: Number = -0.001
    """Amount for each decision without moving; below 0 for a cost."""
    ignored_axis: Literal[-1, 0, 1] = -1
    """0: moving along the world's x doesn't count; 1: along y; -1: all moving counts."""

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets where it was."""
        self._place: tuple[float, ...] | None = None

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """The cost of standing still, or 0."""
        before, self._place = self._place, body.pose[:3]
        self._stood_still = False
        if before is None:
            return 0.0
        moved = [now - then for now, then in zip(self._place, before, strict=True)]
        if self.ignored_axis >= 0:
            moved[self.ignored_axis] = 0.0
        self._stood_still = math.hypot(*moved) < self.min_dist
        return self.reward if self._stood_still else 0.0

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Tell whether the agent stood still in this decision; in the first one it did not."""
        return self._stood_still
