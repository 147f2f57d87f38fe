"""The decision cycle: the one place where an agent acts.

The order is a contract::

    reset:     before_the_reset, blocks' on_reset, first sense, begin_of_episode
    sense:     begin_of_update_state, every active sensor reads, end_of_update_state
    decide:    the brain gets the percept and answers with an action (or a command)
    step:      reward := 0, begin_of_step
    each tick: on the first, or on all with repeat_action: begin_of_apply_action, all actuators
               that the action names act, in the action's order, end_of_apply_action; then the
               world ticks; then actuators' and reward functions' on_tick
    end:       every reward function's on_update, end_of_step, steps += 1; the episode may be over:
               end_of_episode
    sense:     ... the reading that ends one decision is the one that begins the next

The two events of applying an action fire once a tick, around all actuators together, and also where
an action names none. A body that falls out of the world in the middle of a cycle ends the cycle
there.

Each agent has an episode of its own, and they may end at different times. An agent whose episode is
over takes no more decisions: its body stays in the world, undriven, and the others go on. Its brain
is still asked, and two of its answers count:

- RESTART: a new episode for the world and all its agents, at once, in place of the tick.
- RESPAWN: a new episode for this agent alone, when the tick is over, in the order of the reset::

    restart:   before_the_reset, the body goes back, blocks' on_reset, first sense, begin_of_episode

  The body is as after a reset: it lets go, is let go of, and touches nothing until the next tick;
  whoever touched it touched it until now, and what stands in its place is pushed aside. Stacked
  readings begin anew. Chance goes on where it was, so another episode is another one; the clock and
  the blocks of the others know nothing of it.

A brain that answers HOLD has the world wait: the others are asked as well, and what they decide
begins with the tick that takes place at last.

Where many agents decide equally often, one tick has all the work of sensing and deciding, and the
next ones have none. With ``spread_decisions`` each has a turn: the first agent decides at ticks 0,
4, 8, the second one at 1, 5, 9. A decision that begins at another agent's turn, as an episode's
first one does, is shorter: it ends at its own agent's turn.
"""

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.agent import Numbers
from ai4u_edu.agent.error_context import add_context
from ai4u_edu.agent.members import check_members
from ai4u_edu.base.deprecation import RenamedAttribute
from ai4u_edu.base.errors import NameNotFoundError, NoDecisionError, SetupError, suggest
from ai4u_edu.base.seeding import checked_seed
from ai4u_edu.blocks import Actuator, Command, Percept, RewardFunc
from ai4u_edu.world import Body, World

HOLD_LIMIT_S = 660.0
"""Seconds for which a step waits for another agent's brain; a script may be silent for 600."""


class Phase(NamedTuple):
    """How far an agent is in its decision."""

    tick: int = 0
    """How many ticks of it have passed; all of them once it is over, 0 before the first one."""
    ticks: int = 1
    """How many ticks it takes."""
    repeats: bool = True
    """Whether the actuators act at every tick, or only at the first."""


class _Cycle:
    """One agent's place in its decision cycle."""

    def __init__(self, agent: BasicAgent) -> None:
        self.agent = agent
        self.under_way = False
        self._tick = 0
        self._ticks = 1
        self._repeat = True
        self._action: list[tuple[Actuator, Numbers]] = []
        self._bound_blocks = agent.bound_blocks

    def decide(self) -> Command | None:
        """Asks the brain; a command is handed back, an action begins a step."""
        agent = self.agent
        if agent.stopped:
            return None
        bound = agent.bound_blocks
        if bound is not self._bound_blocks:
            self.refresh_binding()
        brain = bound.brain
        try:
            answer = brain.decide(agent.percept)
        except Exception as error:
            add_context(error, agent, brain, "was deciding")
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
        agent.begin_step()
        return None

    def refresh_binding(self) -> None:
        """Take up the agent's bound; raise SetupError if it is in another world by now."""
        bound = self.agent.bound_blocks
        if bound.world is not self._bound_blocks.world:
            raise SetupError(
                f"agent {self.agent.id!r} was set up in another world since; make one for each"
            )
        self._bound_blocks = bound

    def align_to_slot(self, ticks: int) -> None:
        """Has a decision end at the agent's turn, if one has just begun, and not there.

        Args:
            ticks: how long ago a turn of it was, any of them.
        """
        if self.under_way:
            self._ticks -= ticks % self._ticks

    def apply(self) -> None:
        """Lets the actuators act, if it is a tick on which they do."""
        if self._tick and not self._repeat:
            return
        agent, body = self.agent, self._bound_blocks.body
        if agent.begin_of_apply_action.handlers:
            agent.begin_of_apply_action.fire(agent)
        self._act(body)
        if agent.end_of_apply_action.handlers:
            agent.end_of_apply_action.fire(agent)

    def _act(self, body: Body) -> None:
        actuator: Actuator | None = None
        try:
            for actuator, numbers in self._action:
                actuator.act(body, numbers)
        except Exception as error:
            add_context(error, self.agent, actuator, "was acting")
            raise

    def advance(self) -> None:
        """A tick is over; the last one ends the step and senses anew."""
        bound = self._bound_blocks
        self._tick += 1
        block: Actuator | RewardFunc | None = None
        try:
            for block in bound.tick_actuators:
                block.on_tick(bound.body, bound.view)
            for block in bound.tick_rewards:
                block.on_tick(bound.body, bound.view)
        except Exception as error:
            add_context(error, self.agent, block, "was in its on_tick")
            raise
        if self._tick >= self._ticks or bound.body.fallen:
            self._end()

    def phase(self) -> Phase:
        """How far it is."""
        if self.under_way or self.agent.steps:
            return Phase(self._tick, self._ticks, self._repeat)
        brain = self._bound_blocks.brain
        return Phase(0, brain.skip_frame + 1, brain.repeat_action)

    def can_run_to_end(self) -> bool:
        """Whether a step has begun, and nothing but acting and ticking happens until its end."""
        agent, bound = self.agent, self._bound_blocks
        return self.under_way and not (
            bound.tick_actuators
            or bound.tick_rewards
            or agent.begin_of_apply_action.handlers
            or agent.end_of_apply_action.handlers
        )

    def run_to_end(self, world: World) -> int:
        """The rest of a step at one go, as one tick after another would do it; the ticks."""
        began = world.ticks
        body, tick = self._bound_blocks.body, world.tick
        for index in range(self._tick, self._ticks):
            if self._repeat or not index:
                self._act(body)
            tick()
            if body.fallen:
                break
        ticks = world.ticks - began
        self._end()
        return ticks

    def _end(self) -> None:
        self.under_way = False
        self.agent.end_step()
        self.agent.sense()


