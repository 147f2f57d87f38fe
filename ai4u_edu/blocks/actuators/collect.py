"""Takes in what the agent touches: food, water, coins."""

from typing import cast

from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import WorldError
from ai4u_edu.base.parameters import Name, Number, Seconds
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.homeostasis import HomeostaticVariable
from ai4u_edu.blocks.rewards.homeostatic import keeper_of
from ai4u_edu.world import Body, BodyView, WorldView

WAIT = 1.0
"""What finds no free place to come back to tries again after so many seconds."""


class CollectActuator(Actuator):
    """Takes bodies of a group out of the world when the agent touches them, and feeds on them.

    What is collected is gone at once: nothing touches it, no ray meets it. It comes back
    ``comes_back_after`` seconds later, where its description says: at another place if that is
    ``random``. So much as ``adds`` says is added to the agent's variables (which a
    HomeostaticReward keeps). With ``needs``, only an agent whose variables are at least at these
    levels can collect; to any other one the body is an obstacle.

    Examples: fruit is ``group="fruit", adds={"energy": 30}, comes_back_after=10``; dirt that is
    gone for good ``group="dirty"``; a door that costs a key ``group="door", needs={"keys": 1},
    adds={"keys": -1}``.

    It takes no action of its own: nobody decides to collect, but where to go. What is collected is
    paid for by GoneReward, or by the HomeostaticReward as the agent feels better.

    Source: ours, after the fruit and the ruby of AI4U's Platform demo.
    """

    action_name: str = "collect"
    is_output: bool = False
    group: Name
    """The tag of what is collected."""
    adds: dict[Name, Number] = Field(default_factory=dict)
    """Amount that one of them adds, by the variable's name, in the variable's unit."""
    needs: dict[Name, Number] = Field(default_factory=dict)
    """Lowest level with which it can be collected, by the variable's name."""
    comes_back_after: Seconds | None = None
    """Time after which a collected body is back; left out: it is gone for the episode."""
    source: str = "homeostatic"
    """The name of the HomeostaticReward that keeps the variables."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._due: dict[str, int] = {}

    def space(self) -> Box:
        """Nothing."""
        return Box(0.0, 1.0, (0,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look the group and the variables up."""
        view.check_group(self.group)
        self._variables: dict[str, HomeostaticVariable] = {}
        for name in dict.fromkeys([*self.adds, *self.needs]):
            self._variables[name] = keeper_of(agent, self.source).variable(name)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets what came back with the reset of the world."""
        self._due = {
            name: due for name, due in self._due.items() if name in view and view[name].fallen
        }

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Does nothing."""

    def on_tick(self, body: Body, view: WorldView) -> None:
        """Puts back what is due, and collects what is touched."""
        for name in [name for name, due in self._due.items() if view.ticks >= due]:
            del self._due[name]
            if name in view:  # else somebody removed it for good
                self._put_back(_whole(view[name]), view)
        for name in view.contacts(body):
            if self.group in view[name].tags and self._can():
                self._collect(_whole(view[name]), view)

    def _put_back(self, thing: Body, view: WorldView) -> None:
        try:
            thing.come_back()
        except WorldError:  # somebody stands wherever it could be
            self._due[thing.name] = view.ticks + round(WAIT / view.dt)

    def _can(self) -> bool:
        return all(self._variables[name].level >= level for name, level in self.needs.items())

    def _collect(self, thing: Body, view: WorldView) -> None:
        thing.leave()
        for name, amount in self.adds.items():
            self._variables[name].add_value(amount)
        if self.comes_back_after is not None:
            self._due[thing.name] = view.ticks + round(self.comes_back_after / view.dt)


def _whole(body: BodyView) -> Body:
    return cast(Body, body)  # the view hands out the world's own bodies
