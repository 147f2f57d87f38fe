"""What of a change can be made in a world that runs."""

from dataclasses import replace
from functools import cached_property

from ai4u_edu.editing.state import EditState

OWN = (
    "max_steps_per_episode",
    "done_at_negative_reward",
    "done_at_positive_reward",
    "reward_scale",
)
"""The parameters of an agent, besides its blocks, that can change under way."""
LIVE = {*OWN, "sensors", "actuators", "rewards", "brains"}
TEXTS = ("name", "title", "goal", "controls", "rewards")


class Difference:
    """Between what a world is and what it is to be.

    Args:
        old: what it is.
        new: what it is to be.
    """

    def __init__(self, old: EditState, new: EditState) -> None:
        self._old, self._new = old, new

    @property
    def has_changed(self) -> bool:
        """Whether something of it can be made now."""
        return self.possible_now != self._old

    @property
    def only_things(self) -> bool:
        """Whether nothing but bodies and words is other."""
        same = self._old.description.agents == self._new.description.agents
        return same and self._old.drivers == self._new.drivers

    @cached_property
    def possible_now(self) -> EditState:
        """What the world may be before its next reset: the new state, or something before it."""
        new = self._new.description
        fields = {name: getattr(new, name) for name in TEXTS}
        state = self._old.describing(**fields)
        if self._one_body():
            state = state.describing(bodies=new.bodies)
        if self._same_agents():
            state = state.describing(agents=new.agents, success=new.success)
            state = replace(self._new, description=state.description)
        return state

    def _one_body(self) -> bool:
        """Whether at most one body came, went or was changed."""
        old = {body.name: body for body in self._old.description.bodies}
        new = {body.name: body for body in self._new.description.bodies}
        names = dict.fromkeys((*old, *new))
        return sum(old.get(name) != new.get(name) for name in names) <= 1

    def _same_agents(self) -> bool:
        def fixed(state: EditState) -> list[dict[str, object]]:
            agents = state.description.agents
            return [{k: v for k, v in agent.items() if k not in LIVE} for agent in agents]

        return fixed(self._old) == fixed(self._new)
