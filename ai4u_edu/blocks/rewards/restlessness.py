"""A cost of standing still."""

import math
from typing import ClassVar, Literal

from ai4u_edu.base.parameters import NonNegativeMetres, Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class RestlessnessRewardFunc(RewardFunc):
    """Pays ``reward`` (a cost) for each decision in which the agent moved less than ``min_dist``.

    It compares the positions after this decision and the one before, including height; turning on
    the spot is standing still. The first decision of an episode is free. With a ``min_dist`` that
    no decision can reach, every decision but the first costs.

    Source: AI4U's RestlessnessRewardFunc2D.

    Differs from AI4U: each decision counts separately. There the position is compared with the last
    one at which the agent had moved enough, so small moves add up: moving 0.7 mm per decision costs
    at every second decision there, and at each one here. The first decision is not free there. Its
    3D version (with increseRate and decreaseRate) punishes moving.
    """

    min_dist: NonNegativeMetres = 0.001
    """Smallest displacement in a decision that counts as moving."""
    reward: Number = -0.001
    """Amount for each decision without moving; below 0 for a cost."""
    ignored_axis: Literal[-1, 0, 1] = -1
    """0 ignores motion along the world's x axis, 1 along y; -1 ignores none."""

    carried: ClassVar[tuple[str, ...]] = ("_place", "_stood_still")

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget the position."""
        self._place: tuple[float, ...] | None = None

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the cost of standing still, or 0."""
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
        """Return True if the agent stood still in this decision; never in the first one."""
        return self._stood_still
