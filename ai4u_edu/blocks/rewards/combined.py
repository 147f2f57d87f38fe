"""Rewards that combine conditions by "and" and "or"."""

from collections.abc import Sequence
from typing import Annotated, ClassVar

from pydantic import Field

from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.eval_value import EvalValue
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class CombinedRewardFunc(RewardFunc):
    """The base of AndRewardFunc and OrRewardFunc: it evaluates its children at every decision.

    A child counts if its ``holds`` returns True, whatever it pays.
    """

    abstract = True

    children: Annotated[list[RewardFunc], Field(min_length=1)]
    """Reward functions and conditions to combine; at least one."""
    reward: Number = 1.0
    """Amount for each decision after which it holds."""
    update_children: bool = False
    """True also pays what the children pay, under this one's name."""

    carried: ClassVar[tuple[str, ...]] = ("_held",)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._children = list(self.children)

    def inner_blocks(self) -> Sequence[RewardFunc]:
        """Return the children that are active."""
        return [child for child in self.children if child.is_active]

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Set up the active children."""
        self._children = list(self.inner_blocks())
        for child in self._children:
            child.on_setup(agent, view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Reset the children."""
        self._held = False
        for child in self._children:
            child.on_reset(agent, view)

    @property
    def has_ticks(self) -> bool:
        """True if a child, or this class, overrides on_tick."""
        is_own = type(self).on_tick is not CombinedRewardFunc.on_tick
        return is_own or any(child.has_ticks for child in self.children)

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Call the children's on_tick."""
        for child in self._children:
            child.on_tick(body, view)

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward if the children hold; add theirs with ``update_children``."""
        held, extra = [], 0.0
        for child in self._children:
            paid = child.on_update(body, view)
            held.append(child.holds(paid, body, view))
            extra += child.reward * held[-1] if isinstance(child, EvalValue) else paid
        self._held = self.combine(held)
        return self.reward * self._held + (extra if self.update_children else 0.0)

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if the children held, so that one And can be a child of another."""
        return self._held

    def ends(self, paid: float) -> bool:
        """Return True if the children held, even if nothing is paid, as in AI4U."""
        return self._held

    def combine(self, held: list[bool]) -> bool:
        """Combine the children's results into one."""
        raise NotImplementedError  # And and Or have their own


class AndRewardFunc(CombinedRewardFunc):
    """Pays ``reward`` for each decision after which all of its children hold.

    A condition (such as EvalBoolValue) holds if its property has the wanted value. Other reward
    functions hold independently of what they pay: TouchRewardFunc if the agent touched its target
    in the decision, DistanceToTargetRewardFunc within ``min_distance``, FallReward below its
    threshold; see each one's ``holds``. Only this one's ``cause_episode_to_end`` counts, not the
    children's; it ends the episode when they hold, even with a reward of 0.

    Example: a reward in the air above the goal = And(touch the goal, on_ground false).

    Source: AI4U's AndRewardFunc.
    """

    def combine(self, held: list[bool]) -> bool:
        """Return True if there are children and all of them hold."""
        return bool(held) and all(held)


class OrRewardFunc(CombinedRewardFunc):
    """Pays ``reward`` for each decision after which at least one of its children holds.

    A child holds under the same conditions as in AndRewardFunc. Only this one's
    ``cause_episode_to_end`` counts, not the children's; it ends the episode when one holds, even
    with a reward of 0.
    Example: an end with -10 = Or(touch a spike, energy at 0).

    Source: AI4U's ORRewardFunc.
    """

    def combine(self, held: list[bool]) -> bool:
        """Return True if a child holds."""
        return any(held)
