"""A reward for touching a target."""

import math
from typing import Annotated, ClassVar

from ai4u_edu.base.parameters import Seconds, quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class TouchRewardFunc(RewardFunc):
    """Pays ``reward`` when the agent touches the target: a body, or an area (with its centre).

    With ``only_one_time`` it pays once an episode; else at every decision with contact, at most
    once in ``cool_down`` seconds. A touch that began and ended within a decision counts too.

    ``cause_episode_to_end`` ends an episode only when something is paid. With ``reward=0``, the
    default, this never happens: a touch that should end the episode needs a reward, however small.

    Source: AI4U's TouchRewardFunc.

    Differs from AI4U: ``cool_down`` is 0; there it is _collisionCheckInterval, 5 s (in 2D 0.2 s).
    The signal OnTouch is the agent's event ``touched``, for all bodies.
    """

    target: str
    """Name of the body or area to touch."""
    reward: Annotated[float, quantity("")] = 0.0
    """Amount that is paid; with 0 it never ends the episode."""
    only_one_time: bool = True
    """True pays once an episode, False at every decision with contact."""
    cool_down: Seconds = 0.0
    """Time after a payment in which nothing is paid; 0 pays at every decision with contact."""

    carried: ClassVar[tuple[str, ...]] = ("_since", "_paid_at", "_touched")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        view.check_target(self.target)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget past payments."""
        self._since = view.ticks
        self._paid_at = -math.inf

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward, or 0."""
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
        """Return True if the agent touched the target in this decision, paid or not."""
        return self._touched
