"""A keyboard controller for discrete actions."""

from pydantic import Field

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Answer, Command
from ai4u_edu.blocks.brains.controllers.arrow import limits_of
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.controllers.wasd import Keys
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.world import WorldView

NO_CHOICE = 0


class DiscreteArrowController(Controller):
    """Right is 1, left 2, up 3, down 4, accept (Enter or Space) 5, no key 0; R restarts.

    For a DiscreteActuator. Keys are positions on the keyboard (``KeyboardEvent.code``). If several
    are held, the one pressed last counts. A key whose choice the actuator doesn't have (such as
    accept, if it has five choices) does nothing.

    Source: AI4U's DiscretArrowController.
    """

    actuator_name: str = "move"
    """Action name of the DiscreteActuator that the keys drive."""
    right: Keys = Field(default_factory=lambda: ["ArrowRight"])
    """Keys that give choice 1 (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    left: Keys = Field(default_factory=lambda: ["ArrowLeft"])
    """Keys that give choice 2 (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    up: Keys = Field(default_factory=lambda: ["ArrowUp"])
    """Keys that give choice 3 (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    down: Keys = Field(default_factory=lambda: ["ArrowDown"])
    """Keys that give choice 4 (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    accept: Keys = Field(default_factory=lambda: ["Enter", "Space"])
    """Keys that give choice 5 (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    restart: Keys = Field(default_factory=lambda: ["KeyR"])
    """Keys that start a new episode (codes such as ``KeyW``; at most 8, ``[]`` for none)."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Store the agent's keyboard, and look up how many choices there are."""
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
        """Forget the order of the keys."""
        self._order = []

    def get_action(self, percept: Percept) -> Answer:
        """Return one choice, from the keys that are held now."""
        keys = self._keyboard.read()
        fresh, self._before = keys - self._before, keys
        if not fresh.isdisjoint(self.restart):
            return Command.RESTART
        self._order = [key for key in self._order if key in keys]
        known = self._choices
        self._order += [key for key in known if key in keys and key not in self._order]
        return {self.actuator_name: known[self._order[-1]] if self._order else NO_CHOICE}