class ControlRequestor:
    """A world and its agents, and the loop that lets them decide and act.

    Args:
        world: where the agents' bodies are.
        agents: set up here; those of higher priority act first, equal ones in this order.
        default_time_scale: how fast a viewer lets the time run; 1 is real time.
        goal: what is to be done, in words, for those who look.
        success: the reward term that is paid when it is done; empty if there is none.
        spread_decisions: whether agents take turns in deciding; else all decide in the same tick,
            if they decide equally often.

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
    ) -> None:
        check_members(world, agents)
        self.world = world
        self.agents = tuple(sorted(agents, key=lambda agent: -agent.priority))
        self.default_time_scale = default_time_scale
        self.goal = goal
        self.success = success
        self.spread_decisions = spread_decisions
        self.episode = 0
        """How many episodes of the world have begun."""
        self.waiting_for_brain = False
        """Whether the last tick did not take place, because a brain has the world wait for it."""
        for agent in self.agents:
            agent.other_agents = len(self.agents) - 1
            agent.set_requestor(self)
        for agent in self.agents:
            agent.setup(world)
        self._cycles = [_Cycle(agent) for agent in self.agents]
        self._respawning: list[_Cycle] = []

    if not TYPE_CHECKING:  # a type checker is to report the old names
        leap = RenamedAttribute("step_decision")
        held = RenamedAttribute("waiting_for_brain")

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

        Raises:
            ParameterError: it is no seed; nothing has begun then.
        """
        if seed is not None:
            seed = checked_seed(seed)  # before anybody hears of the reset
        for agent in self.agents:
            if agent.before_the_reset.handlers:
                agent.before_the_reset.fire(agent)
        self.world.reset(seed)
        self.episode += 1
        self._begin(self._cycles)

    def restart(self, *agents: BasicAgent) -> None:
        """Begins an episode for one agent, or several at once; the world and the others go on.

        Its body goes back to where its description says, or a RespawnActuator puts it. A decision
        that is under way ends without a reward.
        """
        self._restart([self._cycle_of(agent) for agent in agents])

    def tick(self) -> None:
        """One tick: agents whose turn it is decide, all act, the world moves."""
        if self._decide():
            self._move()

    def step_decision(self) -> int:
        """A whole decision, where nobody and nothing else has to be asked meanwhile; else a tick.

        What happens is the same as tick by tick, in less time.

        Returns:
            How many ticks have passed.
        """
        if not self._decide():
            return 0
        cycle = self._cycles[0]
        if len(self._cycles) == 1 and cycle.can_run_to_end():
            return cycle.run_to_end(self.world)
        self._move()
        return 1

    def step(self, agent: BasicAgent | None = None) -> Percept:
        """Ticks until a decision of an agent (the first one) is over, or its episode is.

        Returns:
            What the agent senses then.

        Raises:
            NoDecisionError: another agent has had the world wait for :data:`HOLD_LIMIT_S`.
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
                        f"agent {agent.id!r} can't end its decision: another agent's brain has had "
                        f"the world wait for {HOLD_LIMIT_S:g} s"
                    )
            else:
                held_since = None
        return agent.percept

    def phase(self, agent: BasicAgent) -> Phase:
        """How far an agent is in the decision that it takes, or took last."""
        return self._cycle_of(agent).phase()

    def is_deciding(self, agent: BasicAgent) -> bool:
        """Return whether an agent is in the middle of a decision: it has begun, and goes on."""
        return self._cycle_of(agent).under_way

    def between_decisions(self) -> bool:
        """Whether no agent is in the middle of a step: the time to change things."""
        return not any(cycle.under_way for cycle in self._cycles)

    def _decide(self) -> bool:
        """Asks the brains whose turn it is; whether there is a tick then."""
        self._respawning = []
        self.waiting_for_brain = False
        for turn, cycle in enumerate(self._cycles):
            if cycle.under_way:
                continue
            command = cycle.decide()
            if command is None:
                if self.spread_decisions:
                    cycle.align_to_slot(self.world.ticks - turn)
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
        for cycle in self._cycles:
            if cycle.under_way:
                cycle.advance()
        if self._respawning:
            # not sooner: what they sense first is to be as new as what they decide on
            self._restart(self._respawning)

    def _restart(self, cycles: list[_Cycle]) -> None:
        for cycle in cycles:
            if cycle.agent.before_the_reset.handlers:
                cycle.agent.before_the_reset.fire(cycle.agent)
        for cycle in cycles:
            self.world.put_back(cycle.agent.body_name)
        self._begin(cycles)

    def _begin(self, cycles: list[_Cycle]) -> None:
        """What a reset and a restart share, when the bodies are in their places."""
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

    def _cycle_of(self, agent: BasicAgent) -> _Cycle:
        return self._cycles[self.agents.index(agent)]
