"""The attributes that both kinds of robots share."""

from typing import TYPE_CHECKING, Any, NamedTuple

from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.wire.native import Welcome

if TYPE_CHECKING:
    from gymnasium import spaces


class Spaces(NamedTuple):
    """The observation and action spaces of an agent, as Gymnasium's spaces."""

    observation: "spaces.Dict"
    """Space of a policy's observation, by perception key."""
    action: "spaces.Space[Any]"
    """Space of the actions of its one actuator, or a Dict of several."""


class RobotBase:
    """The base of robots, synchronous and asynchronous.

    Args:
        dialogue: with the world.
    """

    def __init__(self, dialogue: Dialogue) -> None:
        self._dialogue = dialogue

    @property
    def percept(self) -> RemotePercept | None:
        """The latest percept, without waiting; None before the first."""
        return self._dialogue.percept

    @property
    def welcome(self) -> Welcome:
        """The world's description of the agent: readings, outputs, ticks, names of rewards."""
        return self._dialogue.welcome

    @property
    def session(self) -> str:
        """The argument by which ``connect(..., session=...)`` resumes this session; a secret."""
        return self._dialogue.session

    @property
    def spaces(self) -> Spaces:
        """The observation and action spaces, as Gymnasium's spaces."""
        from ai4u_edu.remote.spaces import action_space, observation_space

        dialogue = self._dialogue
        observation: Any = observation_space(dialogue.readings.values())
        return Spaces(observation, action_space(dialogue.outputs))

    def __repr__(self) -> str:
        welcome = self._dialogue.welcome
        return f"{type(self).__name__}({welcome.agent!r} in {welcome.title!r}, {welcome.mode})"
