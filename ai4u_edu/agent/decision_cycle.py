"""One agent's decision: the action under way, its ticks and its end."""

from typing import NamedTuple

from ai4u_edu.agent.agent import BasicAgent, Numbers
from ai4u_edu.agent.error_context import add_context
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Actuator, Command, RewardFunc
from ai4u_edu.world import Body, World


class Phase(NamedTuple):
    """Progress of an agent's decision."""

    tick: int = 0
    """Ticks of the decision that have passed; 0 before the first decision."""
    ticks: int = 1
    """Ticks that the decision takes."""
    repeats: bool = True
    """True if the actuators act at every tick, False if only at the first."""


class DecisionCycle:
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

    def decide(self) -> Command | None:
        """Ask the brain: return its command, or begin a step with its action."""
        agent = self.agent
        if agent.stopped:
            return None
        bound = agent.bound_blocks
        if bound is not self._bound:
            self.refresh_binding()
        bound.follow_switches()
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
        """Use the agent's present blocks.

        Raises:
            SetupError: the agent has been set up in another world.
        """
        bound = self.agent.bound_blocks
        if bound.world is not self._bound.world:
            raise SetupError(
                f"agent {self.agent.id!r} was set up in another world since; make one for each"
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

    def advance(self) -> bool:
        """Count a tick and run the blocks' on_tick; after the last tick end the step and sense.

        Returns:
            True if it was the last tick.
        """
        bound = self._bound
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
            or agent.begin_of_apply_action.handlers
            or agent.end_of_apply_action.handlers
        )

    def run_to_end(self, world: World) -> int:
        """Run the rest of the step, with the same result as tick by tick; return the ticks."""
        began = world.ticks
        body, tick = self._bound.body, world.tick
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
