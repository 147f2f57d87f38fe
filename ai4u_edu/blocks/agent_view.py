"""What a block may ask of the agent that it belongs to."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from ai4u_edu.blocks.actuators.actuator import Actuator
    from ai4u_edu.blocks.brains.controllers.keyboard import Keyboard
    from ai4u_edu.blocks.sensors.sensor import Sensor
    from ai4u_edu.world import BodyView


class AgentView(Protocol):
    """An agent as its blocks see it (:class:`~ai4u_edu.agent.BasicAgent` is one)."""

    id: str
    actuators: list["Actuator"]
    sensors: list["Sensor"]

    @property
    def body(self) -> "BodyView":
        """The agent's body."""

    @property
    def keyboard(self) -> "Keyboard":
        """The keys that a person holds for this agent."""

    @property
    def steps(self) -> int:
        """Decisions taken in this episode."""

    @property
    def done(self) -> bool:
        """Whether the episode is over."""

    @property
    def reward(self) -> float:
        """The reward of the last decision."""

    @property
    def last_action(self) -> Mapping[str, Sequence[float]]:
        """The last action, by the actuator's name."""
