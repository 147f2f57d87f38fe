"""A reward for a body in an area."""

from typing import ClassVar

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView


class BodyInAreaRewardFunc(RewardFunc):
    """Pays ``reward`` when the centre of a body lies in an area: a box pushed home, a ball in goal.

    It pays whoever brought the body there: with ``only_one_time`` once an episode, else for each
    decision after which the body lies there.

    Source: ours.
    """

    thing: str
    """Name of the body."""
    area: str
    """Name of the area."""
    reward: Number = 1.0
    """Amount that is paid."""
    only_one_time: bool = True
    """True pays once an episode, False for each decision after which the body lies there."""

    carried: ClassVar[tuple[str, ...]] = ("_paid", "_inside")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the body and the area."""
        _ = view[self.thing]
        check_area(self.area, view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Allow the payment again."""
        self._paid = False

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward, or 0."""
        thing = view[self.thing]
        inside = not thing.fallen and view.areas[self.area].contains(*thing.position)
        self._inside = inside
        if not inside or (self._paid and self.only_one_time):
            return 0.0
        self._paid = True
        return self.reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if the body lies in the area, paid already or not."""
        return self._inside


def check_area(name: str, view: WorldView) -> None:
    """Raise a NameNotFoundError with a suggestion unless an area has that name."""
    if name not in view.areas:
        raise NameNotFoundError(
            _("no area is named {name!r}; {hint}", name=name, hint=suggest(name, view.areas))
        )
