"""Pays for touching."""

import math
from typing import Annotated

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.parameters import Seconds, quantity
from ai4u_edu.world import BodyView, WorldView


class TouchRewardFunc(RewardFunc):
    """Pays ``reward`` when the agent touches the target: a body, or an area (with its centre).

    With ``only_one_time`` once an episode; else again and again while or whenever they touch, but
    not before ``cool_down`` seconds have passed. A touch counts even if it began and ended in the
    middle of a decision.

    Source: AI4U's TouchRewardFunc.
    """

    target: str
    reward: Annotated[float, quantity("")] = 0.0
    only_one_time: bool = True
    cool_down: Seconds = 0.0

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Looks the target up."""
        view.check_target(self.target)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets what was paid."""
        self._since = view.ticks
        self._paid_at = -math.inf

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """The reward, or 0."""
        touched = view.touched_after(body, self.target, self._since)
        self._since = view.ticks
        self._touched = touched
        if not touched:
            return 0.0
        waits = math.inf if self.only_one_time else self.cool_down
        if self._paid_at != -math.inf and view.time - self._paid_at < waits:
            return 0.0
        self._paid_at = view.time
        return self.reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Tell whether the agent touched the target in this decision, paid or not."""
        return self._touched
