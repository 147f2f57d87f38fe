"""Choose with the arrow keys."""

from pydantic import Field

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.command import Answer, Command
from ai4u_edu.blocks.brains.controllers.arrow import limits_of
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.controllers.wasd import Keys
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.world import WorldView

NONE = 0


class DiscreteArrowController(Controller):
    """Right is 1, left 2, up 3, down 4, accept (Enter or Space) 5, no key 0; R restarts.

    For a DiscreteActuator. Keys are places on the keyboard (``KeyboardEvent.code``). Of several
    that are held the one pressed last counts. A key whose choice the actuator doesn't have (accept,
    where it has five) does nothing.

    Source: AI4U's DiscretArrowController.
    """

    actuator_name: str = "move"
    """Action name of the DiscreteActuator that the keys drive."""
    right: Keys = Field(default_factory=lambda: ["ArrowRight"])
    """Keys that give choice 1, as places on the keyboard (``KeyW``); at most 8, none by ``[]``."""
    left: Keys = Field(default_factory=lambda: ["ArrowLeft"])
    """Keys that give choice 2, as places on the keyboard (``KeyW``); at most 8, none by ``[]``."""
    up: Keys = Field(default_factory=lambda: ["ArrowUp"])
    """Keys that give choice 3, as places on the keyboard (``KeyW``); at most 8, none by ``[]``."""
    down: Keys = Field(default_factory=lambda: ["ArrowDown"])
    """Keys that give choice 4, as places on the keyboard (``KeyW``); at most 8, none by ``[]``."""
    accept: Keys = Field(default_factory=lambda: ["Enter", "Space"])
    """Keys that give choice 5, as places on the keyboard (``KeyW``); at most 8, none by ``[]``."""
    restart: Keys = Field(default_factory=lambda: ["KeyR"])
    """Keys that begin a new episode, as places on the keyboard (``KeyW``); at most 8, none by
    ``[]``."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Takes the agent's keyboard, and looks how many choices there are."""
        self._keyboard = agent.keyboard
        self._before: frozenset[str] = frozenset()
        last = int(limits_of(self.actuator_name, agent)[1][0])
        groups = (self.right, self.left, self.up, self.down, self.accept)
        self._choices = {
            key: choice
            for choice, keys in enumerate(groups, start=1)
            for key in keys
            if choice <= last
        }
        self._order: list[str] = []

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets which key came when."""
        self._order = []

    def get_action(self, percept: Percept) -> Answer:
        """One choice, from the keys held now."""
        keys = self._keyboard.read()
        fresh, self._before = keys - self._before, keys
        if not fresh.isdisjoint(self.restart):
            return Command.RESTART
        self._order = [key for key in self._order if key in keys]
        known = self._choices
        self._order += [key for key in known if key in keys and key not in self._order]
        return {self.actuator_name: known[self._order[-1]] if self._order else NONE}
