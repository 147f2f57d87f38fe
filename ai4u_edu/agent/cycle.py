"""The decision cycle: the loop in which agents sense, decide and act.

The order is a contract::

    reset:     before_the_reset, blocks' on_reset, first sense, begin_of_episode
    sense:     begin_of_update_state, every active sensor reads, end_of_update_state
    decide:    the brain gets the percept and answers with an action (or a command)
    step:      reward := 0, begin_of_step
    each tick: on the first, or on all with repeat_action: begin_of_apply_action, all actuators
               that the action names act, in the action's order, end_of_apply_action; then the
               world ticks; then touched, area_left, area_entered if they have handlers; then
               actuators', reward functions' and sensors' on_tick
    end:       every reward function's on_update, end_of_step, steps += 1; the episode may be over:
               end_of_episode
    sense:     ... the reading that ends one decision is the one that begins the next;
               the episode may be over after it: end_of_episode

A reward is in exactly one decision, which env, ``agent.reward``, RewardSensor and the ledger show
alike: what is paid from begin_of_step to the reading after the step is in this decision, as is what
other agents pay at its last tick; what a controller pays while it decides is in the decision that
begins then. What is paid before the first decision is asked for (before_the_reset, the first sense,
begin_of_episode) or after the episode's end is dropped. ``request_done`` ends the episode with the
decision that gets the reward: asked for by a sensor or in end_of_update_state, it ends at once, and
sensors of the agent's own state (done, reward, truncated) read again; asked for before the first
decision, with that one.

The two events of applying an action fire once a tick, around all actuators together, also for an
action that names none. A body that falls out of the world during a step ends the step at that tick.

Each agent has an episode of its own, and they may end at different times. An agent whose episode is
over takes no more decisions: its body stays in the world, undriven, while the others go on. Its
brain is still asked, and two of its answers count:

- RESTART: a new episode for the world and all its agents, immediately, in place of the tick.
- RESPAWN: a new episode for this agent alone, after the tick, in the order of the reset::

    restart:   before_the_reset, the body goes back, blocks' on_reset, first sense, begin_of_episode

  The body is as after a reset: it holds nothing, is not held, and touches nothing until the next
  tick; its contacts end now, and a body that stands in its place is pushed aside. Stacked readings
  start over. The random generators are not reseeded, so episodes differ. The world's time and the
  other agents' blocks are not affected.

A brain that answers HOLD makes the world wait: the other brains are asked too, and their decisions
begin with the next tick that takes place.

Where many agents decide equally often, one tick has all the work of sensing and deciding, and the
next ones have none. ``spread_decisions`` gives each agent a time slot: the first agent decides at
ticks 0, 4, 8, the second one at 1, 5, 9. A decision that begins in another agent's slot, as an
episode's first one does, is shorter: it ends at its own agent's slot.
"""

import time
from collections.abc import Sequence

from ai4u_edu.agent.agent import BasicAgent, Numbers
from ai4u_edu.agent.episode_options import EpisodeOptions, Options
from ai4u_edu.agent.error_context import add_context
from ai4u_edu.agent.state import AgentMoment, DecisionState, Phase, SimState
from ai4u_edu.base.errors import NameNotFoundError, NoDecisionError, SetupError, shown, suggest
from ai4u_edu.base.seeding import checked_seed
from ai4u_edu.blocks import Actuator, Command, Percept, RewardFunc, Sensor
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import World

HOLD_LIMIT_S = 660.0
"""Time (s) for which a step waits for another agent's brain; a script may be silent for 600 s."""


