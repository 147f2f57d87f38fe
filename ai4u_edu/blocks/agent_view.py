"""The part of an agent that its blocks may use."""

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


class Event(Protocol):
    """An event of the agent that a block may subscribe to."""

    def connect(self, handler: Callable[[Any], None]) -> Any:
        """Call the handler with the agent at each event from now on."""

    def disconnect(self, handler: Callable[[Any], None]) -> None:
        """Stop calling the handler."""


class AgentView(Protocol):
    """An agent as its blocks see it (:class:`~ai4u_edu.agent.BasicAgent` is one)."""

    id: str
    max_steps_per_episode: int
    episode: int
    """Number of episodes that it has begun."""
    other_agents: int
    """Number of other agents in its world."""
    paused: bool
    actuators: list["Actuator"]
    sensors: list["Sensor"]
    rewards: list["RewardFunc"]

    @property
    def begin_of_episode(self) -> Event:
        """The event after a reset, when the first percept is available."""

    @property
    def end_of_update_state(self) -> Event:
        """The event after all sensors have read."""

    @property
    def percept_ready(self) -> Event:
        """The event after a decision or a reset, when percept, reward and end are final."""

    @property
    def body(self) -> "BodyView":
        """The agent's body."""

    @property
    def brain(self) -> "Brain":
        """The enabled brain."""

    @property
    def keyboard(self) -> "Keyboard":
        """The keys that a person holds for this agent."""

    @property
    def percept(self) -> "Percept":
        """The latest percept."""

    @property
    def steps(self) -> int:
        """Number of decisions in this episode."""

    @property
    def done(self) -> bool:
        """True if the episode is over."""

    @property
    def truncated(self) -> bool:
        """True if the step limit truncated the episode."""

    @property
    def reward(self) -> float:
        """The reward of the last decision."""

    @property
    def episode_reward(self) -> float:
        """The reward of all decisions of this episode."""

    @property
    def reward_terms(self) -> dict[str, float]:
        """The reward of the last decision, by named term."""

    @property
    def last_action(self) -> Mapping[str, Sequence[float]]:
        """The last action, by the actuator's name."""
