"""An agent: a body, the blocks on it, and one brain."""

import math
from collections.abc import Callable, Mapping
from copy import copy
from typing import Annotated, Any
from weakref import ReferenceType, ref

from pydantic import Field, field_validator

from ai4u_edu.agent.bound_blocks import BoundBlocks
from ai4u_edu.agent.events import ContactEvents, Event
from ai4u_edu.agent.ledger import HANDLERS, Ledger
from ai4u_edu.base.errors import ActionError, ReadingError, SetupError, suggest, text_of
from ai4u_edu.base.parameters import Count, Name, Number, WholeNumber
from ai4u_edu.blocks import (
    Action,
    Actuator,
    AgentArraySensor,
    Answer,
    Brain,
    Command,
    ContinuousActuator,
    Controller,
    DiscreteActuator,
    Keyboard,
    Percept,
    RewardFunc,
    Sensor,
    TruncatedSensor,
)
from ai4u_edu.blocks.agent_view import AgentInput
from ai4u_edu.blocks.block import Block
from ai4u_edu.blocks.brains.brain import Accepted
from ai4u_edu.blocks.brains.local import as_brain, can_drive
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.world import Body, World, WorldView

Numbers = tuple[float, ...]

_DEFAULT_ACTION = "defaultAction"
"""AI4U's name for the action that goes to ``agent.action_handler``."""
CARRIED = (
    "episode",
    "steps",
    "terminated",
    "truncated",
    "paused",
    "stopped",
    "last_action",
    "_done_requested",
    "_status_read",
)
"""Attributes of an agent that an episode changes; a copy of the world at one moment gets them."""


