"""The actions of a remote script: acceptance by the agent's actuators, and substitutes."""

from typing import Literal, assert_never

from ai4u_edu.base.errors import ActionError, shown, suggest
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.command import Accepted, Action

OnMissing = Literal["hold", "coast", "stop"]


class RemoteActions:
    """The actions that a remote script can give to an agent.

    Args:
        agent: the agent, set up.
    """

    def __init__(self, agent: AgentView) -> None:
        self._agent = agent
        self._actuators = {each.action_name: each for each in agent.actuators if each.is_active}

    def accept(self, action: Action) -> tuple[Accepted, int]:
        """Return an action as the actuators take it, and how many of its numbers were clipped.

        Raises:
            ActionError: no actuator has the name, or it can't carry out the numbers.
        """
        accepted, clipped = Accepted(), 0
        for name, numbers in action.items():
            actuator = self._actuators.get(name)
            if actuator is None:
                raise ActionError(
                    f"agent {self._agent.id!r} has no actuator {shown(name)}; "
                    f"{suggest(str(name), self._actuators)}"
                )
            before = actuator.clipped
            accepted[name] = actuator.accept(numbers)
            clipped += actuator.clipped - before
        return accepted, clipped

    def substitute(self, on_missing: OnMissing) -> Action:
        """Return what the agent does in place of an action that is missing."""
        match on_missing:
            case "hold":
                return dict(self._agent.last_action)
            case "coast":
                return {}
            case "stop":
                return {
                    name: [
                        min(max(0.0, low), high) for low, high in zip(*each.limits(), strict=True)
                    ]
                    for name, each in self._actuators.items()
                    if each.is_output
                }
            case _:
                assert_never(on_missing)
