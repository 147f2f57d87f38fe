"""The part of a change that can be applied while the world runs."""

from dataclasses import replace
from functools import cached_property

from ai4u_edu.page.editing.state import EditState

RUNTIME_PARAMETERS = (
    "max_steps_per_episode",
    "done_at_negative_reward",
    "done_at_positive_reward",
    "reward_scale",
)
"""Parameters of an agent, besides its blocks, that can change at run time."""
_CHANGEABLE = {*RUNTIME_PARAMETERS, "sensors", "actuators", "rewards", "brains"}
_OF_PAGE = ("name", "title", "goal", "controls", "rewards", "wait_for_key")


class StateDifference:
    """Difference between the state of a running world and the wanted one.

    Args:
        old: the state that the world has.
        new: the wanted state.
    """

    def __init__(self, old: EditState, new: EditState) -> None:
        self._old, self._new = old, new

    @property
    def has_changed(self) -> bool:
        """True if some of it can be applied now."""
        return self.applicable_now != self._old

    @property
    def concerns_no_agent(self) -> bool:
        """True if only bodies, floors, areas and texts differ."""
        same = self._old.description.agents == self._new.description.agents
        return same and self._old.drivers == self._new.drivers

    @cached_property
    def applicable_now(self) -> EditState:
        """The state that the world can have before its next reset: the new one, or part of it."""
        new = self._new.description
        fields = {name: getattr(new, name) for name in _OF_PAGE}
        state = self._old.describing(**fields)
        if self._differs_in_one_thing():
            state = state.describing(floors=new.floors, areas=new.areas, bodies=new.bodies)
        if self._has_same_agents():
            state = state.describing(agents=new.agents, success=new.success)
            state = replace(self._new, description=state.description)
        return state

    def _differs_in_one_thing(self) -> bool:
        """Return True if at most one body, floor or area was added, removed or changed."""
        old = {thing.name: thing for thing in self._old.description.things}
        new = {thing.name: thing for thing in self._new.description.things}
        names = dict.fromkeys((*old, *new))
        return sum(old.get(name) != new.get(name) for name in names) <= 1

    def _has_same_agents(self) -> bool:
        """Return True if no parameter differs that needs a new agent."""

        def fixed(state: EditState) -> list[dict[str, object]]:
            agents = state.description.agents
            return [{k: v for k, v in agent.items() if k not in _CHANGEABLE} for agent in agents]

        return fixed(self._old) == fixed(self._new)
