"""The decision cycle: the one place where an agent acts.

The order is a contract::

    reset:     before_the_reset, blocks' on_reset, first sense, begin_of_episode
    sense:     begin_of_update_state, every active sensor reads, end_of_update_state
    decide:    the brain gets the percept and answers with an action (or a command)
    step:      reward := 0, begin_of_step
    each tick: on the first, or on all with repeat_action: begin_of_apply_action, the actuators
               act, end_of_apply_action; then the world ticks
    end:       every reward function's on_update, end_of_step, steps += 1; the episode may be over:
               end_of_episode
    sense:     ... the reading that ends one decision is the one that begins the next

A body that falls out of the world in the middle of a cycle ends the cycle there.
"""

from collections.abc import Sequence

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.agent import Numbers
from ai4u_edu.blocks import Actuator, Command, Percept
from ai4u_edu.errors import NameNotFoundError, SetupError, suggest
from ai4u_edu.world import World


class _Cycle:
    """One agent's place in its decision cycle."""

    def __init__(self, agent: BasicAgent) -> None:
        self.agent = agent
        self.under_way = False
        self._tick = 0
        self._ticks = 1
        self._repeat = True
        self._action: list[tuple[Actuator, Numbers]] = []

    def decide(self) -> Command | None:
        """Asks the brain; a command is handed back, an action begins a step."""
        agent = self.agent
        if agent.stopped:
            return None
        answer = agent.brain.decide(agent.percept)
        if isinstance(answer, Command):
            return answer
        if agent.done or agent.paused:
            return None
        self._action = agent.accept(answer)
        self._tick, self._ticks = 0, agent.brain.skip_frame + 1
        self._repeat = agent.brain.repeat_action
        self.under_way = True
        agent.begin_step()
        return None

    def apply(self) -> None:
        """Lets the actuators act, if it is a tick on which they do."""
        if self._tick and not self._repeat:
            return
        agent = self.agent
        body = agent.body
        for actuator, numbers in self._action:
            if agent.begin_of_apply_action.handlers:
                agent.begin_of_apply_action.fire(agent)
            actuator.act(body, numbers)
            if agent.end_of_apply_action.handlers:
                agent.end_of_apply_action.fire(agent)

    def advance(self) -> None:
        """A tick is over; the last one ends the step and senses anew."""
        agent = self.agent
        self._tick += 1
        for reward in agent.fitting.tick_rewards:
            reward.on_tick(agent.body, agent.view)
        if self._tick >= self._ticks or agent.body.fallen:
            self.under_way = False
            agent.end_step()
            agent.sense()


class ControlRequestor:
    """A world and its agents, and the loop that lets them decide and act.

    Args:
        world: where the agents' bodies are.
        agents: set up here; those of higher priority act first, equal ones in this order.
        default_time_scale: how fast a viewer lets the time run; 1 is real time.

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
        self, world: World, agents: Sequence[BasicAgent], *, default_time_scale: float = 1.0
    ) -> None:
        if not agents:
            raise SetupError("expected at least one agent, got none")
        ids = [agent.id for agent in agents]
        for index, agent in enumerate(agents):
            if agent.id in ids[:index]:
                raise SetupError(f"two agents have the id {agent.id!r}; ids are unique")
        self.world = world
        self.agents = tuple(sorted(agents, key=lambda agent: -agent.priority))
        self.default_time_scale = default_time_scale
        self.episode = 0
        """How many episodes have begun."""
        for agent in self.agents:
            agent.setup(world)
        self._cycles = [_Cycle(agent) for agent in self.agents]

    def agent(self, agent_id: str) -> BasicAgent:
        """The agent of that id."""
        for agent in self.agents:
            if agent.id == agent_id:
                return agent
        raise NameNotFoundError(
            f"no agent has the id {agent_id!r}; {suggest(agent_id, [a.id for a in self.agents])}"
        )

    def reset(self, seed: int | None = None) -> None:
        """Begins an episode, for the world and all its agents.

        Args:
            seed: of the episode; left out, it follows from the last one's.
        """
        for agent in self.agents:
            if agent.before_the_reset.handlers:
                agent.before_the_reset.fire(agent)
        self.world.reset(seed)
        self.episode += 1
        for cycle in self._cycles:
            cycle.under_way = False
            cycle.agent.begin_episode()
        for agent in self.agents:
            agent.sense()
            if agent.begin_of_episode.handlers:
                agent.begin_of_episode.fire(agent)

    def tick(self) -> None:
        """One tick: agents whose turn it is decide, all act, the world moves."""
        for cycle in self._cycles:
            if not cycle.under_way and self._obey(cycle.agent, cycle.decide()):
                return  # a new episode has begun
        for cycle in self._cycles:
            if cycle.under_way:
                cycle.apply()
        self.world.tick()
        for cycle in self._cycles:
            if cycle.under_way:
                cycle.advance()

    def step(self, agent: BasicAgent | None = None) -> Percept:
        """Ticks until a decision of an agent (the first one) is over, or its episode is.

        Returns:
            What the agent senses then.
        """
        agent = agent or self.agents[0]
        cycle = self._cycles[self.agents.index(agent)]
        self.tick()
        while cycle.under_way:
            self.tick()
        return agent.percept

    def between_decisions(self) -> bool:
        """Whether no agent is in the middle of a step: the time to change things."""
        return not any(cycle.under_way for cycle in self._cycles)

    def _obey(self, agent: BasicAgent, command: Command | None) -> bool:
        """Carries a brain's command out; whether a new episode has begun by it."""
        match command:
            case Command.RESTART:
                self.reset()
                return True
            case Command.PAUSE:
                agent.paused = True
            case Command.RESUME:
                agent.paused = False
            case Command.STOP:
                agent.stopped = True
        return False