class ControlRequestor:
    """A world and its agents, and the loop that lets them decide and act.

    Args:
        world: it contains the agents' bodies.
        agents: they are set up here; higher priority acts first, equal ones act in this order.
        default_time_scale: speed of time in a viewer; 1 is real time.
        goal: the task in words, shown to people.
        success: the reward term that is paid when the goal is reached; empty if there is none.
        spread_decisions: True gives each agent a time slot of its own to decide in; else all that
            decide equally often decide in the same tick.
        wait_for_key: True lets a page wait on each first frame until a person presses a key; only a
            runner with ``wait_for_key`` does so.

    >>> from ai4u_edu import BasicAgent, CircleShape, LocalBrain, RBMoveActuator, World
    >>> world = World()
    >>> robot = world.add_body("robot", CircleShape(radius=0.5))
    >>> agent = BasicAgent(
    ...     body="robot",
    ...     actuators=[RBMoveActuator(move_amount=2)],
    ...     brains=[LocalBrain(controller=lambda percept: {"move": [1, 0, 0, 0]})],
    ... )
    >>> sim = ControlRequestor(world, [agent])
    >>> sim.reset(seed=1)
    >>> for _ in range(12):
    ...     percept = sim.step()
    >>> round(world.time, 3), round(robot.position[0], 2)
    (1.0, 2.0)
    """

    def __init__(
        self,
        world: World,
        agents: Sequence[BasicAgent],
        *,
        default_time_scale: float = 1.0,
        goal: str = "",
        success: str = "",
        spread_decisions: bool = False,
        wait_for_key: bool = True,
    ) -> None:
        _check_members(world, agents)
        self.world = world
        self.agents = tuple(sorted(agents, key=lambda agent: -agent.priority))
        self.default_time_scale = default_time_scale
        self.goal = goal
        self.success = success
        self.spread_decisions = spread_decisions
        self.wait_for_key = wait_for_key
        self.is_seed_locked = False
        """True lets a reset without a seed repeat the present seed: the same start again."""
        self.episode = 0
        """Number of episodes of the world that have begun."""
        self.waiting_for_brain = False
        """True if the last tick did not take place because a brain answered HOLD."""
        self.options = EpisodeOptions(self)
        self.usual_options: Options | None = None
        """Options of resets that name none, while values are tried; None for the scene's own."""
        for agent in self.agents:
            agent.other_agents = len(self.agents) - 1
            agent.set_requestor(self)
        for agent in self.agents:
            agent.setup(world)
        self._cycles = [_DecisionCycle(agent) for agent in self.agents]
        self._respawning: list[_DecisionCycle] = []

    def agent(self, agent_id: str) -> BasicAgent:
        """Return the agent of an id.

        Raises:
            NameNotFoundError: no agent has it; the message suggests the nearest id.
        """
        for agent in self.agents:
            if agent.id == agent_id:
                return agent
        raise NameNotFoundError(
            _(
                "no agent has the id {agent_id}; {hint}",
                agent_id=repr(agent_id),
                hint=suggest(agent_id, [a.id for a in self.agents]),
            )
        )

    def reset(self, seed: int | None = None, options: Options | None = None) -> None:
        """Begin an episode, for the world and all its agents.

        Args:
            seed: the episode's seed; by default it follows from the last one, or is the same if
                :attr:`is_seed_locked`.
            options: numbers for this episode by name; see :class:`EpisodeOptions`. Default:
                :attr:`usual_options`.

        Raises:
            AI4UError: seed or options are wrong; then nothing has changed.
        """
        if seed is None and self.is_seed_locked:
            seed = self.world.seeds.seed
        if seed is not None:
            seed = checked_seed(seed)  # before the first handler of the reset runs
        with self.options.applied(self.usual_options if options is None else options):
            for agent in self.agents:
                if agent.before_the_reset.handlers:
                    agent.before_the_reset.fire(agent)
            self.world.reset(seed)
        self.episode += 1
        self._begin(self._cycles)

    def restart(self, *agents: BasicAgent) -> None:
        """Begin an episode for one agent or several; the world and the other agents go on.

        The body returns to its described place, or to that of a RespawnActuator. A decision that
        is under way ends without a reward.
        """
        self._restart([self._cycle_of(agent) for agent in agents])

    def tick(self) -> None:
        """Run one tick: agents that are due decide, all act, the world moves."""
        if self._decide():
            self._move()

    def step_decision(self) -> int:
        """Run a whole decision if nothing else has to happen at its ticks, else one tick.

        The result is the same as tick by tick, in less time.

        Returns:
            Number of ticks that have passed; 0 if a brain made the world wait.
        """
        if not self._decide():
            return 0
        cycle = self._cycles[0]
        if len(self._cycles) == 1 and cycle.can_run_to_end():
            ticks = cycle.run_to_end(self.world)
            cycle.agent.end_while_sensing()
            cycle.agent.settle()
            return ticks
        self._move()
        return 1

    def step(self, agent: BasicAgent | None = None) -> Percept:
        """Run until a decision of an agent, or its episode, is over.

        Args:
            agent: by default the first one.

        Returns:
            The agent's percept at that moment.

        Raises:
            NoDecisionError: another agent's brain made the world wait for :data:`HOLD_LIMIT_S`.
        """
        agent = agent or self.agents[0]
        cycle = self._cycle_of(agent)
        self.step_decision()
        held_since = None
        while cycle.under_way:
            self.tick()
            if self.waiting_for_brain:
                held_since = held_since or time.monotonic()
                if time.monotonic() - held_since > HOLD_LIMIT_S:
                    raise NoDecisionError(
                        _(
                            "agent {id!r} can't end its decision: another agent's brain has had "
                            "the world wait for {seconds:g} s",
                            id=agent.id,
                            seconds=HOLD_LIMIT_S,
                        )
                    )
            else:
                held_since = None
        return agent.percept

    def phase(self, agent: BasicAgent) -> Phase:
        """Return the progress of an agent's present or last decision."""
        return self._cycle_of(agent).phase()

    def is_deciding(self, agent: BasicAgent) -> bool:
        """Return True while a decision of an agent is under way."""
        return self._cycle_of(agent).under_way

    def between_decisions(self) -> bool:
        """Return True if no decision is under way, so that blocks and bodies may be changed."""
        return not any(cycle.under_way for cycle in self._cycles)

    def get_state(self, *, with_motions: bool = True) -> SimState:
        """Return all that has changed since the world was built, but for held keys.

        Args:
            with_motions: False leaves out the bodies' poses and speeds, which a snapshot has.
        """
        return SimState(
            self.episode,
            self.world.get_state(with_motions=with_motions),
            {cycle.agent.id: cycle.get_state() for cycle in self._cycles},
            dict(self.options.values),
        )

    def set_state(self, state: SimState) -> None:
        """Go on from the state of another world of the same scene.

        It goes on bit for bit as the other world does, also where a body presses on another one.
        Where a body presses on several others, the physics may take them in another order: they
        begin less than a centimetre apart, and may part further. Joints to what is held begin
        without their forces of the last tick, and so do all contacts if the state is a
        snapshot's or pymunk is not of a tested version. A brain keeps its own state if it is of
        another class, and so does an agent that the other world does not have.
        """
        self.reset(state.world.seed, state.options)
        self.world.set_state(state.world)
        self.episode = state.episode
        for cycle in self._cycles:
            if cycle.agent.id in state.agents:
                cycle.set_state(state.agents[cycle.agent.id])

    def _decide(self) -> bool:
        """Ask the brains of agents that are due; return True if the tick takes place."""
        self._respawning = []
        self.waiting_for_brain = False
        for slot, cycle in enumerate(self._cycles):
            if cycle.under_way:
                continue
            command = cycle.decide()
            if command is None:
                if self.spread_decisions:
                    cycle.align_to_slot(self.world.ticks - slot)
                continue
            if command is Command.RESTART:
                self.reset(cycle.agent.brain.restart_seed())
                return False
            if command is Command.RESPAWN:
                self._respawning.append(cycle)
            self.waiting_for_brain = self.waiting_for_brain or command is Command.HOLD
        if self.waiting_for_brain:
            self._restart(self._respawning)
        return not self.waiting_for_brain

    def _move(self) -> None:
        for cycle in self._cycles:
            if cycle.under_way:
                cycle.apply()
        self.world.tick()
        _settle([each.agent for each in self._cycles if each.under_way and each.advance()])
        if self._respawning:
            # after the tick, so that their first percept is not older than the one they decide on
            self._restart(self._respawning)

    def _restart(self, cycles: "list[_DecisionCycle]") -> None:
        for cycle in cycles:
            if cycle.agent.before_the_reset.handlers:
                cycle.agent.before_the_reset.fire(cycle.agent)
        for cycle in cycles:
            self.world.put_back(cycle.agent.body_name)
        self._begin(cycles)

    def _begin(self, cycles: "list[_DecisionCycle]") -> None:
        """Begin the agents' episodes, once the bodies are in their places."""
        for cycle in cycles:
            cycle.refresh_binding()
        for cycle in cycles:
            cycle.under_way = False
            cycle.agent.begin_episode()
        for cycle in cycles:
            agent = cycle.agent
            agent.sense()
            if agent.begin_of_episode.handlers:
                agent.begin_of_episode.fire(agent)
        for cycle in cycles:
            cycle.agent.settle_reset()

    def _cycle_of(self, agent: BasicAgent) -> "_DecisionCycle":
        return self._cycles[self.agents.index(agent)]


