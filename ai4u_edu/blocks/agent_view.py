"""What a block may ask of the agent that it belongs to."""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from ai4u_edu.blocks.actuators.actuator import Actuator
    from ai4u_edu.blocks.brains.brain import Brain
    from ai4u_edu.blocks.brains.controllers.keyboard import Keyboard
    from ai4u_edu.blocks.percept import Percept
    from ai4u_edu.blocks.rewards.reward_func import RewardFunc
    from ai4u_edu.blocks.sensors.sensor import Sensor
    from ai4u_edu.world import BodyView


class Moment(Protocol):
    """A moment of an agent's life that a block may listen to."""

    def connect(self, handler: Callable[[Any], None]) -> Any:
        """Calls the handler with the agent at this moment from now on."""

    def disconnect(self, handler: Callable[[Any], None]) -> None:
        """Stops calling the handler."""


class AgentView(Protocol):
    """An agent as its blocks see it (:class:`~ai4u_edu.agent.BasicAgent` is one)."""

    id: str
    max_steps_per_episode: int
    episode: int
    """How many episodes it has begun."""
    other_agents: int
    """How many other agents are in its world."""
    paused: bool
    actuators: list["Actuator"]
    sensors: list["Sensor"]
    rewards: list["RewardFunc"]

    @property
    def begin_of_episode(self) -> Moment:
        """When a reset is over and the first percept is there."""

    @property
    def end_of_update_state(self) -> Moment:
        """When all sensors have read."""

    @property
    def body(self) -> "BodyView":
        """The agent's body."""

    @property
    def brain(self) -> "Brain":
        """The one brain that is enabled."""

    @property
    def keyboard(self) -> "Keyboard":
        """The keys that a person holds for this agent."""

    @property
    def percept(self) -> "Percept":
        """What was sensed last."""

    @property
    def steps(self) -> int:
        """Decisions taken in this episode."""

    @property
    def done(self) -> bool:
        """Whether the episode is over."""

    @property
    def truncated(self) -> bool:
        """Whether the episode was cut off by the step limit."""

    @property
    def reward(self) -> float:
        """The reward of the last decision."""

    @property
    def reward_terms(self) -> dict[str, float]:
        """The reward of the last decision, by named term."""

    @property
    def last_action(self) -> Mapping[str, Sequence[float]]:
        """The last action, by the actuator's name."""
