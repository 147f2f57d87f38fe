"""A reward for keeping internal variables in their comfort zones."""

from collections.abc import Sequence
from typing import Annotated, ClassVar

from pydantic import Field

from ai4u_edu.base.errors import BlockError, NameNotFoundError, suggest
from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.homeostasis import HomeostaticVariable
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, WorldView


class HomeostaticReward(RewardFunc):
    """Has the agent's internal variables, and pays for every reduction of discomfort.

    A variable's discomfort is 0 in its comfort zone; outside, it is the distance to that zone as a
    share of the variable's range. The agent's discomfort is the sum over all variables. A decision
    earns ``reward`` times the decrease of discomfort in it, and loses as much for an increase: so
    growing hunger costs, and a meal pays it back. Over an episode the payments add up to ``reward``
    times (discomfort at the start - discomfort at the end): going in circles earns nothing.

    The variables drift in every tick. A CollectActuator changes them when the agent finds
    something, a script with ``reward.variable("energy").add_value(20)``; a HomeostaticSensor reads
    them.

    Source: ours, after Keramati and Gutkin, "Homeostatic reinforcement learning for integrating
    reward collection and physiological stability", eLife 3 (2014): reward as reduction of drive.
    """

    variables: Annotated[list[HomeostaticVariable], Field(min_length=1)]
    """Internal variables of the agent; at least one, with different names."""
    reward: Number = 1.0
    """Amount for a decrease of discomfort by 1."""

    carried: ClassVar[tuple[str, ...]] = ("_before",)

    def __post_init__(self) -> None:
        super().__post_init__()
        names = [variable.name for variable in self.variables]
        for index, name in enumerate(names):
            if name in names[:index]:
                raise BlockError(
                    _(
                        "{type} {name!r}: expected variables of different names, got {name2!r} "
                        "twice",
                        type=type(self).__name__,
                        name=self.name,
                        name2=name,
                    )
                )

    def variable(self, name: str) -> HomeostaticVariable:
        """Return the variable with a name.

        Raises:
            NameNotFoundError: there is none; the message suggests the nearest name.
        """
        known = {variable.name: variable for variable in self.variables}
        if name not in known:
            raise NameNotFoundError(
                _("no variable is named {name!r}; {hint}", name=name, hint=suggest(name, known))
            )
        return known[name]

    def discomfort(self) -> float:
        """Return the present discomfort: 0 if all variables are in their comfort zones."""
        return sum(
            variable.discomfort() / (variable.range_max - variable.range_min)
            for variable in self.variables
        )

    def inner_blocks(self) -> Sequence[HomeostaticVariable]:
        """Return the variables."""
        return self.variables

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Reset the variables."""
        for variable in self.variables:
            variable.on_reset(agent, view)
        self._before = self.discomfort()

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Let the variables drift."""
        for variable in self.variables:
            variable.drift(body, view.dt)

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward for the change of discomfort."""
        before, self._before = self._before, self.discomfort()
        return self.reward * (before - self._before)

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if every variable is in its comfort zone."""
        return all(variable.check() for variable in self.variables)


def find_homeostatic_reward(agent: AgentView, name: str) -> HomeostaticReward:
    """Return the agent's HomeostaticReward with a name.

    Raises:
        BlockError: there is no active one; the message suggests the nearest name.
    """
    keepers = {
        reward.name: reward
        for reward in agent.rewards
        if isinstance(reward, HomeostaticReward) and reward.is_active
    }
    if name not in keepers:
        raise BlockError(
            _(
                "no HomeostaticReward is called {name!r}; {hint}",
                name=name,
                hint=suggest(name, keepers),
            )
        )
    return keepers[name]