def _settle(agents: Sequence[BasicAgent]) -> None:
    """Finish the decisions of agents, once all that decide at this tick have paid and sensed."""
    for agent in agents:
        agent.end_while_sensing()
    for agent in agents:
        agent.settle()


class _DecisionCycle:
    """The state of one agent between its decisions.

    Args:
        agent: it has been set up.

    Attributes:
        under_way: True from the decision until the end of its last tick.
    """

    def __init__(self, agent: BasicAgent) -> None:
        self.agent = agent
        self.under_way = False
        self._tick = 0
        self._ticks = 1
        self._repeat = True
        self._action: list[tuple[Actuator, Numbers]] = []
        self._bound = agent.bound_blocks
        self._has_contact_handlers = False

    def decide(self) -> Command | None:
        """Ask the brain: return its command, or begin a step with its action."""
        agent = self.agent
        if agent.stopped:
            return None
        if agent.bound_blocks_or_none is not self._bound:
            self.refresh_binding()
        bound = self._bound
        bound.follow_switches()
        brain = bound.brain
        try:
            answer = brain.decide(agent.percept)
        except Exception as error:
            add_context(error, agent, brain, _("while {block} of {agent} was deciding"))
            raise
        if isinstance(answer, Command):
            if answer is not Command.HOLD:
                agent.apply_command(answer)
            return answer
        if agent.terminated or agent.truncated or agent.paused:
            return None
        self._action = agent.accept(answer)
        self._tick, self._ticks = 0, brain.skip_frame + 1
        self._repeat = brain.repeat_action
        self.under_way = True
        self._has_contact_handlers = agent.contacts.has_handlers
        agent.begin_step()
        return None

    def get_state(self) -> AgentMoment:
        """Return all that changes in the agent and its blocks."""
        numbers = tuple((actuator.action_name, values) for actuator, values in self._action)
        phase = Phase(self._tick, self._ticks, self._repeat)
        return AgentMoment(
            self.agent.get_state(),
            self.agent.ledger.get_state(),
            DecisionState(self.under_way, phase, numbers),
            {place: block.get_state() for place, block in self._bound.places()},
        )

    def set_state(self, state: AgentMoment) -> None:
        """Go on from the state of the same agent in another copy of the world."""
        agent, decision = self.agent, state.decision
        for place, block in self._bound.places():
            if place in state.blocks:
                block.set_state(state.blocks[place])
        agent.ledger.set_state(state.ledger)
        agent.set_state(state.values)
        actuators = self._bound.actuators
        self.under_way = decision.under_way
        self._tick, self._ticks, self._repeat = decision.phase
        self._has_contact_handlers = agent.contacts.has_handlers
        self._action = [
            (actuators[name], numbers) for name, numbers in decision.action if name in actuators
        ]

    def refresh_binding(self) -> None:
        """Use the agent's present blocks.

        Raises:
            SetupError: the agent has been set up in another world.
        """
        bound = self.agent.bound_blocks
        if bound.world is not self._bound.world:
            raise SetupError(
                _(
                    "agent {id!r} was set up in another world since; make one for each",
                    id=self.agent.id,
                )
            )
        self._bound = bound

    def align_to_slot(self, ticks: int) -> None:
        """Shorten a decision that has just begun, so that it ends at the agent's time slot.

        Args:
            ticks: ticks since any earlier slot of the agent.
        """
        if self.under_way:
            self._ticks -= ticks % self._ticks

    def apply(self) -> None:
        """Let the actuators act, if they do at this tick."""
        if self._tick and not self._repeat:
            return
        agent, body = self.agent, self._bound.body
        if agent.begin_of_apply_action.handlers:
            agent.begin_of_apply_action.fire(agent)
        actuator: Actuator | None = None
        try:
            for actuator, numbers in self._action:
                actuator.act(body, numbers)
        except Exception as error:
            add_context(error, agent, actuator, _("while {block} of {agent} was acting"))
            raise
        if agent.end_of_apply_action.handlers:
            agent.end_of_apply_action.fire(agent)

    def advance(self) -> bool:
        """Count a tick and run the blocks' on_tick; after the last tick end the step and sense.

        Returns:
            True if it was the last tick.
        """
        bound = self._bound
        self._tick += 1
        if self._has_contact_handlers:
            self.agent.contacts.fire(self.agent, bound.body, bound.view)
        block: Actuator | RewardFunc | Sensor | None = None
        try:
            for block in bound.tick_actuators:
                block.on_tick(bound.body, bound.view)
            for block in bound.tick_rewards:
                block.on_tick(bound.body, bound.view)
            for block in bound.tick_sensors:
                if block.is_active:
                    block.on_tick(bound.body, bound.view)
        except Exception as error:
            add_context(error, self.agent, block, _("while {block} of {agent} was in its on_tick"))
            raise
        is_last = self._tick >= self._ticks or bound.body.fallen
        if is_last:
            self._end()
        return is_last

    def phase(self) -> Phase:
        """Return the progress of the decision under way, or of the last one."""
        if self.under_way or self.agent.steps:
            return Phase(self._tick, self._ticks, self._repeat)
        brain = self._bound.brain
        return Phase(0, brain.skip_frame + 1, brain.repeat_action)

    def can_run_to_end(self) -> bool:
        """Return True if nothing but acting and ticking happens until the step's end."""
        agent, bound = self.agent, self._bound
        return self.under_way and not (
            bound.tick_actuators
            or bound.tick_rewards
            or bound.tick_sensors
            or self._has_contact_handlers
            or agent.begin_of_apply_action.handlers
            or agent.end_of_apply_action.handlers
        )

    def run_to_end(self, world: World) -> int:
        """Run the rest of the step, with the same result as tick by tick; return the ticks."""
        began = world.ticks
        body, tick, action = self._bound.body, world.tick, self._action
        acting_ticks = self._ticks if self._repeat else 1
        actuator: Actuator | None = None
        try:
            for index in range(self._tick, self._ticks):
                if index < acting_ticks:
                    for actuator, numbers in action:
                        actuator.act(body, numbers)
                    actuator = None  # an error of the tick is no actuator's
                tick()
                if body.fallen:
                    break
        except Exception as error:
            if actuator is not None:
                add_context(error, self.agent, actuator, _("while {block} of {agent} was acting"))
            raise
        ticks = world.ticks - began
        self._end()
        return ticks

    def _end(self) -> None:
        self.under_way = False
        self.agent.end_step()
        self.agent.sense()


