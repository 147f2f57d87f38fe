"""The brain of an agent in a game: asks an entry's controller, and notes where it fails."""

import re
from collections.abc import Callable, Sequence
from typing import Any

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Answer, Brain, Command, Controller, Percept
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.block import Block
from ai4u_edu.games.tournament.limits import CpuMeter, OverTimeError
from ai4u_edu.world import WorldView

MAX_REASON_CHARS = 300


class MatchBrain(Brain):
    """Asks a controller within limits of processor time; whatever that raises is a fault of it."""

    abstract = True  # not for scene files: a game makes it

    def attach(
        self, controller: Controller, title: str, meter: CpuMeter, blame: Callable[[str], None]
    ) -> None:
        """Set the controller.

        Args:
            controller: is asked for actions.
            title: the entry's name.
            meter: of the entry's processor time.
            blame: called with a sentence when the controller fails.
        """
        self._controller, self._title = controller, title
        self._meter, self._blame = meter, blame
        self._actuators: dict[str, Any] = {}

    def inner_blocks(self) -> Sequence[Block]:
        """Return the controller."""
        return (self._controller,)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Set the controller up."""
        self._actuators = {each.action_name: each for each in agent.actuators}
        self._controller.on_setup(agent, view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Reset the controller."""
        try:
            self._controller.on_reset(agent, view)
        except Exception as error:  # it is the entry's
            self._blame(reason_of(error))

    def decide(self, percept: Percept) -> Answer:
        """Return the controller's checked action; STOP where it fails."""
        if percept["done"]:
            return Command.WAIT
        try:
            with self._meter.measuring():
                self._controller.new_state_event(percept)
                answer = self._controller.get_action(percept)
            if not isinstance(answer, Command):
                return {name: self._accepted(name, each) for name, each in answer.items()}
        except Exception as error:  # it is the entry's
            self._blame(reason_of(error))
            return Command.STOP
        # no entry restarts a game, or has the other one wait
        return Command.STOP if answer in (Command.STOP, Command.RESTART) else Command.WAIT

    def title(self) -> str:
        """Return the entry's name."""
        return self._title

    def _accepted(self, name: str, numbers: Any) -> tuple[float, ...]:
        if name not in self._actuators:
            raise AI4UError(f"it drives an actuator {name!r}, and there is none")
        accepted: tuple[float, ...] = self._actuators[name].accept(numbers)
        return accepted


def reason_of(error: Exception) -> str:
    """Return why an entry failed, as one sentence."""
    is_ours = isinstance(error, AI4UError | OverTimeError)
    text = str(error) if is_ours else f"{type(error).__name__}: {error}"
    text = " ".join(text.split())
    text = re.sub(r"NeuralNetController '[^']*': ", "", text)  # a path in a folder that is gone
    return text if len(text) <= MAX_REASON_CHARS else text[: MAX_REASON_CHARS - 1] + "…"
