"""A keyboard controller with W, A, S, D for RBMoveActuator."""

from typing import Annotated

from pydantic import Field

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Answer, Command
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.keyboard import combine
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.world import WorldView

Keys = Annotated[list[str], Field(max_length=8)]
Amount = Annotated[float, quantity("1", ge=0, le=1)]


class WASDRBMoveController(Controller):
    """W forward, S backward, A left, D right, Space or U jump, J jump forward, R restart.

    The arrow keys drive too. Keys are positions on the keyboard (``KeyboardEvent.code``), so W is
    the key at that position of an English keyboard, whatever is printed on it. Opposite keys cancel
    out. Releasing a key stops its part of the action at once. A stick, on a screen or a gamepad,
    drives and turns in proportion to its deflection.

    Source: AI4U's WASDRBMoveController.

    Differs from AI4U: ``speed`` is 1, there 0.5. Space jumps and the arrow keys drive as well;
    there only U, W, A, S and D.
    """

    actuator_name: str = "move"
    """Action name of the RBMoveActuator that the keys drive."""
    speed: Amount = 1.0
    """Forward and backward number while a key is held, as a share of full power."""
    turn_amount: Amount = 1.0
    """Turn number while a key is held, as a share of full power."""
    jump_power: Amount = 1.0
    """Jump number while a key is held, as a share of full power."""
    forward: Keys = Field(default_factory=lambda: ["KeyW", "ArrowUp"])
    """Keys that drive forward (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    backward: Keys = Field(default_factory=lambda: ["KeyS", "ArrowDown"])
    """Keys that drive backward (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    left: Keys = Field(default_factory=lambda: ["KeyA", "ArrowLeft"])
    """Keys that turn left (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    right: Keys = Field(default_factory=lambda: ["KeyD", "ArrowRight"])
    """Keys that turn right (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    jump: Keys = Field(default_factory=lambda: ["Space", "KeyU"])
    """Keys that jump (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    jump_forward: Keys = Field(default_factory=lambda: ["KeyJ"])
    """Keys that jump forward (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    restart: Keys = Field(default_factory=lambda: ["KeyR"])
    """Keys that start a new episode (codes such as ``KeyW``; at most 8, ``[]`` for none)."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Store the agent's keyboard."""
        self._keyboard = agent.keyboard
        self._before: frozenset[str] = frozenset()

    def get_action(self, percept: Percept) -> Answer:
        """Return [forward, turn, jump, forward jump] from the keys that are held now."""
        keys, stick = self._keyboard.read(), self._keyboard.stick()
        fresh, self._before = keys - self._before, keys
        if not fresh.isdisjoint(self.restart):
            return Command.RESTART
        ahead = (not keys.isdisjoint(self.forward)) - (not keys.isdisjoint(self.backward))
        turn = (not keys.isdisjoint(self.right)) - (not keys.isdisjoint(self.left))
        jump = not keys.isdisjoint(self.jump)
        leap = not keys.isdisjoint(self.jump_forward)
        return {
            self.actuator_name: (
                combine(ahead, stick.forward) * self.speed,
                combine(turn, stick.turn) * self.turn_amount,
                jump * self.jump_power,
                leap * self.jump_power,
            )
        }
