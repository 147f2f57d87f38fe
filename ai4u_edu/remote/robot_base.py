"""What both kinds of robots can be asked."""

from typing import TYPE_CHECKING, Any, NamedTuple

from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.wire.native import Welcome

if TYPE_CHECKING:
    from gymnasium import spaces


class Spaces(NamedTuple):
    """What an agent senses and can do, in Gymnasium's terms."""

    observation: "spaces.Dict"
    """By perception key; what a policy gets."""
    action: "spaces.Space[Any]"
    """Of its one actuator, or a Dict of several."""


class RobotBase:
    """An agent that is driven from here, by whichever verbs.

    Args:
        dialogue: with its world.
    """

    def __init__(self, dialogue: Dialogue) -> None:
        self._dialogue = dialogue

    @property
    def percept(self) -> RemotePercept | None:
        """The latest, without waiting; None before the first."""
        return self._dialogue.percept

    @property
    def welcome(self) -> Welcome:
        """What the world said of the agent: its readings and outputs, ticks, names of rewards."""
        return self._dialogue.welcome

    @property
    def session(self) -> str:
        """What ``connect(..., session=...)`` needs to go on from another process; a secret."""
        return self._dialogue.session

    @property
    def spaces(self) -> Spaces:
        """What the robot senses and can do, as Gymnasium's spaces."""
        from ai4u_edu.remote.spaces import action_space, observation_space

        dialogue = self._dialogue
        observation: Any = observation_space(dialogue.readings.values())
        return Spaces(observation, action_space(dialogue.outputs))

    def __repr__(self) -> str:
        welcome = self._dialogue.welcome
        return f"{type(self).__name__}({welcome.agent!r} in {welcome.title!r}, {welcome.mode})"
