"""A reward for each time that a body is touched or left, or an area entered or left."""

from typing import ClassVar, Literal

from ai4u_edu.base.parameters import Name, Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class EventRewardFunc(RewardFunc):
    """Pays ``reward`` each time the agent comes to touch a body, or enters an area, or leaves it.

    A touch that lasts pays once, where it begins. The agent is in an area if its centre is; an area
    in which an episode begins was not entered. With ``only_one_time`` it pays once an episode.

    Example: +10 for each change from one half of the field to the other =
    ``EventRewardFunc(target="left_half", reward=10)`` and the same for "right_half", under another
    ``name``.

    Source: ours; AI4U's scenes do it with the signals OnTouch, body_entered and body_exited.
    """

    event: Literal["touch", "leave"] = "touch"
    """Event that pays: touch, which is to enter if the target is an area; or leave."""
    target: Name
    """Name of the body or area."""
    reward: Number = 1.0
    """Amount for each event."""
    only_one_time: bool = False
    """True pays once an episode, False each time."""

    carried: ClassVar[tuple[str, ...]] = ("_was_there", "_events", "_paid", "_happened")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the target."""
        view.check_target(self.target)
        self._is_area = self.target in view.areas

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget past events."""
        self._was_there: bool | None = None if self._is_area else False
        self._events = 0
        self._paid = self._happened = False

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Count an event; in each tick, since one may come back within a decision."""
        is_there = view.touching(body, self.target)
        if self._was_there is not None and is_there != self._was_there:
            self._events += is_there != (self.event == "leave")
        self._was_there = is_there

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward for all events of this decision."""
        events, self._events = self._events, 0
        self._happened = events > 0
        if self.only_one_time:
            events = int(self._happened and not self._paid)
        self._paid = self._paid or self._happened
        return self.reward * events

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if the event happened in this decision, paid or not."""
        return self._happened
