"""An actuator that collects what the agent touches: food, water, coins."""

from typing import ClassVar, cast

from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import WorldError
from ai4u_edu.base.parameters import Name, Number, Seconds
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.homeostasis import HomeostaticVariable
from ai4u_edu.blocks.rewards.homeostatic import find_homeostatic_reward
from ai4u_edu.world import Body, BodyView, WorldView

RETRY_S = 1.0
"""Delay after which a body that found no free place to come back to tries again."""


class CollectActuator(Actuator):
    """Removes bodies of a group from the world when the agent touches them.

    A collected body disappears at once: nothing touches it, no ray hits it. It comes back
    ``comes_back_after`` seconds later at the place in its description; if that is random, at
    another place. The amounts in ``adds`` are added to the agent's variables (those of a
    HomeostaticReward). With ``needs``, the agent can only collect while its variables are at least
    at these levels; otherwise the body is an obstacle.

    Examples: fruit is ``group="fruit", adds={"energy": 30}, comes_back_after=10``; dirt that never
    comes back ``group="dirty"``; a door that costs a key ``group="door", needs={"keys": 1},
    adds={"keys": -1}``.

    It takes no action: the agent only decides where to go. Collecting is rewarded by a GoneReward,
    or by the HomeostaticReward when the variables come closer to their comfort zones.

    Source: ours, after the fruit and the ruby of AI4U's Platform demo.
    """

    action_name: str = "collect"
    is_output: bool = False
    group: Name
    """Tag of the bodies that are collected."""
    adds: dict[Name, Number] = Field(default_factory=dict)
    """Amount that one body adds, by the variable's name, in the variable's unit."""
    needs: dict[Name, Number] = Field(default_factory=dict)
    """Lowest level at which the agent can collect, by the variable's name."""
    comes_back_after: Seconds | None = None
    """Time after which a collected body comes back; left out: not in this episode."""
    source: str = "homeostatic"
    """Name of the HomeostaticReward that has the variables."""

    carried: ClassVar[tuple[str, ...]] = ("_due", "_count")

    def __post_init__(self) -> None:
        super().__post_init__()
        self._due: dict[str, int] = {}
        self._count = 0

    @property
    def count(self) -> int:
        """Number of bodies that it has collected in this episode."""
        return self._count

    def space(self) -> Box:
        """Return a space without numbers."""
        return Box(0.0, 1.0, (0,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the group and the variables."""
        view.check_group(self.group)
        self._variables: dict[str, HomeostaticVariable] = {}
        for name in dict.fromkeys([*self.adds, *self.needs]):
            self._variables[name] = find_homeostatic_reward(agent, self.source).variable(name)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forget the bodies that came back with the reset of the world."""
        self._count = 0
        self._due = {
            name: due for name, due in self._due.items() if name in view and view[name].fallen
        }

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Do nothing."""

    def on_tick(self, body: Body, view: WorldView) -> None:
        """Put back the bodies whose time is over, and collect those that the agent touches."""
        for name in [name for name, due in self._due.items() if view.ticks >= due]:
            del self._due[name]
            if name in view:  # else it was removed from the world by hand
                self._put_back(_whole(view[name]), view)
        for name in view.contacts(body):
            if self.group in view[name].tags and self._can():
                self._collect(_whole(view[name]), view)

    def _put_back(self, thing: Body, view: WorldView) -> None:
        try:
            thing.come_back()
        except WorldError:  # all places are taken
            self._due[thing.name] = view.ticks + round(RETRY_S / view.dt)

    def _can(self) -> bool:
        return all(self._variables[name].level >= level for name, level in self.needs.items())

    def _collect(self, thing: Body, view: WorldView) -> None:
        thing.leave()
        self._count += 1
        for name, amount in self.adds.items():
            self._variables[name].add_value(amount)
        if self.comes_back_after is not None:
            self._due[thing.name] = view.ticks + round(self.comes_back_after / view.dt)


def _whole(body: BodyView) -> Body:
    return cast(Body, body)  # the view hands out the world's own bodies