def _check_members(world: object, agents: object) -> None:
    """Check the arguments of a ControlRequestor.

    Raises:
        SetupError: no world or no list of agents, or two agents with the same id or body.
    """
    example = "as in ControlRequestor(world, [agent])"
    if not isinstance(world, World):
        raise SetupError(
            _("expected a World first, {example}, got {got}", example=example, got=_shown(world))
        )
    if not isinstance(agents, Sequence) or isinstance(agents, str):
        got = _shown(agents)
        raise SetupError(
            _("expected a list of agents, {example}, got {got}", example=example, got=got)
        )
    for agent in agents:
        if not isinstance(agent, BasicAgent):
            got = _shown(agent)
            raise SetupError(
                _("expected agents in the list, {example}, got {got}", example=example, got=got)
            )
    if not agents:
        raise SetupError(_("expected at least one agent, got none"))
    _check_unique(agents)


def _check_unique(agents: Sequence[BasicAgent]) -> None:
    """Raise SetupError if two agents have the same id or the same body."""
    for index, agent in enumerate(agents):
        for other in agents[:index]:
            if agent.id == other.id:
                problem = SetupError(
                    _("two agents have the id {id!r}; ids are unique", id=agent.id)
                )
                problem.where = (agent, "id")
                raise problem
            if agent.body_name == other.body_name:
                problem = SetupError(
                    _(
                        "agents {id!r} and {id2!r} have the same body {body!r}; expected a "
                        "body for each",
                        id=other.id,
                        id2=agent.id,
                        body=agent.body_name,
                    )
                )
                problem.where = (agent, "body")
                raise problem


def _shown(value: object) -> str:
    if isinstance(value, type):
        return _("the class {name}", name=value.__name__)
    return f"{type(value).__name__} {shown(value)}"
