"""Checks of the world and the agents that a ControlRequestor is made of."""

from collections.abc import Sequence

from ai4u_edu.agent.agent import BasicAgent
from ai4u_edu.base.errors import SetupError, shown
from ai4u_edu.world import World


def check_members(world: object, agents: object) -> None:
    """Check the arguments of a ControlRequestor.

    Raises:
        SetupError: no world or no list of agents, or two agents with the same id or body.
    """
    example = "as in ControlRequestor(world, [agent])"
    if not isinstance(world, World):
        raise SetupError(f"expected a World first, {example}, got {_shown(world)}")
    if not isinstance(agents, Sequence) or isinstance(agents, str):
        raise SetupError(f"expected a list of agents, {example}, got {_shown(agents)}")
    for agent in agents:
        if not isinstance(agent, BasicAgent):
            raise SetupError(f"expected agents in the list, {example}, got {_shown(agent)}")
    if not agents:
        raise SetupError("expected at least one agent, got none")
    _check_unique(agents)


def _check_unique(agents: Sequence[BasicAgent]) -> None:
    """Raise SetupError if two agents have the same id or the same body."""
    for index, agent in enumerate(agents):
        for other in agents[:index]:
            if agent.id == other.id:
                problem = SetupError(f"two agents have the id {agent.id!r}; ids are unique")
                problem.where = (agent, "id")
                raise problem
            if agent.body_name == other.body_name:
                problem = SetupError(
                    f"agents {other.id!r} and {agent.id!r} have the same body "
                    f"{agent.body_name!r}; expected a body for each"
                )
                problem.where = (agent, "body")
                raise problem


def _shown(value: object) -> str:
    if isinstance(value, type):
        return f"the class {value.__name__}"
    return f"{type(value).__name__} {shown(value)}"
