"""Changes of a scene's list of agents as data."""

from typing import Any

from ai4u_edu.base.parameters import Problem
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.plain import Plain
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.page.editing.things import without_thing

PLACING_ACTUATORS = {"RespawnActuator"}
"""Types of actuators that a copy does not get: it would begin in the place of the other agent."""


def copy_of(agent: Plain, state: EditState, body: str) -> Plain:
    """Return a copy of an agent with an id of its own.

    Args:
        agent: the agent to copy, as plain data.
        state: has the ids that are taken.
        body: name of the copy's body.
    """
    taken = {str(each.get("id", "0")) for each in state.description.agents}
    agent_id = next(str(n) for n in range(len(taken) + 1) if str(n) not in taken)
    copy: dict[str, Any] = {**agent, "id": agent_id, "body": body}
    if "actuators" in copy:
        wanted = [each for each in copy["actuators"] if each["type"] not in PLACING_ACTUATORS]
        copy["actuators"] = wanted
    return copy


def without(state: EditState, agent_id: str) -> EditState:
    """Remove an agent and its body.

    Raises:
        ChangeError: it is the last one.
    """
    index = state.agent_index(agent_id)
    others = [each for i, each in enumerate(state.description.agents) if i != index]
    if not others:
        raise ChangeError([Problem((), "it is the only agent; a scene needs one")])
    body = str(state.description.agents[index]["body"])
    return without_thing(state.driven(agent_id, "").describing(agents=tuple(others)), body)
