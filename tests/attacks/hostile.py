"""Blocks that do in one of their hooks what no block should, and a sim in which one does."""

import sys
from collections.abc import Callable
from typing import Any, ClassVar

from gymnasium.spaces import Box

from ai4u_edu import (
    Actuator,
    BasicAgent,
    CircleShape,
    Controller,
    ControlRequestor,
    LocalBrain,
    RewardFunc,
    Sensor,
    World,
)


def exit_process() -> None:
    """Ask the interpreter to end."""
    sys.exit(3)


def interrupt() -> None:
    """Pretend that Ctrl-C was pressed."""
    raise KeyboardInterrupt


def leave_generator() -> None:
    """Raise what is no Exception and no request to end either."""
    raise GeneratorExit


def divide() -> None:
    """Raise an ordinary error."""
    raise ZeroDivisionError("division by zero")


def recurse() -> None:
    """Use up the stack."""
    recurse()


def flood() -> None:
    """Write much, then raise with a huge text."""
    print("flood " * 100)
    raise RuntimeError("flood " * 20_000)


MISDEEDS = (exit_process, interrupt, leave_generator, divide, recurse, flood)


class Misdeed:
    """A mixin: commits a misdeed in the hook that it is told, once it is armed."""

    hook: str
    misdeed: ClassVar[Callable[[], None]] = staticmethod(divide)
    is_armed: ClassVar[bool] = False

    def commit(self, hook: str) -> None:
        """Commit the misdeed, if this is the hook."""
        if Misdeed.is_armed and self.hook == hook:
            Misdeed.misdeed()


class HostileSensor(Misdeed, Sensor):
    """A sensor whose hooks may misbehave. Reading: always 0."""

    hook: str = ""

    def space(self) -> Box:
        return Box(-1.0, 1.0, (1,))

    def on_reset(self, agent: Any, view: Any) -> None:
        self.commit("sensor.on_reset")

    def read(self, body: Any, view: Any) -> list[float]:
        self.commit("sensor.read")
        return [0.0]


class HostileActuator(Misdeed, Actuator):
    """An actuator whose hooks may misbehave."""

    hook: str = ""

    def space(self) -> Box:
        return Box(-1.0, 1.0, (1,))

    def on_reset(self, agent: Any, view: Any) -> None:
        self.commit("actuator.on_reset")

    def act(self, body: Any, action: Any) -> None:
        self.commit("actuator.act")

    def on_tick(self, body: Any, view: Any) -> None:
        self.commit("actuator.on_tick")


class HostileReward(Misdeed, RewardFunc):
    """A reward function whose hooks may misbehave."""

    hook: str = ""

    def on_reset(self, agent: Any, view: Any) -> None:
        self.commit("reward.on_reset")

    def on_tick(self, body: Any, view: Any) -> None:
        self.commit("reward.on_tick")

    def on_update(self, body: Any, view: Any) -> float:
        self.commit("reward.on_update")
        return 0.0


class HostileController(Misdeed, Controller):
    """A controller whose hooks may misbehave."""

    hook: str = ""

    def on_reset(self, agent: Any, view: Any) -> None:
        self.commit("controller.on_reset")

    def get_action(self, percept: Any) -> Any:
        self.commit("controller.get_action")
        return {"hostile": [0.5]}


HOOKS = (
    "sensor.on_reset",
    "sensor.read",
    "actuator.on_reset",
    "actuator.act",
    "actuator.on_tick",
    "reward.on_reset",
    "reward.on_tick",
    "reward.on_update",
    "controller.on_reset",
    "controller.get_action",
    "handler.end_of_step",
    "handler.before_the_reset",
)


def hostile_sim(hook: str) -> ControlRequestor:
    """Return a sim with one agent, of whose blocks one may misbehave in a hook."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.3))
    agent = BasicAgent(
        id="red",
        body="robot",
        sensors=[HostileSensor(hook=hook)],
        actuators=[HostileActuator(hook=hook)],
        rewards=[HostileReward(hook=hook)],
        brains=[LocalBrain(controller=HostileController(hook=hook), skip_frame=0)],
    )
    kind, _, name = hook.partition(".")
    if kind == "handler":

        def handle(_: Any) -> None:
            if Misdeed.is_armed:
                Misdeed.misdeed()

        getattr(agent, name).connect(handle)
    return ControlRequestor(world, [agent])
