"""A keyboard controller with the arrow keys for any actuator."""

from collections.abc import Iterable
from typing import Annotated, Literal

from pydantic import Field

from ai4u_edu.base.errors import BlockError, suggest
from ai4u_edu.base.parameters import Name, Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Answer, Command
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.brains.controllers.wasd import Amount, Keys
from ai4u_edu.blocks.keyboard import combine
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import WorldView

Component = Literal[
    "forward", "strafe", "turn", "jump", "jump_forward", "left_wheel", "right_wheel", "none"
]

RB_MOVE_COMPONENTS: list[Component] = ["forward", "turn", "jump", "jump_forward"]
CB_MOVE_COMPONENTS: list[Component] = ["forward", "strafe", "turn", "jump", "jump_forward"]
WHEEL_COMPONENTS: list[Component] = ["left_wheel", "right_wheel"]


class ArrowController(Controller):
    """The arrow keys drive and turn, Space jumps, Enter jumps forward, R restarts.

    The keys of each motion can be changed (lists of ``KeyboardEvent.code``, positions on the
    keyboard); sideways motion has none by default. Opposite keys cancel out. A stick, on a screen
    or a gamepad, drives and turns in proportion to its deflection.

    ``components`` gives the meaning of each number of the action. By default it follows from the
    actuator: two wheels (the inner one slows down), RBMoveActuator's four numbers or
    CBMoveActuator's five; further numbers are 0.

    Extra actions: while a key of ``extra_keys[i]`` is held, the number at index
    ``extra_actions_index[i]`` (from 0) is ``extra_actions_value[i]``. For other actuators of one
    number there is ``switches``: ``{"grab": ["KeyG"]}`` gives the actuator "grab" a 1 while G is
    held, else a 0.

    Source: AI4U's ArrowPhysicsMoveController.

    Differs from AI4U: the actionMap is a list of keys for each motion. numberOfExtraActions follows
    from the actuator. The first episode is started by the program that runs the world; there by a
    first ``__reset__``.
    """

    actuator_name: str = "move"
    """Action name of the actuator that the keys drive."""
    speed: Amount = 0.5
    """Forward, backward and sideways number while a key is held, as a share of full power."""
    turn_amount: Amount = 1.0
    """Turn number while a key is held, as a share of full power."""
    jump_power: Amount = 1.0
    """Jump number while a key is held, as a share of full power."""
    forward: Keys = Field(default_factory=lambda: ["ArrowUp"])
    """Keys that drive forward (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    backward: Keys = Field(default_factory=lambda: ["ArrowDown"])
    """Keys that drive backward (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    left: Keys = Field(default_factory=list)
    """Keys that drive sideways, left (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    right: Keys = Field(default_factory=list)
    """Keys that drive sideways, right (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    turn_left: Keys = Field(default_factory=lambda: ["ArrowLeft"])
    """Keys that turn left (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    turn_right: Keys = Field(default_factory=lambda: ["ArrowRight"])
    """Keys that turn right (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    jump: Keys = Field(default_factory=lambda: ["Space"])
    """Keys that jump (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    jump_forward: Keys = Field(default_factory=lambda: ["Enter"])
    """Keys that jump forward (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    restart: Keys = Field(default_factory=lambda: ["KeyR"])
    """Keys that start a new episode (codes such as ``KeyW``; at most 8, ``[]`` for none)."""
    components: list[Component] | None = None
    """Meaning of each number of the action, in order; left out: chosen by the actuator."""
    extra_keys: list[Keys] = Field(default_factory=list)
    """Keys of each extra action; it is set while one of them is held."""
    extra_actions_index: list[Annotated[int, Field(ge=0, le=1023)]] = Field(default_factory=list)
    """Index in the action, from 0, that each extra action sets."""
    extra_actions_value: list[Number] = Field(default_factory=list)
    """Number that each extra action sets."""
    switches: dict[Name, Keys] = Field(default_factory=dict)
    """Keys that give an actuator of one number a 1, by its action name."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Store the agent's keyboard, and look up how many numbers the actuator takes."""
        self._keyboard = agent.keyboard
        self._before: frozenset[str] = frozenset()
        size = len(limits_of(self.actuator_name, agent)[0])
        self._components = self._chosen_components(size)
        self._check_extras(size)
        for name in self.switches:
            limits_of(name, agent)

    def get_action(self, percept: Percept) -> Answer:
        """Return one number for each component, from the keys that are held now."""
        keys, stick = self._keyboard.read(), self._keyboard.stick()
        fresh, self._before = keys - self._before, keys
        if not fresh.isdisjoint(self.restart):
            return Command.RESTART
        forward = _any(keys, self.forward) - _any(keys, self.backward)
        right = _any(keys, self.turn_right) - _any(keys, self.turn_left)
        ahead = self.speed * combine(forward, stick.forward)
        turn = self.turn_amount * combine(right, stick.turn)
        parts: dict[str, float] = {
            "forward": ahead,
            "strafe": self.speed * (_any(keys, self.right) - _any(keys, self.left)),
            "turn": turn,
            "jump": self.jump_power * _any(keys, self.jump),
            "jump_forward": self.jump_power * _any(keys, self.jump_forward),
            "left_wheel": max(-1.0, min(1.0, ahead + turn)),
            "right_wheel": max(-1.0, min(1.0, ahead - turn)),
            "none": 0.0,
        }
        action = [parts[component] for component in self._components]
        for held, index, value in zip(
            self.extra_keys, self.extra_actions_index, self.extra_actions_value, strict=True
        ):
            if _any(keys, held):
                action[index] = value
        switched = {name: float(_any(keys, held)) for name, held in self.switches.items()}
        return {self.actuator_name: tuple(action), **switched}

    def _chosen_components(self, size: int) -> list[Component]:
        if self.components is not None:
            if len(self.components) != size:
                raise BlockError(
                    _(
                        "components: expected {size}, as actuator {actuator_name!r} takes, got "
                        "{count}",
                        size=size,
                        actuator_name=self.actuator_name,
                        count=len(self.components),
                    )
                )
            return self.components
        known = next(
            (
                each
                for each in (CB_MOVE_COMPONENTS, RB_MOVE_COMPONENTS, WHEEL_COMPONENTS)
                if size >= len(each)
            ),
            [],
        )
        rest: list[Component] = ["none"] * (size - len(known))
        return known + rest

    def _check_extras(self, size: int) -> None:
        keys, places = len(self.extra_keys), len(self.extra_actions_index)
        values = len(self.extra_actions_value)
        if not keys == places == values:
            raise BlockError(
                _(
                    "expected as many extra_keys as extra_actions_index and extra_actions_value, "
                    "got {keys}, {places} and {values}",
                    keys=keys,
                    places=places,
                    values=values,
                )
            )
        for index in self.extra_actions_index:
            if index >= size:
                raise BlockError(
                    _(
                        "extra_actions_index: expected indices up to {size}, as actuator "
                        "{actuator_name!r} takes {size2} numbers, got {index}",
                        size=size - 1,
                        actuator_name=self.actuator_name,
                        size2=size,
                        index=index,
                    )
                )


def limits_of(name: str, agent: AgentView) -> tuple[list[float], list[float]]:
    """Return the ranges of an agent's actuator.

    Raises:
        BlockError: the agent has no actuator of that name.
    """
    actuators = {each.action_name: each for each in agent.actuators if each.is_active}
    if name not in actuators:
        raise BlockError(
            _("no actuator is called {name!r}; {hint}", name=name, hint=suggest(name, actuators))
        )
    return actuators[name].limits()


def _any(held: frozenset[str], keys: Iterable[str]) -> bool:
    return not held.isdisjoint(keys)
