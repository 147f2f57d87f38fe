"""An agent: a body, the blocks on it, and one brain."""

from pydantic import Field

from ai4u_edu.agent.events import Event
from ai4u_edu.agent.fitting import Fitting
from ai4u_edu.agent.ledger import HANDLERS, Ledger
from ai4u_edu.agent.table import table
from ai4u_edu.blocks import Action, Actuator, Brain, Command, Keyboard, Percept, RewardFunc, Sensor
from ai4u_edu.blocks.brains.command import Accepted
from ai4u_edu.blocks.declared import Declared
from ai4u_edu.errors import ActionError, SetupError, suggest
from ai4u_edu.parameters import Count, Name, Number, WholeNumber
from ai4u_edu.world import Body, World, WorldView

Numbers = tuple[float, ...]


class BasicAgent(Declared):
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
    done_at_positive_reward: bool = False
    reward_scale: Number = 1.0
    """Every reward is multiplied by this."""
    sensors: list[Sensor] = Field(default_factory=list)
    actuators: list[Actuator] = Field(default_factory=list)
    rewards: list[RewardFunc] = Field(default_factory=list)
    brains: list[Brain] = Field(default_factory=list)

    def __post_init__(self) -> None:
        self.keyboard = Keyboard()
        self.ledger = Ledger()
        self.episode = 0
        """How many episodes it has begun; those that it began alone count too."""
        self.companions = 0
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
        self._fitting: Fitting | None = None
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

    # -- what can be asked -----------------------------------------------------------------------

    @property
    def fitting(self) -> Fitting:
        """How the blocks sit on the body; made by :meth:`setup`."""
        if self._fitting is None:
            raise SetupError(
                f"agent {self.id!r} is in no world yet; expected ControlRequestor(world, [agent])"
            )
        return self._fitting

    @property
    def body(self) -> Body:
        """The agent's body."""
        return self.fitting.body

    @property
    def view(self) -> WorldView:
        """The world, to be asked."""
        return self.fitting.view

    @property
    def brain(self) -> Brain:
        """The one brain that is enabled."""
        return self.fitting.brain

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

    def setup(self, world: World) -> None:
        """Puts the blocks on the body; checks that all fits together."""
        self._fitting = Fitting(self, world)
        self.agent_start.fire(self)

    def add_reward(self, amount: float, request_done: bool = False, name: str = HANDLERS) -> None:
        """Adds to the reward of the decision that is under way; from any event's handler.

        Args:
            amount: how much; multiplied by reward_scale.
            request_done: whether the episode ends with this decision.
            name: the term under which it is booked.
        """
        self.ledger.pay(name, amount * self.reward_scale)
        self._done_requested = self._done_requested or request_done

    def use_brain(self, brain: Brain) -> None:
        """Gives the agent another brain; it takes the next decision. The body stays as it is."""
        self.fitting.swap_brain(brain)

    # -- the steps of a decision; ControlRequestor calls them ------------------------------------

    def begin_episode(self) -> None:
        """Forgets the last episode and resets all blocks."""
        self.ledger.clear()
        self.episode += 1
        self.steps = 0
        self.terminated = self.truncated = self.paused = self.stopped = False
        self._done_requested = False
        self.last_action = {}
        self.fitting.reset()

    def sense(self) -> Percept:
        """Every active sensor reads once."""
        fitting = self.fitting
        if self.begin_of_update_state.handlers:
            self.begin_of_update_state.fire(self)
        self._percept = fitting.sense()
        if self.end_of_update_state.handlers:
            self.end_of_update_state.fire(self)
        return self._percept

    def see(self, percept: Percept) -> None:
        """Puts another percept in place of the last one: what it is made from was changed."""
        self._percept = percept

    def obey(self, command: Command) -> None:
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
        actuators = self.fitting.actuators
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
        fitting = self.fitting
        if fitting.pay(self.ledger, self.reward_scale):
            self._done_requested = True
        if self.end_of_step.handlers:
            self.end_of_step.fire(self)
        self.steps += 1
        self.ledger.close(self.steps)
        total = self.ledger.total
        self.terminated = (
            self._done_requested
            or fitting.body.fallen
            or (self.done_at_negative_reward and total < 0)
            or (self.done_at_positive_reward and total > 0)
        )
        limit = self.max_steps_per_episode
        self.truncated = not self.terminated and 0 < limit <= self.steps
        if self.end_of_episode.handlers and self.done:
            self.end_of_episode.fire(self)

    def _refuse(self, action: object) -> None:
        known = self.fitting.actuators
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
