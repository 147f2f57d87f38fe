"""An agent: a body, the blocks on it, and one brain."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any
from weakref import ReferenceType, ref

from pydantic import Field, field_validator

from ai4u_edu.agent.bound_blocks import BoundBlocks
from ai4u_edu.agent.events import Event
from ai4u_edu.agent.ledger import HANDLERS, Ledger
from ai4u_edu.agent.options import set_action_handler
from ai4u_edu.agent.table import table
from ai4u_edu.base.deprecation import RenamedAttribute
from ai4u_edu.base.errors import ActionError, ReadingError, SetupError, suggest
from ai4u_edu.base.parameters import Count, Name, Number, WholeNumber
from ai4u_edu.blocks import (
    Action,
    Actuator,
    AgentArraySensor,
    Answer,
    Brain,
    Command,
    Controller,
    Keyboard,
    LocalBrain,
    Percept,
    RewardFunc,
    Sensor,
)
from ai4u_edu.blocks.brains.command import Accepted
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.world import Body, World, WorldView

Numbers = tuple[float, ...]


class BasicAgent(Parameterized):
    """A body plus blocks (sensors, actuators, reward functions) plus exactly one enabled brain.

    Events are attributes: ``agent.end_of_step.connect(f)``, and so on for all of
    :data:`~ai4u_edu.agent.events.EVENTS`. ``print(agent)`` shows all blocks in a table.

    Source: AI4U's BasicAgent.
    """

    body_name: Name = Field(alias="body")
    """The name of the agent's body in the world."""
    id: Name = "0"
    priority: WholeNumber = 0
    """Agents with a higher one act first."""
    max_steps_per_episode: Count = 0
    """Decisions after which the episode is cut off (truncated); 0 for no limit."""
    done_at_negative_reward: bool = False
    """True ends the episode after a decision whose rewards sum up to less than 0."""
    done_at_positive_reward: bool = False
    """True ends the episode after a decision whose rewards sum up to more than 0."""
    reward_scale: Number = 1.0
    """Every reward is multiplied by this."""
    array_input_size: Annotated[int, Field(ge=0, le=1024)] = 0
    """Numbers that a script can set for the agent to sense (see ``array_sensor``); 0 for none."""
    range_min: Number = 0.0
    """The lowest of these numbers."""
    range_max: Number = 1.0
    """The highest of these numbers."""
    action_size: Annotated[int, Field(ge=0, le=1024)] = 0
    """Numbers (or choices) of an action "defaultAction", which ``action_handler`` carries out; 0
    for none, or for one if there is a handler."""
    action_is_continuous: bool = True
    """True makes "defaultAction" of numbers from -1 to 1; False, of one choice."""
    check_episode_truncated: bool = False
    """True adds a TruncatedSensor: the agent senses that its episode was cut off."""
    sensors: list[Sensor] = Field(default_factory=list)
    actuators: list[Actuator] = Field(default_factory=list)
    rewards: list[RewardFunc] = Field(default_factory=list)
    brains: list[Brain] = Field(default_factory=list)

    @field_validator("brains", mode="before")
    @classmethod
    def _with_brains(cls, brains: Any) -> Any:
        if not isinstance(brains, list | tuple):
            return brains
        return [as_brain(each) if _drives(each) else each for each in brains]

    def __post_init__(self) -> None:
        self.keyboard = Keyboard()
        self.ledger = Ledger()
        self.episode = 0
        """How many episodes it has begun; those that it began alone count too."""
        self.other_agents = 0
        """How many other agents are in its world."""
        self.steps = 0
        """Decisions taken in this episode."""
        self.terminated = False
        """Whether the episode ended by what happened in it."""
        self.truncated = False
        """Whether the episode was cut off by the step limit."""
        self.paused = False
        self.stopped = False
        self.last_action: dict[str, Numbers] = {}
        self._action_handler: Callable[..., None] | None = None
        self._requestor: ReferenceType[object] | None = None
        self._bound_blocks: BoundBlocks | None = None
        self._percept: Percept | None = None
        self._done_requested = False
        self.agent_start = Event("agent_start")
        self.before_the_reset = Event("before_the_reset")
        self.begin_of_episode = Event("begin_of_episode")
        self.begin_of_update_state = Event("begin_of_update_state")
        self.end_of_update_state = Event("end_of_update_state")
        self.begin_of_step = Event("begin_of_step")
        self.begin_of_apply_action = Event("begin_of_apply_action")
        self.end_of_apply_action = Event("end_of_apply_action")
        self.end_of_step = Event("end_of_step")
        self.end_of_episode = Event("end_of_episode")

    if not TYPE_CHECKING:  # a type checker is to report the old names
        fitting = RenamedAttribute("bound_blocks")
        companions = RenamedAttribute("other_agents")
        see = RenamedAttribute("replace_percept")
        obey = RenamedAttribute("apply_command")

    # -- what can be asked -----------------------------------------------------------------------

    @property
    def bound_blocks(self) -> BoundBlocks:
        """How the blocks sit on the body; made by :meth:`setup`."""
        if self._bound_blocks is None:
            raise SetupError(
                f"agent {self.id!r} is in no world yet; expected ControlRequestor(world, [agent])"
            )
        return self._bound_blocks

    @property
    def bound_blocks_or_none(self) -> BoundBlocks | None:
        """The blocks as they are set up; None before :meth:`setup`."""
        return self._bound_blocks

    @property
    def requestor(self) -> object | None:
        """The ControlRequestor that the agent belongs to, as long as that exists."""
        return None if self._requestor is None else self._requestor()

    @property
    def array_sensor(self) -> AgentArraySensor | None:
        """The sensor that ``array_input_size`` added: ``agent.array_sensor.set_value(0, 0.5)``."""
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
                f"agent {self.id!r}: action_handler: expected a function, as in "
                f"agent.action_handler = lambda body, numbers: ..., got {handler!r}"
            )
        self._action_handler = handler
        set_action_handler(self)

    @property
    def body(self) -> Body:
        """The agent's body."""
        return self.bound_blocks.body

    @property
    def view(self) -> WorldView:
        """The world, to be asked."""
        return self.bound_blocks.view

    @property
    def brain(self) -> Brain:
        """The one brain that is enabled."""
        return self.bound_blocks.brain

    @property
    def percept(self) -> Percept:
        """What was sensed last: the percept that the brain gets, or got."""
        if self._percept is None:
            raise SetupError(f"agent {self.id!r} has sensed nothing yet; expected a reset first")
        return self._percept

    @property
    def done(self) -> bool:
        """Whether the episode is over."""
        return self.terminated or self.truncated

    @property
    def reward(self) -> float:
        """The reward of the last decision."""
        return self.ledger.total

    @property
    def reward_terms(self) -> dict[str, float]:
        """The reward of the last decision, by named term."""
        return dict(self.ledger.terms)

    def __str__(self) -> str:
        return table(self)

    # -- what can be done ------------------------------------------------------------------------

    def set_requestor(self, requestor: object) -> None:
        """Say which ControlRequestor has the agent from now on; it is not kept alive by that."""
        self._requestor = ref(requestor)

    def setup(self, world: World) -> None:
        """Put the blocks on the body, and check that all fits together.

        An agent may be set up again, in this world or in another one: it begins anew there, and a
        ControlRequestor that had it in another world refuses to go on with it.

        Raises:
            SetupError: something does not fit, or an agent beside this one has a block of it.
        """
        self._bound_blocks = BoundBlocks(self, world)
        self.agent_start.fire(self)

    def add_reward(self, amount: float, request_done: bool = False, name: str = HANDLERS) -> None:
        """Adds to the reward of the decision that is under way; from any event's handler.

        Args:
            amount: how much, a finite number; multiplied by reward_scale.
            request_done: whether the episode ends with this decision.
            name: the term under which it is booked.

        Raises:
            ReadingError: the amount is no number, or not finite.
        """
        try:
            paid = float(amount) * self.reward_scale
        except (TypeError, ValueError):
            paid = math.nan
        if not math.isfinite(paid):
            raise ReadingError(
                f"agent {self.id!r}, add_reward of {name!r}: expected a finite number, "
                f"got {amount!r}"
            )
        self.ledger.pay(name, paid)
        self._done_requested = self._done_requested or request_done

    def use_brain(self, brain: Brain | Controller | Callable[[Percept], Answer]) -> None:
        """Gives the agent another brain; it takes the next decision. The body stays as it is.

        Args:
            brain: a brain; or a controller or a function from percept to action, for which a
                LocalBrain is made.

        Raises:
            SetupError: it is none of these, or it does not fit the agent.
        """
        self.bound_blocks.swap_brain(as_brain(brain))

    # -- the steps of a decision; ControlRequestor calls them ------------------------------------

    def begin_episode(self) -> None:
        """Forgets the last episode and resets all blocks."""
        self.ledger.clear()
        self.episode += 1
        self.steps = 0
        self.terminated = self.truncated = self.paused = self.stopped = False
        self._done_requested = False
        self.last_action = {}
        self.bound_blocks.reset()

    def sense(self) -> Percept:
        """Every active sensor reads once."""
        bound = self.bound_blocks
        if self.begin_of_update_state.handlers:
            self.begin_of_update_state.fire(self)
        self._percept = bound.sense()
        if self.end_of_update_state.handlers:
            self.end_of_update_state.fire(self)
        return self._percept

    def replace_percept(self, percept: Percept) -> None:
        """Puts another percept in place of the last one: what it is made from was changed."""
        self._percept = percept

    def apply_command(self, command: Command) -> None:
        """What a brain's command changes in the agent itself."""
        match command:
            case Command.PAUSE:
                self.paused = True
            case Command.RESUME:
                self.paused = False
            case Command.STOP:
                self.stopped = True

    def accept(self, action: Action) -> list[tuple[Actuator, Numbers]]:
        """Checks an action and finds its actuators.

        Raises:
            ActionError: it names an actuator that there is not, or its numbers don't fit.
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
        """A decision was taken: nothing is paid for it yet."""
        if self.steps:
            self.ledger.open()
        else:
            self.ledger.clear()  # what was added before the first decision belongs to none
        if self.begin_of_step.handlers:
            self.begin_of_step.fire(self)

    def end_step(self) -> None:
        """The decision's last tick is over: pays, and finds out whether the episode ends."""
        bound = self.bound_blocks
        if bound.pay(self.ledger, self.reward_scale):
            self._done_requested = True
        if self.end_of_step.handlers:
            self.end_of_step.fire(self)
        self.steps += 1
        self.ledger.close(self.steps)
        total = self.ledger.total
        self.terminated = (
            self._done_requested
            or bound.body.fallen
            or (self.done_at_negative_reward and total < 0)
            or (self.done_at_positive_reward and total > 0)
        )
        limit = self.max_steps_per_episode
        self.truncated = not self.terminated and 0 < limit <= self.steps
        if self.end_of_episode.handlers and self.done:
            self.end_of_episode.fire(self)

    def _refuse(self, action: object) -> None:
        known = self.bound_blocks.actuators
        if isinstance(action, dict):
            for name in action:
                if name not in known:
                    raise ActionError(
                        f"agent {self.id!r} has no actuator {name!r}; {suggest(str(name), known)}"
                    ) from None
        example = {name: [0.0] * len(each.limits()[0]) for name, each in known.items()}
        raise ActionError(
            f"agent {self.id!r}: expected an action by actuator name, such as {example}, "
            f"got {action!r}"
        ) from None


def as_brain(given: object) -> Brain:
    """Return a brain as it is, and a LocalBrain for a controller or a function.

    Raises:
        SetupError: it is neither.
    """
    if isinstance(given, Brain):
        return given
    if _drives(given):
        return LocalBrain(controller=given)  # type: ignore[arg-type]  # _drives looked at it
    problem = f"the class {given.__name__}" if isinstance(given, type) else repr(given)
    raise SetupError(
        f"expected a brain, a controller or a function from percept to action, got {problem}; "
        "a brain is made as in LocalBrain(controller=WASDRBMoveController())"
    )


def _drives(given: object) -> bool:
    """Return True for a controller or a function, of which a LocalBrain can be made."""
    if isinstance(given, Controller):
        return True
    return callable(given) and not isinstance(given, type | Parameterized)
