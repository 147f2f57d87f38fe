"""A controller that replays recorded actions."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from ai4u_edu.base.parameters import Name, Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Answer, Command
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.world import WorldView


class ReplayController(Controller):
    """Replays a list of recorded actions, one per decision, from the first one after each reset.

    Each entry has the form of ``agent.last_action``: numbers by the actuator's name. ``ending``
    says what follows the last one: ``stop`` (no more decisions until the next reset) or ``repeat``
    (start again). With the same seed, the same actions lead to the same positions, bit for bit.

    Source: ours.

    >>> replay = ReplayController(actions=[{"move": [1, 0, 0, 0]}, {"move": [0, 1, 0, 0]}])
    >>> [replay.get_action({}) for _ in range(3)]
    [{'move': [1.0, 0.0, 0.0, 0.0]}, {'move': [0.0, 1.0, 0.0, 0.0]}, <Command.STOP: 'stop'>]
    """

    actions: Annotated[list[dict[Name, list[Number]]], Field(min_length=1)]
    """Actions in order: for each decision, numbers by the actuator's name."""
    ending: Literal["stop", "repeat"] = "stop"
    """After the last action: ``stop`` takes no more decisions, ``repeat`` starts again."""

    carried: ClassVar[tuple[str, ...]] = ("_turn",)

    def __post_init__(self) -> None:
        self._turn = 0

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Start with the first action."""
        self._turn = 0

    def get_action(self, percept: Percept) -> Answer:
        """Return the next action, or the stop command."""
        if self._turn == len(self.actions):
            if self.ending == "stop":
                return Command.STOP
            self._turn = 0
        self._turn += 1
        return self.actions[self._turn - 1]
