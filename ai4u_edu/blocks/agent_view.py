"""The part of an agent that its blocks may use."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, Protocol

from gymnasium import spaces

from ai4u_edu.blocks.keyboard import Keyboard
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.world import BodyView


class SensorView(Protocol):
    """A sensor as other blocks of its agent see it."""

    perception_key: str
    is_active: bool
    is_input: bool
    unit: ClassVar[str]

    def reading_kind(self) -> str:
        """Return AI4U's type of the reading."""

    def observation_space(self) -> spaces.Space[Any]:
        """Return the space of the reading in the percept."""


class ActuatorView(Protocol):
    """An actuator as other blocks of its agent see it."""

    action_name: str
    is_active: bool
    is_output: bool
    is_continuous: ClassVar[bool]
    clipped: int

    def space(self) -> spaces.Space[Any]:
        """Return the space of its action."""

    def slots(self) -> tuple[str, ...]:
        """Return display names of the numbers of its action."""

    def limits(self) -> tuple[list[float], list[float]]:
        """Return the lowest and the highest numbers of its action."""

    def accept(self, values: Any) -> tuple[float, ...]:
        """Check the numbers of an action, and clip them."""


class _RewardView(Protocol):
    """A reward function as other blocks of its agent see it."""

    name: str
    is_active: bool


class _BrainView(Protocol):
    """A brain as other blocks of its agent see it."""

    skip_frame: int
    repeat_action: bool


class EventView(Protocol):
    """An event of the agent that a block may subscribe to."""

    def connect(self, handler: Callable[[Any], None]) -> Any:
        """Call the handler with the agent at each event from now on."""

    def disconnect(self, handler: Callable[[Any], None]) -> None:
        """Stop calling the handler."""


class AgentInput(NamedTuple):
    """Numbers that a script gave to an agent, besides the actions of its brain."""

    name: str
    """Perception key of the sensor that reads them."""
    moment: int
    """Count of that sensor's readings and resets in the world's episode before."""
    values: tuple[float, ...]


class AgentView(Protocol):
    """An agent as its blocks see it (:class:`~ai4u_edu.agent.BasicAgent` is one)."""

    id: str
    max_steps_per_episode: int
    episode: int
    """Number of episodes that it has begun."""
    other_agents: int
    """Number of other agents in its world."""
    paused: bool

    @property
    def fields(self) -> Mapping[str, tuple[str, ...]]:
        """Fields that an AI4U script sent with its last message, by name."""

    def take_fields(self, fields: Mapping[str, tuple[str, ...]]) -> str:
        """Take a script's fields; return a sentence about those that do not fit."""

    def note_input(self, given: AgentInput) -> None:
        """Tell recorders that a script gave numbers to the agent."""

    @property
    def sensors(self) -> Sequence[SensorView]:
        """Its sensors."""

    @property
    def actuators(self) -> Sequence[ActuatorView]:
        """Its actuators."""

    @property
    def rewards(self) -> Sequence[_RewardView]:
        """Its reward functions."""

    @property
    def begin_of_episode(self) -> EventView:
        """The event after a reset, when the first percept is available."""

    @property
    def end_of_update_state(self) -> EventView:
        """The event after all sensors have read."""

    @property
    def percept_ready(self) -> EventView:
        """The event after a decision or a reset, when percept, reward and end are final."""

    @property
    def body(self) -> BodyView:
        """The agent's body."""

    @property
    def brain(self) -> _BrainView:
        """The enabled brain."""

    @property
    def keyboard(self) -> Keyboard:
        """The keys that a person holds for this agent."""

    @property
    def percept(self) -> Percept:
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
