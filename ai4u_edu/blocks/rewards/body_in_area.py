"""Pays when some thing is where it should be."""

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView


class BodyInAreaRewardFunc(RewardFunc):
    """Pays ``reward`` when the centre of a body lies in an area: a box pushed home, a ball in goal.

    Whoever brought it there. With ``only_one_time`` once an episode, else for each decision after
    which it lies there.

    Source: ours.
    """

    thing: str
    """The body's name."""
    area: str
    """Name of the area."""
    reward: Number = 1.0
    """Amount that is paid."""
    only_one_time: bool = True
    """True pays once an episode, False for each decision after which the body lies there."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look body and area up."""
        _ = view[self.thing]
        check_area(self.area, view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets what was paid."""
        self._paid = False

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """The reward, or 0."""
        thing = view[self.thing]
        inside = not thing.fallen and view.areas[self.area].contains(*thing.position)
        self._inside = inside
        if not inside or (self._paid and self.only_one_time):
            return 0.0
        self._paid = True
        return self.reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Tell whether the body lies in the area, however often that was paid already."""
        return self._inside


def check_area(name: str, view: WorldView) -> None:
    """Raises NameNotFoundError, with a suggestion, unless an area has that name."""
    if name not in view.areas:
        raise NameNotFoundError(f"no area is named {name!r}; {suggest(name, view.areas)}")
