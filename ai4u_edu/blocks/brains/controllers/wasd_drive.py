"""A keyboard controller with W, A, S, D for any actuator."""

from pydantic import Field

from ai4u_edu.blocks.brains.controllers.arrow import ArrowController
from ai4u_edu.blocks.brains.controllers.wasd import Amount, Keys


class WASDController(ArrowController):
    """W forward, S backward, A left, D right, Space or U jump, J jump forward, R restart.

    The arrow keys drive too. Like ArrowController, it adapts to the actuator (two wheels, four
    numbers, five), or to ``components``; like WASDRBMoveController, it drives at full speed by
    default. An empty list, such as ``jump=[]``, removes keys for what a body can't do.

    Source: ours; AI4U's WASDRBMoveController for all kinds of bodies.
    """

    speed: Amount = 1.0
    forward: Keys = Field(default_factory=lambda: ["KeyW", "ArrowUp"])
    backward: Keys = Field(default_factory=lambda: ["KeyS", "ArrowDown"])
    turn_left: Keys = Field(default_factory=lambda: ["KeyA", "ArrowLeft"])
    turn_right: Keys = Field(default_factory=lambda: ["KeyD", "ArrowRight"])
    jump: Keys = Field(default_factory=lambda: ["Space", "KeyU"])
    jump_forward: Keys = Field(default_factory=lambda: ["KeyJ"])
