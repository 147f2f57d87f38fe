"""Pays when several things are the case at once, or when any of them is."""

from collections.abc import Sequence
from typing import Annotated

from pydantic import Field

from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.eval_value import EvalValue
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class CombinedRewardFunc(RewardFunc):
    """The base of AndRewardFunc and OrRewardFunc: children that are asked at every decision.

    Each child is asked whether it holds, whatever it pays: see its ``holds``.
    """

    abstract = True

    children: Annotated[list[RewardFunc], Field(min_length=1)]
    """Reward functions and conditions that are asked; at least one."""
    reward: Number = 1.0
    """Amount for each decision after which it holds."""
    update_children: bool = False
    """Whether what the children pay is paid as well, under this one's name."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._children = list(self.children)

    def inner_blocks(self) -> Sequence[RewardFunc]:
        """Return the children that are active."""
        return [child for child in self.children if child.is_active]

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Sets the children up that are active."""
        self._children = list(self.inner_blocks())
        for child in self._children:
            child.on_setup(agent, view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Resets the children."""
        self._held = False
        for child in self._children:
            child.on_reset(agent, view)

    @property
    def has_ticks(self) -> bool:
        """Whether a child's on_tick is filled, or that of a class of one's own."""
        is_own = type(self).on_tick is not CombinedRewardFunc.on_tick
        return is_own or any(child.has_ticks for child in self.children)

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Passes the tick on."""
        for child in self._children:
            child.on_tick(body, view)

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """The reward, where the children hold; and theirs, if they are to be paid."""
        held, extra = [], 0.0
        for child in self._children:
            paid = child.on_update(body, view)
            held.append(child.holds(paid, body, view))
            extra += child.reward * held[-1] if isinstance(child, EvalValue) else paid
        self._held = self.combine(held)
        return self.reward * self._held + (extra if self.update_children else 0.0)

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Whether the children held: so one And can stand in another, whatever it pays."""
        return self._held

    def ends(self, paid: float) -> bool:
        """Tell whether the children held, as in AI4U: whatever is paid for it, even nothing."""
        return self._held

    def combine(self, held: list[bool]) -> bool:
        """Whether all of it holds, from whether each child does."""
        raise NotImplementedError  # And and Or have their own


class AndRewardFunc(CombinedRewardFunc):
    """Pays ``reward`` for each decision after which all of its children hold.

    A condition (EvalBoolValue and its like) holds where its property is as it should be. The other
    reward functions hold whatever they pay: TouchRewardFunc where the agent touched its target in
    the decision, DistanceToTargetRewardFunc within ``min_distance``, FallReward below its
    threshold; each says so in its ``holds``. Only this one's ``cause_episode_to_end`` counts, not
    the children's; it ends the episode where they hold, even with a reward of 0.

    Example: paid in the air above the goal = And(touch the goal, on_ground false).

    Source: AI4U's AndRewardFunc.
    """

    def combine(self, held: list[bool]) -> bool:
        """Whether all do; none at all do not."""
        return bool(held) and all(held)


class OrRewardFunc(CombinedRewardFunc):
    """Pays ``reward`` for each decision after which any of its children holds, once however many.

    When a child holds is the same as in AndRewardFunc. Only this one's ``cause_episode_to_end``
    counts, not the children's; it ends the episode where one holds, even with a reward of 0.
    Example: an end with -10 = Or(touch a spike, energy at 0).

    Source: AI4U's ORRewardFunc.
    """

    def combine(self, held: list[bool]) -> bool:
        """Whether one does."""
        return any(held)
