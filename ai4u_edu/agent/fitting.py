"""How an agent's blocks sit on its body in one world: made once, at setup."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ai4u_edu.agent.ledger import Ledger
from ai4u_edu.blocks import (
    Actuator,
    Brain,
    DoneSensor,
    IDSensor,
    Layout,
    Percept,
    RewardFunc,
    Sensor,
)
from ai4u_edu.blocks.block import Block
from ai4u_edu.errors import AI4UError, BlockError, ReadingError, SetupError
from ai4u_edu.world import World, WorldView

if TYPE_CHECKING:
    from ai4u_edu.agent.agent import BasicAgent


class Fitting:
    """An agent's active blocks, set up: reward functions first, then sensors, then actuators.

    Args:
        agent: whose blocks.
        world: where its body is.
        goes_on: a brain that is set up already and stays as it is; left out, it is set up.

    Raises:
        SetupError: something does not fit; the message names it.
    """

    def __init__(self, agent: "BasicAgent", world: World, *, goes_on: Brain | None = None) -> None:
        self._agent = agent
        self._world = world
        with self._blamed(None):
            self.body = world[agent.body_name]
        self.view = WorldView(world)
        world.contacts.watch(self.body)
        self.brain = self._one_brain(agent.brains)
        self.rewards = [reward for reward in agent.rewards if reward.is_active]
        self.sensors = [sensor for sensor in self._with_standard_ones() if sensor.is_active]
        active = [actuator for actuator in agent.actuators if actuator.is_active]
        self._check_unique("reward function", "name", [each.name for each in self.rewards])
        self._check_unique("sensor", "perception_key", [s.perception_key for s in self.sensors])
        self._check_unique("actuator", "action_name", [each.action_name for each in active])
        self.actuators = {actuator.action_name: actuator for actuator in active}
        self.tick_actuators = [
            actuator for actuator in active if type(actuator).on_tick is not Actuator.on_tick
        ]
        self.tick_rewards = [reward for reward in self.rewards if reward.has_ticks]
        agent._fitting = self
        for reward in self.rewards:
            self._set_up(reward)
        for sensor in self.sensors:
            self._set_up(sensor)
        self._lay_out()
        for actuator in active:
            self._set_up(actuator)
            with self._blamed(actuator):
                actuator.prepare()
        if self.brain is not goes_on:
            self._set_up(self.brain)

    def swap_brain(self, brain: Brain) -> None:
        """Sets another brain up and enables it in place of the one before."""
        brain.enabled = True
        self._set_up(brain)
        brain.on_reset(self._agent, self.view)
        if self.brain is not brain:
            self.brain.enabled = False
            self.brain.close()
        self.brain = brain
        if not any(each is brain for each in self._agent.brains):
            self._agent.brains.append(brain)

    @property
    def number_sensors(self) -> tuple[Sensor, ...]:
        """Those whose readings are made of numbers."""
        return tuple(self._number_sensors)

    def take_up(self) -> None:
        """Is the agent's fitting again, after another one could not be made."""
        self._agent._fitting = self
        self._attach()

    def percept(self) -> Percept:
        """What lies in memory now; only what is text is read."""
        texts = (
            str(each.read(self.body, self.view)) if each.is_active else ""
            for each in self._text_sensors
        )
        return Percept(self.layout, bytes(self._memory), tuple(texts))

    def reset(self) -> None:
        """Resets every block, in the order of setup."""
        for reward in self.rewards:
            with self._blamed(reward):
                reward.on_reset(self._agent, self.view)
        for sensor in self.sensors:
            with self._blamed(sensor):
                sensor.on_reset(self._agent, self.view)
                sensor.restart()
        for actuator in self.actuators.values():
            with self._blamed(actuator):
                actuator.on_reset(self._agent, self.view)
        self.brain.on_reset(self._agent, self.view)

    def sense(self) -> Percept:
        """Every active sensor reads once, into one piece of memory; a copy of it is the percept."""
        body, view = self.body, self.view
        sensor: Sensor | None = None
        try:
            for sensor in self._number_sensors:
                if sensor.is_active:
                    sensor.take(body, view)
                else:
                    sensor.blank()
            texts = []
            for sensor in self._text_sensors:
                texts.append(str(sensor.read(body, view)) if sensor.is_active else "")
        except ReadingError:
            raise
        except AI4UError as error:
            raise ReadingError(f"{_named(sensor)}: {error}") from error
        except BaseException as error:  # sys.exit() in a block too
            error.add_note(f"while {_named(sensor)} of agent {self._agent.id!r} was reading")
            raise
        return Percept(self.layout, bytes(self._memory), tuple(texts))

    def pay(self, ledger: Ledger, scale: float) -> bool:
        """Every active reward function is asked about the decision that just ended.

        Args:
            ledger: where the amounts are booked.
            scale: what each is multiplied by.

        Returns:
            Whether one that ends the episode has paid something.
        """
        body, view = self.body, self.view
        ends = False
        reward: RewardFunc | None = None
        try:
            for reward in self.rewards:
                if reward.is_active:
                    amount = float(reward.on_update(body, view))
                    if not math.isfinite(amount):
                        raise ReadingError(f"expected a finite number, got {amount}")
                    ledger.pay(reward.name, amount * scale)
                    if amount and reward.cause_episode_to_end:
                        ends = True
        except AI4UError as error:
            raise ReadingError(f"{_named(reward)}: {error}") from error
        except TypeError as error:
            error.add_note(f"{_named(reward)}: on_update must return a number")
            raise
        return ends

    def _with_standard_ones(self) -> list[Sensor]:
        """The agent's sensors, and those that every agent has."""
        sensors = list(self._agent.sensors)
        keys = {sensor.perception_key for sensor in sensors}
        standard: tuple[Sensor, ...] = (DoneSensor(), IDSensor())
        return sensors + [each for each in standard if each.perception_key not in keys]

    def _lay_out(self) -> None:
        """Gives each reading its place in memory; what a policy gets as input comes first."""
        ordered = sorted(self.sensors, key=lambda sensor: not sensor.is_input)
        kinds = {id(sensor): sensor.reading_kind() for sensor in ordered}
        self._text_sensors = [each for each in ordered if kinds[id(each)] == "sstring"]
        self._number_sensors = [each for each in ordered if kinds[id(each)] != "sstring"]
        self.layout = Layout(
            [
                (each.perception_key, kinds[id(each)], each.observation_space().shape or ())
                for each in self._number_sensors
            ],
            [each.perception_key for each in self._text_sensors],
        )
        self._memory = bytearray(self.layout.size)
        self._attach()

    def _attach(self) -> None:
        for sensor in self._number_sensors:
            with self._blamed(sensor):
                place = self.layout.view(self._memory, sensor.perception_key)
                sensor.attach(place, self._chance_of(sensor))

    def _chance_of(self, sensor: Sensor) -> Callable[[], np.random.Generator]:
        return partial(self.view.random, f"{self._agent.id}/{sensor.perception_key}")

    def _set_up(self, block: Block) -> None:
        with self._blamed(block):
            block.on_setup(self._agent, self.view)

    def _one_brain(self, brains: list[Brain]) -> Brain:
        enabled = [brain for brain in brains if brain.enabled]
        who = f"agent {self._agent.id!r}"
        if not enabled:
            raise SetupError(
                f"{who}: expected exactly one enabled brain, got none"
                + (f" ({len(brains)} are switched off)" if brains else "")
                + "; add one, such as brains=[LocalBrain(controller=WASDRBMoveController())]"
            )
        if len(enabled) > 1:
            names = " and ".join(brain.title() for brain in enabled)
            raise SetupError(
                f"{who}: expected exactly one enabled brain, got {len(enabled)}: {names}; "
                "set enabled=False on the others"
            )
        return enabled[0]

    def _check_unique(self, what: str, field: str, names: list[str]) -> None:
        for index, name in enumerate(names):
            if name in names[:index]:
                raise SetupError(
                    f"agent {self._agent.id!r}: two {what}s have the {field} {name!r}; "
                    f"give one of them another, as in {field}='{name}_2'"
                )

    @contextmanager
    def _blamed(self, block: Block | None) -> Iterator[None]:
        """Adds to an error which block of which agent it came from."""
        who = f"agent {self._agent.id!r}"
        try:
            yield
        except AI4UError as error:
            raise BlockError(
                f"{who}, {_named(block)}: {error}" if block else f"{who}: {error}"
            ) from error


def _named(block: Block | None) -> str:
    name = ""
    for field in ("perception_key", "action_name", "name"):
        name = name or getattr(block, field, "")
    return f"{type(block).__name__} {name!r}" if name else type(block).__name__
