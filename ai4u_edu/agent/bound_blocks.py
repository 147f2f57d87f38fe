"""How an agent's blocks sit on its body in one world: made once, at setup."""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ai4u_edu.agent.error_context import add_context, block_label
from ai4u_edu.agent.ledger import Ledger
from ai4u_edu.agent.options import add_optional_blocks
from ai4u_edu.agent.ownership import LostBrain, check_each_once, claim
from ai4u_edu.base.errors import AI4UError, BlockError, ReadingError, SetupError
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
from ai4u_edu.blocks.percept import TEXTS, Texts
from ai4u_edu.world import BodyView, World, WorldView

if TYPE_CHECKING:
    from ai4u_edu.agent.agent import BasicAgent


class BoundBlocks:
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
        self.world = world
        add_optional_blocks(agent)
        with self._blamed(None):
            self.body = world[agent.body_name]
        self.view = WorldView(world)
        world.contacts.watch(self.body)
        self.brain = self._one_brain(agent.brains)
        self.rewards = [reward for reward in agent.rewards if reward.is_active]
        self.sensors = [sensor for sensor in self._with_standard_ones() if sensor.is_active]
        active = [actuator for actuator in agent.actuators if actuator.is_active]
        check_each_once(agent, [*self.rewards, *self.sensors, *active, self.brain])
        self._check_unique("reward function", "name", self.rewards)
        self._check_unique("sensor", "perception_key", self.sensors)
        self._check_unique("actuator", "action_name", active)
        self.actuators = {actuator.action_name: actuator for actuator in active}
        self.tick_actuators = [
            actuator for actuator in active if type(actuator).on_tick is not Actuator.on_tick
        ]
        self.tick_rewards = [reward for reward in self.rewards if reward.has_ticks]
        claim(agent, self.blocks)
        agent._bound_blocks = self
        for reward in self.rewards:
            self._set_up(reward)
        for sensor in self.sensors:
            self._set_up(sensor)
        self._lay_out()
        for actuator in active:
            self._set_up(actuator)
            with self._blamed(actuator, "was set up"):
                actuator.prepare()
        if self.brain is not goes_on:
            self._set_up(self.brain)

    @property
    def blocks(self) -> list[Block]:
        """All active blocks and the brain; the blocks inside of them are not listed."""
        return [*self.rewards, *self.sensors, *self.actuators.values(), self.brain]

    def swap_brain(self, brain: Brain) -> None:
        """Sets another brain up and enables it in place of the one before."""
        if isinstance(self.brain, LostBrain) and not self.brain.is_replaceable:
            raise SetupError(self.brain.problem)
        others = [each for each in self.blocks if each is not self.brain]
        check_each_once(self._agent, [*others, brain])
        claim(self._agent, [brain])
        brain.enabled = True
        self._set_up(brain)
        self._reset(brain)
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

    def restore(self) -> None:
        """Is the agent's bound again, after another one could not be made."""
        self._agent._bound_blocks = self
        self._attach()

    def percept(self) -> Percept:
        """What lies in memory now; only what is text is read."""
        texts = (read(each, self.body, self.view) for each, read in self._text_sensors)
        return Percept(self.layout, bytes(self._memory), tuple(texts))

    def reset(self) -> None:
        """Resets every block, in the order of setup."""
        for reward in self.rewards:
            self._reset(reward)
        for sensor in self.sensors:
            if sensor.resetable:
                self._reset(sensor)
            sensor.restart()
        for actuator in self.actuators.values():
            self._reset(actuator)
        self._reset(self.brain)

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
            for sensor, read in self._text_sensors:
                texts.append(read(sensor, body, view))
        except Exception as error:
            self._told_as_reading(error, sensor, "was reading")
            raise
        return Percept(self.layout, bytes(self._memory), tuple(texts))

    def pay(self, ledger: Ledger, scale: float) -> bool:
        """Every active reward function is asked about the decision that just ended.

        Args:
            ledger: where the amounts are booked.
            scale: what each is multiplied by.

        Returns:
            Whether one of them ends the episode.
        """
        body, view = self.body, self.view
        ends = False
        reward: RewardFunc | None = None
        try:
            for reward in self.rewards:
                if reward.is_active:
                    amount = reward.on_update(body, view)
                    if type(amount) is not float:
                        amount = as_amount(amount)
                    paid = amount * scale
                    if not math.isfinite(paid):
                        refuse_amount(paid)
                    ledger.pay(reward.name, paid)
                    if reward.cause_episode_to_end and reward.ends(amount):
                        ends = True
        except Exception as error:
            self._told_as_reading(error, reward, "was paying")
            raise
        return ends

    def _told_as_reading(self, error: Exception, block: Block | None, doing: str) -> None:
        """Names block and agent; what is one of our errors becomes a ReadingError."""
        if isinstance(error, AI4UError) and not isinstance(error, ReadingError):
            told = ReadingError(str(error))
            add_context(told, self._agent, block, doing)
            raise told from error
        add_context(error, self._agent, block, doing)

    def _with_standard_ones(self) -> list[Sensor]:
        """The agent's sensors, and those that every agent has."""
        sensors = list(self._agent.sensors)
        keys = {sensor.perception_key for sensor in sensors}
        standard: tuple[Sensor, ...] = (DoneSensor(), IDSensor())
        return sensors + [each for each in standard if each.perception_key not in keys]

    def _lay_out(self) -> None:
        """Gives each reading its place in memory; what a policy gets as input comes first."""
        ordered = sorted(self.sensors, key=lambda sensor: not sensor.is_input)
        kinds = {id(sensor): self._kind_of(sensor) for sensor in ordered}
        self._text_sensors = [
            (each, read_texts if kinds[id(each)] == "sstrings" else read_text)
            for each in ordered
            if kinds[id(each)] in TEXTS
        ]
        self._number_sensors = [each for each in ordered if kinds[id(each)] not in TEXTS]
        self.layout = Layout(
            [
                (each.perception_key, kinds[id(each)], each.observation_space().shape or ())
                for each in self._number_sensors
            ],
            [each.perception_key for each, _ in self._text_sensors],
        )
        self._memory = bytearray(self.layout.size)
        self._attach()

    def _kind_of(self, sensor: Sensor) -> str:
        with self._blamed(sensor, "was set up"):
            return sensor.reading_kind()

    def _attach(self) -> None:
        for sensor in self._number_sensors:
            with self._blamed(sensor, "was set up"):
                place = self.layout.view(self._memory, sensor.perception_key)
                sensor.attach(place, self._chance_of(sensor))

    def _chance_of(self, sensor: Sensor) -> Callable[[], np.random.Generator]:
        return partial(self.view.random, f"{self._agent.id}/{sensor.perception_key}")

    def _set_up(self, block: Block) -> None:
        with self._blamed(block, "was set up"):
            block.on_setup(self._agent, self.view)

    def _reset(self, block: Block) -> None:
        with self._blamed(block, "was reset"):
            block.on_reset(self._agent, self.view)

    def _one_brain(self, brains: list[Brain]) -> Brain:
        enabled = [brain for brain in brains if brain.enabled]
        who = f"agent {self._agent.id!r}"
        if not enabled:
            told = SetupError(
                f"{who}: expected exactly one enabled brain, got none"
                + (f" ({len(brains)} are switched off)" if brains else "")
                + "; add one, such as brains=[LocalBrain(controller=WASDRBMoveController())]"
            )
            told.where = (self._agent, "brains")
            raise told
        if len(enabled) > 1:
            names = " and ".join(brain.title() for brain in enabled)
            told = SetupError(
                f"{who}: expected exactly one enabled brain, got {len(enabled)}: {names}; "
                "set enabled=False on the others"
            )
            told.where = (self._agent, enabled[1])
            raise told
        return enabled[0]

    def _check_unique(self, what: str, field: str, blocks: Sequence[Block]) -> None:
        names: set[str] = set()
        for block in blocks:
            name = getattr(block, field)
            if name in names:
                told = SetupError(
                    f"agent {self._agent.id!r}: two {what}s have the {field} {name!r}; "
                    f"give one of them another, as in {field}='{name}_2'"
                )
                told.where = (self._agent, block)
                raise told
            names.add(name)

    @contextmanager
    def _blamed(self, block: Block | None, doing: str = "") -> Iterator[None]:
        """Adds to an error which block of which agent it came from."""
        try:
            yield
        except AI4UError as error:
            if isinstance(block, LostBrain):
                raise
            who = f"agent {self._agent.id!r}"
            told = BlockError(
                f"{who}, {block_label(block)}: {error}" if block else f"{who}: {error}"
            )
            told.where = (self._agent, block or "body")
            raise told from error
        except Exception as error:
            add_context(error, self._agent, block, doing)
            raise


def read_text(sensor: Sensor, body: BodyView, view: WorldView) -> Texts:
    """Return what a sensor of the type sstring reads."""
    return str(sensor.read(body, view)) if sensor.is_active else ""


def read_texts(sensor: Sensor, body: BodyView, view: WorldView) -> Texts:
    """Return what a sensor of the type sstrings reads.

    Raises:
        ReadingError: it reads something else than a list of texts.
    """
    if not sensor.is_active:
        return ()
    texts = sensor.read(body, view)
    if not isinstance(texts, list | tuple) or not all(isinstance(each, str) for each in texts):
        raise ReadingError(f"expected a list of texts, got {texts!r}")
    return tuple(texts)


def refuse_amount(amount: float) -> None:
    """Raise a ReadingError: an amount is not finite."""
    raise ReadingError(f"expected a finite number, got {amount}")


def as_amount(value: object) -> float:
    """Return what a reward function paid as a float.

    Raises:
        ReadingError: it is no number.
    """
    try:
        return float(value)  # type: ignore[arg-type]  # anything may come; the next line says so
    except (TypeError, ValueError):
        raise ReadingError(f"expected a number from on_update, got {value!r}") from None