class BasicAgent(Parameterized):
    """A body plus blocks (sensors, actuators, reward functions) plus exactly one enabled brain.

    Events are attributes: ``agent.end_of_step.connect(f)``, and so on for all of
    :data:`~ai4u_edu.agent.events.EVENTS`, and ``agent.touched``, ``agent.area_entered`` and
    ``agent.area_left``, whose handlers get the agent and the name of the body or area.
    ``print(agent)`` shows all blocks in a table.

    Source: AI4U's BasicAgent.
    """

    body_name: Name = Field(alias="body")
    """Name of the agent's body in the world."""
    id: Name = "0"
    priority: WholeNumber = 0
    """Agents of higher priority act first."""
    max_steps_per_episode: Count = 0
    """Number of decisions after which the episode is truncated; 0 for no limit."""
    done_at_negative_reward: bool = False
    """True ends the episode after a decision with a reward below 0."""
    done_at_positive_reward: bool = False
    """True ends the episode after a decision with a reward above 0."""
    reward_scale: Number = 1.0
    """Factor of every reward."""
    array_input_size: Annotated[int, Field(ge=0, le=1024)] = 0
    """Size of an array that a script sets for the agent to sense (``array_sensor``); 0 for none."""
    range_min: Number = 0.0
    """Lowest number of that array."""
    range_max: Number = 1.0
    """Highest number of that array."""
    action_size: Annotated[int, Field(ge=0, le=1024)] = 0
    """Count of numbers (or choices) of the action "defaultAction", which ``action_handler`` carries
    out; 0 for none, or for 1 if there is a handler."""
    action_is_continuous: bool = True
    """True makes "defaultAction" numbers from -1 to 1, False one choice."""
    check_episode_truncated: bool = False
    """True adds a TruncatedSensor: the agent senses that its episode was truncated."""
    sensors: list[Sensor] = Field(default_factory=list)
    actuators: list[Actuator] = Field(default_factory=list)
    rewards: list[RewardFunc] = Field(default_factory=list)
    brains: list[Brain] = Field(default_factory=list)

    @field_validator("brains", mode="before")
    @classmethod
    def _with_brains(cls, brains: Any) -> Any:
        if not isinstance(brains, list | tuple):
            return brains
        return [as_brain(each) if can_drive(each) else each for each in brains]

    def __post_init__(self) -> None:
        self.keyboard = Keyboard()
        self.ledger = Ledger()
        self.episode = 0
        """Number of episodes that it has begun, restarts of this agent alone included."""
        self.other_agents = 0
        """Number of other agents in its world."""
        self.steps = 0
        """Number of decisions taken in this episode."""
        self.terminated = False
        """True if an event in the episode ended it."""
        self.truncated = False
        """True if the step limit ended the episode."""
        self.paused = False
        self.stopped = False
        self.last_action: dict[str, Numbers] = {}
        self.fields: dict[str, tuple[str, ...]] = {}
        """Fields that an AI4U script sent with its last message, by name (AI4U's GetField...)."""
        self.latest_input: AgentInput | None = None
        """The last numbers that a script gave to one of its sensors."""
        self._action_handler: Callable[..., None] | None = None
        self._requestor: ReferenceType[object] | None = None
        self.bound_blocks_or_none: BoundBlocks | None = None
        """The blocks bound to the body; None before :meth:`setup`."""
        self._percept: Percept | None = None
        self._done_requested = False
        self._status_read = (0.0, False, False)
        """Reward, terminated and truncated when the sensors last read."""
        self.agent_start: Event[BasicAgent] = Event("agent_start")
        self.before_the_reset: Event[BasicAgent] = Event("before_the_reset")
        self.begin_of_episode: Event[BasicAgent] = Event("begin_of_episode")
        self.begin_of_update_state: Event[BasicAgent] = Event("begin_of_update_state")
        self.end_of_update_state: Event[BasicAgent] = Event("end_of_update_state")
        self.begin_of_step: Event[BasicAgent] = Event("begin_of_step")
        self.begin_of_apply_action: Event[BasicAgent] = Event("begin_of_apply_action")
        self.end_of_apply_action: Event[BasicAgent] = Event("end_of_apply_action")
        self.end_of_step: Event[BasicAgent] = Event("end_of_step")
        self.end_of_episode: Event[BasicAgent] = Event("end_of_episode")
        self.contacts: ContactEvents[BasicAgent] = ContactEvents()
        """The events of touching bodies, and of entering and leaving areas."""
        self.touched = self.contacts.touched
        self.area_entered = self.contacts.area_entered
        self.area_left = self.contacts.area_left
        self.percept_ready: Event[BasicAgent] = Event("percept_ready")
        """Our own event, for recorders and connections: percept, reward and end of a decision are
        final. It also comes once after each reset."""
        self.input_given: Event[BasicAgent] = Event("input_given")
        """Our own event, for recorders: a script gave numbers (``latest_input``) to a sensor."""

    # -- state -----------------------------------------------------------------------------------

    @property
    def bound_blocks(self) -> BoundBlocks:
        """The blocks bound to the body; made by :meth:`setup`."""
        if self.bound_blocks_or_none is None:
            raise SetupError(
                _(
                    "agent {id!r} is in no world yet; expected ControlRequestor(world, [agent])",
                    id=self.id,
                )
            )
        return self.bound_blocks_or_none

    @property
    def requestor(self) -> object | None:
        """The ControlRequestor that the agent belongs to; None once that was deleted."""
        return None if self._requestor is None else self._requestor()

    @property
    def array_sensor(self) -> AgentArraySensor | None:
        """The sensor that ``array_input_size`` adds: ``agent.array_sensor.set_value(0, 0.5)``."""
        found = (each for each in self.sensors if isinstance(each, AgentArraySensor))
        key = AgentArraySensor().perception_key
        return next((each for each in found if each.perception_key == key), None)

    @property
    def action_handler(self) -> Callable[..., None] | None:
        """The function that carries out "defaultAction".

        It is set as ``agent.action_handler = f`` and called for every tick of a decision as
        ``f(body, numbers)``, or as ``f(body, index)`` without ``action_is_continuous``.
        """
        return self._action_handler

    @action_handler.setter
    def action_handler(self, handler: Callable[..., None] | None) -> None:
        if handler is not None and not callable(handler):
            raise SetupError(
                _(
                    "agent {id!r}: action_handler: expected a function, as in "
                    "agent.action_handler = lambda body, numbers: ..., got {handler}",
                    id=self.id,
                    handler=repr(handler),
                )
            )
        self._action_handler = handler
        for actuator in self.actuators:
            if actuator.action_name == _DEFAULT_ACTION and hasattr(actuator, "handler"):
                actuator.handler = handler

    @property
    def body(self) -> Body:
        """The agent's body."""
        return self.bound_blocks.body

    @property
    def view(self) -> WorldView:
        """Read access to the world."""
        return self.bound_blocks.view

    @property
    def brain(self) -> Brain:
        """The enabled brain."""
        return self.bound_blocks.brain

    @property
    def percept(self) -> Percept:
        """The last percept."""
        if self._percept is None:
            raise SetupError(
                _("agent {id!r} has sensed nothing yet; expected a reset first", id=self.id)
            )
        return self._percept

    @property
    def done(self) -> bool:
        """True if the episode is over."""
        return self.terminated or self.truncated

    @property
    def reward(self) -> float:
        """The reward of the last decision."""
        return self.ledger.total

    @property
    def episode_reward(self) -> float:
        """The reward of all decisions of this episode (AI4U's EpisodeReward)."""
        return self.ledger.episode_total

    @property
    def reward_terms(self) -> dict[str, float]:
        """The reward of the last decision, by named term."""
        return dict(self.ledger.terms)

    def __str__(self) -> str:
        return _table(self)

    # -- methods for users ------------------------------------------------------------------------

    def set_requestor(self, requestor: object) -> None:
        """Set the ControlRequestor that the agent belongs to, as a weak reference."""
        self._requestor = ref(requestor)

    def setup(self, world: World) -> None:
        """Bind the blocks to the body in a world and check that they fit together.

        An agent may be set up again, in this world or in another one: it starts over there, and a
        ControlRequestor of another world refuses to go on with it.

        Raises:
            SetupError: something does not fit, or another agent of the world has a block of it.
        """
        self.bind_blocks(world)
        self.agent_start.fire(self)

    def bind_blocks(self, world: World, *, ready_brain: Brain | None = None) -> BoundBlocks:
        """Bind the blocks that the agent has now to its body in a world.

        Args:
            world: the world that the body is in.
            ready_brain: a brain that is set up already and stays as it is.

        Raises:
            SetupError: something does not fit.
        """
        self._add_optional_blocks()
        bound = BoundBlocks(self, world)
        # blocks ask the agent for body and view while they are set up
        self.bound_blocks_or_none = bound
        bound.set_up(ready_brain=ready_brain)
        return bound

    def restore_blocks(self, bound: BoundBlocks) -> None:
        """Restore a binding after building a replacement failed."""
        self.bound_blocks_or_none = bound
        bound.attach_sensors()

    def add_reward(self, amount: float, request_done: bool = False, name: str = HANDLERS) -> None:
        """Add to the reward of a decision; for handlers of any event, and for blocks.

        The decision under way gets it. What is paid while the reading after it is taken, or by
        another agent at the same tick, is part of it, too. What a controller pays is in the
        decision that it takes; so is what is paid between two steps. What is paid before an
        episode's first decision is asked for (``before_the_reset``, the first reading,
        ``begin_of_episode``), or after its end, is dropped, as in AI4U.

        Args:
            amount: a finite number; multiplied by reward_scale.
            request_done: True ends the episode with that decision, which may have to begin first.
            name: the reward term.

        Raises:
            ReadingError: the amount is no finite number.
        """
        try:
            paid = float(amount) * self.reward_scale
        except (TypeError, ValueError):
            paid = math.nan
        if not math.isfinite(paid):
            raise ReadingError(
                _(
                    "agent {id!r}, add_reward of {name!r}: expected a finite number, got {amount}",
                    id=self.id,
                    name=name,
                    amount=repr(amount),
                )
            )
        self.ledger.pay(name, paid)
        self._done_requested = self._done_requested or request_done

    @property
    def is_done_requested(self) -> bool:
        """True if the episode ends with the decision under way, or with the next one."""
        return self._done_requested

    def request_done(self) -> None:
        """End the episode with the decision under way, or with the next one."""
        self._done_requested = True

    def use_brain(self, brain: Brain | Controller | Callable[[Percept], Answer]) -> None:
        """Replace the brain, from the next decision on; the body stays as it is.

        Args:
            brain: a brain, or a controller or a function from percept to action, which gets a
                LocalBrain.

        Raises:
            SetupError: the value is none of these, or the brain does not fit the agent.
        """
        self.bound_blocks.swap_brain(as_brain(brain))

    def take_fields(self, fields: Mapping[str, tuple[str, ...]]) -> str:
        """Take the fields that a script sent besides its action.

        They are in :attr:`fields`, and an AgentArraySensor of a field's name reads its numbers.

        Returns:
            A sentence about the fields that do not fit their sensors; empty if all do.
        """
        self.fields = dict(fields)
        problems = []
        for sensor in self.bound_blocks.array_sensors():
            texts = fields.get(sensor.perception_key)
            if texts is not None:
                try:
                    numbers = [float(text) for text in texts]
                    if numbers != sensor.numbers.tolist():  # a script may send them each time
                        sensor.set_values(numbers)
                except (ReadingError, ValueError) as error:
                    problems.append(
                        _(
                            "field {name!r} had no effect: {problem}",
                            name=sensor.perception_key,
                            problem=text_of(error),
                        )
                    )
        return join(problems, "; ") if problems else ""

    def note_input(self, given: AgentInput) -> None:
        """Tell recorders that a script gave numbers to the agent."""
        self.latest_input = given
        if self.input_given.handlers:
            self.input_given.fire(self)

    # -- steps of a decision, called by ControlRequestor -----------------------------------------

    def begin_episode(self) -> None:
        """Clear the last episode's results and reset all blocks."""
        self.ledger.clear()
        self.episode += 1
        self.steps = 0
        self.terminated = self.truncated = self.paused = self.stopped = False
        self._done_requested = False
        self.last_action = {}
        self.contacts.begin()
        self.bound_blocks.reset()

    def sense(self) -> Percept:
        """Read every active sensor once and return the new percept."""
        bound = self.bound_blocks
        self._status_read = self.ledger.total, self.terminated, self.truncated
        if self.begin_of_update_state.handlers:
            self.begin_of_update_state.fire(self)
        self._percept = bound.sense()
        if self.end_of_update_state.handlers:
            self.end_of_update_state.fire(self)
        return self._percept

    def get_state(self) -> dict[str, Any]:
        """Return all that an episode changes in the agent itself, by attribute."""
        values = {name: copy(getattr(self, name)) for name in CARRIED}
        return values | {"contacts": self.contacts.get_state()}

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Take over the state of this agent in another copy of its world, after its blocks have."""
        for name in CARRIED:
            setattr(self, name, copy(state[name]))
        self.contacts.set_state(state["contacts"])
        self._percept = self.bound_blocks.percept()

    def replace_percept(self, percept: Percept) -> None:
        """Replace the last percept, after blocks or the world were changed by hand."""
        self._percept = percept

    def apply_command(self, command: Command) -> None:
        """Apply a brain's command to the agent's own state."""
        match command:
            case Command.PAUSE:
                self.paused = True
            case Command.RESUME:
                self.paused = False
            case Command.STOP:
                self.stopped = True

    def accept(self, action: Action) -> list[tuple[Actuator, Numbers]]:
        """Check an action and return its actuators with their numbers.

        Raises:
            ActionError: it names an unknown actuator, or its numbers don't fit.
        """
        actuators = self.bound_blocks.actuators
        if type(action) is Accepted:
            self.last_action = dict(action)
            known = [(actuators[name], numbers) for name, numbers in action.items()]
            return [each for each in known if each[0].is_active]
        accepted, numbers = [], {}
        try:
            for name in action:
                actuator = actuators[name]
                numbers[name] = actuator.accept(action[name])
                if actuator.is_active:
                    accepted.append((actuator, numbers[name]))
        except (KeyError, TypeError):
            self._refuse(action)
        self.last_action = numbers
        return accepted

    def begin_step(self) -> None:
        """Begin a decision, with what its controller has paid."""
        self.ledger.open()
        if self.begin_of_step.handlers:
            self.begin_of_step.fire(self)

    def end_step(self) -> None:
        """End a decision: book its rewards and decide whether the episode is over."""
        bound = self.bound_blocks
        if bound.pay(self.ledger, self.reward_scale):
            self._done_requested = True
        if self.end_of_step.handlers:
            self.end_of_step.fire(self)
        self.steps += 1
        self.ledger.close(self.steps)
        self.terminated = bound.body.fallen or self._is_end_asked()
        limit = self.max_steps_per_episode
        self.truncated = not self.terminated and 0 < limit <= self.steps
        if self.end_of_episode.handlers and self.done:
            self.end_of_episode.fire(self)

    def end_while_sensing(self) -> None:
        """End the episode if something has asked for that since the step ended."""
        if not (self.terminated or self.truncated) and self._is_end_asked():
            self.terminated = True
            if self.end_of_episode.handlers:
                self.end_of_episode.fire(self)

    def settle(self) -> None:
        """Finish a decision: what is paid from now on is in the next one.

        Sensors that read the reward or the end read again if these have changed since.
        """
        if self._status_read != (self.ledger.total, self.terminated, self.truncated):
            self._percept = self.bound_blocks.read_status_again(self.percept)
        self.ledger.seal()
        if self.percept_ready.handlers:
            self.percept_ready.fire(self)

    def settle_reset(self) -> None:
        """Finish a reset: drop what was paid in it."""
        self.ledger.drop_carried()
        if self.percept_ready.handlers:
            self.percept_ready.fire(self)

    def _add_optional_blocks(self) -> None:
        """Add the blocks that options ask for, as AI4U's RLAgent does, except for names in use."""
        sensors = list[Sensor]()
        if self.array_input_size:
            sensors.append(
                AgentArraySensor(
                    size=self.array_input_size, range_min=self.range_min, range_max=self.range_max
                )
            )
        if self.check_episode_truncated:
            sensors.append(TruncatedSensor())
        keys = {sensor.perception_key for sensor in self.sensors}
        self.sensors += [sensor for sensor in sensors if sensor.perception_key not in keys]
        size = self.action_size or int(self._action_handler is not None)
        if not size or any(each.action_name == _DEFAULT_ACTION for each in self.actuators):
            return
        made: ContinuousActuator | DiscreteActuator
        if self.action_is_continuous:
            made = ContinuousActuator(action_name=_DEFAULT_ACTION, size=size)
        else:
            # the default table of a DiscreteActuator would drive the body without a handler
            still = [(0.0, 0.0, 0.0, 0.0)]
            made = DiscreteActuator(action_name=_DEFAULT_ACTION, size=size, table=still)
        made.handler = self._action_handler
        self.actuators.append(made)

    def _is_end_asked(self) -> bool:
        return (
            self._done_requested
            or (self.done_at_negative_reward and self.ledger.total < 0)
            or (self.done_at_positive_reward and self.ledger.total > 0)
        )

    def _refuse(self, action: object) -> None:
        known = self.bound_blocks.actuators
        if isinstance(action, dict):
            for name in action:
                if name not in known:
                    raise ActionError(
                        _(
                            "agent {id!r} has no actuator {name!r}; {hint}",
                            id=self.id,
                            name=name,
                            hint=suggest(str(name), known),
                        )
                    ) from None
        sizes = {name: len(each.limits()[0]) for name, each in known.items()}
        example = {name: [0.0] * size for name, size in sizes.items() if size}
        raise ActionError(
            _(
                "agent {id!r}: expected an action by actuator name, such as {example}, got "
                "{action}",
                id=self.id,
                example=str(example),
                action=repr(action),
            )
        ) from None


def _table(agent: BasicAgent) -> str:
    """Return a line for each block: kind, class, name and parameters other than the default."""
    rows = [("", "block", "name", "parameters")]
    for kind, blocks in (
        ("sensor", agent.sensors),
        ("actuator", agent.actuators),
        ("reward", agent.rewards),
        ("brain", agent.brains),
    ):
        rows += [(kind, *_row(block)) for block in blocks]
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, [*widths, 0], strict=True)).rstrip()
        for row in rows
    ]
    return "\n".join([f"agent {agent.id!r} on body {agent.body_name!r}", *lines])


def _row(block: Block) -> tuple[str, str, str]:
    values = block.values()
    name = str(values.get("perception_key") or values.get("action_name") or values.get("name", ""))
    hidden = {"perception_key", "action_name", "name", "is_active", "enabled", "sensors"}
    shown = ", ".join(
        f"{key}={value!r}" for key, value in block.given().items() if key not in hidden
    )
    off = values.get("is_active") is False or values.get("enabled") is False
    return type(block).__name__, name, "off; " * off + shown
