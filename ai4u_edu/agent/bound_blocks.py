"""An agent's blocks, bound to its body in one world."""

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from operator import attrgetter
from typing import Any, Protocol

from ai4u_edu.agent.error_context import add_context, block_label
from ai4u_edu.agent.ledger import Ledger
from ai4u_edu.agent.ownership import LostBrain, Owner, claim, owner_of
from ai4u_edu.base.attributes import refuse_stray
from ai4u_edu.base.errors import AI4UError, BlockError, ReadingError, SetupError, text_of
from ai4u_edu.blocks import (
    Actuator,
    AgentArraySensor,
    Brain,
    DoneSensor,
    IDSensor,
    Layout,
    Percept,
    RewardFunc,
    Sensor,
)
from ai4u_edu.blocks.block import Block, walk_blocks
from ai4u_edu.blocks.percept import TEXTS, Texts
from ai4u_edu.blocks.sensors.sensor_state import depends_on_status, read_status_again
from ai4u_edu.locale import Text, join, listed
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, World, WorldView

_is_enabled = attrgetter("enabled")

_SET_UP, _RESET = _("while {block} of {agent} was set up"), _("while {block} of {agent} was reset")
_READING, _PAYING = (
    _("while {block} of {agent} was reading"),
    _("while {block} of {agent} was paying"),
)


class _Agent(Owner, Protocol):
    """Protocol of an agent whose blocks are bound (BasicAgent is one)."""

    body_name: str
    sensors: list[Sensor]
    actuators: list[Actuator]
    rewards: list[RewardFunc]
    brains: list[Brain]


class BoundBlocks:
    """The active blocks of an agent and the memory that its sensors write to.

    Args:
        agent: the owner of the blocks.
        world: the world that its body is in.

    Raises:
        SetupError: something does not fit; the message names it.
    """

    def __init__(self, agent: _Agent, world: World) -> None:
        self._agent = agent
        self.world = world
        with self._error_context(None):
            self.body = world[agent.body_name]
        self.view = WorldView(world)
        world.contacts.watch(self.body)
        self.brain = _enabled_brain(agent, agent.brains)
        self._remember_switches()
        self.rewards = [reward for reward in agent.rewards if reward.is_active]
        self.sensors = [sensor for sensor in self._with_standard_sensors() if sensor.is_active]
        active = [actuator for actuator in agent.actuators if actuator.is_active]
        _check_each_once(agent, [*self.rewards, *self.sensors, *active, self.brain])
        _check_unique(agent, _TWO_REWARDS, "name", self.rewards)
        _check_unique(agent, _TWO_SENSORS, "perception_key", self.sensors)
        _check_unique(agent, _TWO_ACTUATORS, "action_name", active)
        self.actuators = {actuator.action_name: actuator for actuator in active}
        self.tick_actuators = [
            actuator for actuator in active if type(actuator).on_tick is not Actuator.on_tick
        ]
        self.tick_rewards = [reward for reward in self.rewards if reward.has_ticks]
        self.tick_sensors: list[Sensor] = []
        """Known once they are set up."""
        self._places: tuple[Brain, list[tuple[str, Block]]] | None = None
        claim(agent, self.blocks)

    def set_up(self, *, ready_brain: Brain | None = None) -> None:
        """Set up reward functions, then sensors, actuators and the brain.

        Args:
            ready_brain: a brain that is set up already and stays as it is.

        Raises:
            SetupError: a block does not fit; the message names it.
        """
        for reward in self.rewards:
            self._set_up(reward)
        for sensor in self.sensors:
            self._set_up(sensor)
        self.tick_sensors = [sensor for sensor in self.sensors if sensor.has_ticks]
        self._lay_out_memory()
        for actuator in self.actuators.values():
            self._set_up(actuator)
            with self._error_context(actuator, _SET_UP):
                actuator.prepare()
        if self.brain is not ready_brain:
            self._set_up(self.brain)
        self._remember_fixed()

    @property
    def blocks(self) -> list[Block]:
        """All active blocks and the brain, without the blocks inside them."""
        return [*self.rewards, *self.sensors, *self.actuators.values(), self.brain]

    def places(self) -> list[tuple[str, Block]]:
        """Return all active blocks and those inside them, each with a name for its place."""
        if self._places is None or self._places[0] is not self.brain:
            found = []
            for block in self.blocks:
                own = vars(block)
                name = "".join(
                    own.get(each, "") for each in ("perception_key", "action_name", "name")
                )
                for number, part in enumerate(walk_blocks([block])):
                    found.append(
                        (f"{type(block).__name__} {name}/{number} {type(part).__name__}", part)
                    )
            self._places = self.brain, found
        return self._places[1]

    def array_sensors(self) -> list[AgentArraySensor]:
        """Return the sensors of numbers that a script sets, also those inside others."""
        return [each for each in walk_blocks(self.sensors) if isinstance(each, AgentArraySensor)]

    def swap_brain(self, brain: Brain) -> None:
        """Set up another brain and enable it in place of the present one.

        Raises:
            SetupError: the brain does not fit, or the agent has lost other blocks.
        """
        if isinstance(self.brain, LostBrain) and not self.brain.is_replaceable:
            raise SetupError(self.brain.problem)
        others = [each for each in self.blocks if each is not self.brain]
        _check_each_once(self._agent, [*others, brain])
        claim(self._agent, [brain])
        was_enabled, brain.enabled = brain.enabled, True
        try:
            self._set_up(brain)
            with self._error_context(brain, _RESET):
                brain.on_reset(self._agent, self.view)
        except BaseException:
            brain.enabled = was_enabled
            raise
        if self.brain is not brain:
            self.brain.enabled = False
            self.brain.close()
        self.brain = brain
        if not any(each is brain for each in self._agent.brains):
            self._agent.brains.append(brain)
        self._remember_switches()
        self._remember_fixed()

    def follow_switches(self) -> None:
        """Give control to another brain if somebody has set ``enabled`` of brains since.

        Raises:
            SetupError: none or several are enabled, or the brain does not fit the agent.
        """
        brains = self._agent.brains
        if brains == self._known_brains and [*map(_is_enabled, brains)] == self._switches:
            return
        if isinstance(self.brain, LostBrain):
            return
        agent = self._agent
        try:
            # a brain that was lent to another agent is switched for that one
            brain = _enabled_brain(
                agent, [each for each in agent.brains if owner_of(each) in (None, agent)]
            )
        except SetupError as error:
            raise SetupError(
                _("{error}; or call agent.use_brain(brain)", error=text_of(error))
            ) from None
        if brain is not self.brain:
            self.swap_brain(brain)
        self._remember_switches()

    def _remember_switches(self) -> None:
        """Note the agent's brains, and which of them are enabled while the present one drives."""
        self._known_brains = list(self._agent.brains)
        self._switches = [*map(_is_enabled, self._known_brains)]

    @property
    def number_sensors(self) -> tuple[Sensor, ...]:
        """Sensors whose readings are numbers."""
        return tuple(self._number_sensors)

    def read_status_again(self, percept: Percept) -> Percept:
        """Read the agent's own state again, after it has changed; all other readings stay.

        Args:
            percept: the latest one.
        """
        sensor: Sensor | None = None
        try:
            for sensor in self._status_sensors:
                if sensor.is_active:
                    read_status_again(sensor, self.body, self.view)
        except Exception as error:
            self._raise_as_reading(error, sensor, _READING)
            raise
        return Percept(self.layout, bytes(self._memory), percept.texts)

    def percept(self) -> Percept:
        """Return the readings in memory as a percept; only text is read again."""
        texts = (read(each, self.body, self.view) for each, read in self._text_sensors)
        return Percept(self.layout, bytes(self._memory), tuple(texts))

    def reset(self) -> None:
        """Reset every block, in the order of setup.

        Raises:
            SetupError: the agent has an active block that was not set up with the others, or an
                attribute of a block was set that counts at setup only.
        """
        self._check_all_bound()
        self._check_fixed()
        agent, view = self._agent, self.view
        block: Block | None = None
        try:
            for block in self.rewards:
                block.on_reset(agent, view)
            for sensor in self.sensors:
                block = sensor
                if sensor.resetable:
                    sensor.on_reset(agent, view)
                sensor.restart()
            for block in (*self.actuators.values(), self.brain):
                block.on_reset(agent, view)
        except Exception as error:
            self._raise_with_context(error, block, _RESET)
            raise

    def _check_all_bound(self) -> None:
        agent, bound = self._agent, {id(block) for block in self.blocks}
        blocks: list[Any] = [*agent.sensors, *agent.actuators, *agent.rewards]
        for block in blocks:
            if block.is_active and id(block) not in bound:
                raise SetupError(
                    _(
                        "agent {id!r}: {block} was switched on, or added, after the agent was set "
                        "up, and would have no effect; call agent.setup(world), or make it active "
                        "before ControlRequestor(world, [agent])",
                        id=agent.id,
                        block=block_label(block),
                    )
                )

    def _remember_fixed(self) -> None:
        blocks = list(walk_blocks(self.blocks))
        for block in blocks:
            self._check_attributes(block)
        self._fixed = [(block, block.fixed_at_setup(), len(vars(block))) for block in blocks]

    def _check_attributes(self, block: Block) -> None:
        where = _("agent {id!r}, {block}", id=self._agent.id, block=block_label(block))
        refuse_stray(block, where, block.parameters())

    def _check_fixed(self) -> None:
        for block, before, count in self._fixed:
            if len(vars(block)) != count:  # it may also have prepared itself for an episode
                self._check_attributes(block)
            now = block.fixed_at_setup()
            if now == before:
                continue
            name = next(name for name, value in now.items() if value != before[name])
            raise SetupError(
                _(
                    "agent {id!r}, {block}: {name} was set to {value} after the agent was set "
                    "up, and would have no effect; call agent.setup(world), or set it before "
                    "ControlRequestor(world, [agent])",
                    id=self._agent.id,
                    block=block_label(block),
                    name=name,
                    value=repr(getattr(block, name)),
                )
            )

    def sense(self) -> Percept:
        """Read every active sensor once into memory; return a copy as a percept."""
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
            self._raise_as_reading(error, sensor, _READING)
            raise
        return Percept(self.layout, bytes(self._memory), tuple(texts))

    def pay(self, ledger: Ledger, scale: float) -> bool:
        """Book the reward of every active reward function for the decision that just ended.

        Args:
            ledger: books the amounts.
            scale: factor of every amount.

        Returns:
            True if a reward function ends the episode.
        """
        body, view = self.body, self.view
        ends = False
        reward: RewardFunc | None = None
        try:
            for reward in self.rewards:
                if reward.is_active:
                    amount = reward.on_update(body, view)
                    if type(amount) is not float:
                        amount = _as_amount(amount)
                    paid = amount * scale
                    if not math.isfinite(paid):
                        _refuse_amount(paid)
                    ledger.pay(reward.name, paid)
                    if reward.cause_episode_to_end and reward.ends(amount):
                        ends = True
        except Exception as error:
            self._raise_as_reading(error, reward, _PAYING)
            raise
        return ends

    def _raise_as_reading(self, error: Exception, block: Block | None, doing: Text) -> None:
        """Add block and agent to an error; raise one of this package's as a ReadingError."""
        if isinstance(error, AI4UError) and not isinstance(error, ReadingError):
            problem = ReadingError(text_of(error))
            add_context(problem, self._agent, block, doing)
            raise problem from error
        add_context(error, self._agent, block, doing)

    def _with_standard_sensors(self) -> list[Sensor]:
        """Return the agent's sensors and those that every agent has."""
        sensors = list(self._agent.sensors)
        keys = {sensor.perception_key for sensor in sensors}
        standard: tuple[Sensor, ...] = (DoneSensor(), IDSensor())
        return sensors + [each for each in standard if each.perception_key not in keys]

    def _lay_out_memory(self) -> None:
        """Give each reading its place in memory; the inputs of a policy come first."""
        ordered = sorted(self.sensors, key=lambda sensor: not sensor.is_input)
        kinds = {id(sensor): self._kind_of(sensor) for sensor in ordered}
        self._text_sensors = [
            (each, _read_texts if kinds[id(each)] == "sstrings" else _read_text)
            for each in ordered
            if kinds[id(each)] in TEXTS
        ]
        self._number_sensors = [each for each in ordered if kinds[id(each)] not in TEXTS]
        self._status_sensors = [each for each in self._number_sensors if depends_on_status(each)]
        self.layout = Layout(
            [
                (each.perception_key, kinds[id(each)], each.observation_space().shape or ())
                for each in self._number_sensors
            ],
            [each.perception_key for each, _ in self._text_sensors],
        )
        self._memory = bytearray(self.layout.size)
        self.attach_sensors()

    def _kind_of(self, sensor: Sensor) -> str:
        with self._error_context(sensor, _SET_UP):
            return sensor.reading_kind()

    def attach_sensors(self) -> None:
        """Connect the sensors to their places in memory."""
        for sensor in self._number_sensors:
            with self._error_context(sensor, _SET_UP):
                place = self.layout.view(self._memory, sensor.perception_key)
                name = f"{self._agent.id}/{sensor.perception_key}"
                sensor.attach(place, partial(self.view.random, name))

    def _set_up(self, block: Block) -> None:
        with self._error_context(block, _SET_UP):
            block.on_setup(self._agent, self.view)

    @contextmanager
    def _error_context(self, block: Block | None, doing: Text = _SET_UP) -> Iterator[None]:
        """Add agent and block to an error that is raised inside."""
        try:
            yield
        except Exception as error:
            self._raise_with_context(error, block, doing)
            raise

    def _raise_with_context(self, error: Exception, block: Block | None, doing: Text) -> None:
        """Add agent and block to an error; raise one of this package's as a BlockError."""
        if not isinstance(error, AI4UError):
            add_context(error, self._agent, block, doing)
        elif not isinstance(block, LostBrain):
            who = _("agent {id!r}", id=self._agent.id)
            problem = BlockError(
                join(
                    [join([who, block_label(block)], ", ") if block else who, text_of(error)], ": "
                )
            )
            problem.where = (self._agent, block or "body")
            raise problem from error


def _check_each_once(agent: _Agent, blocks: Iterable[Block]) -> None:
    """Check that no block, nor a block inside one, occurs in an agent twice.

    Raises:
        SetupError: one does.
    """
    known: set[int] = set()
    for block in walk_blocks(blocks):
        if id(block) in known:
            raise SetupError(
                _(
                    "agent {id!r}: the same {block} stands in it twice; make one for each place, "
                    "as in {type}(...) there as well",
                    id=agent.id,
                    block=block_label(block),
                    type=type(block).__name__,
                )
            )
        known.add(id(block))


def _enabled_brain(agent: _Agent, brains: Sequence[Brain]) -> Brain:
    """Return the one enabled brain of an agent.

    Args:
        agent: for the message.
        brains: its brains.

    Raises:
        SetupError: none or several are enabled.
    """
    enabled = [brain for brain in brains if brain.enabled]
    if not enabled:
        problem = SetupError(
            _(
                "agent {id!r}: expected exactly one enabled brain, got none ({count} are switched "
                "off); add one, such as brains=[LocalBrain(controller=WASDRBMoveController())]",
                id=agent.id,
                count=len(brains),
            )
            if brains
            else _(
                "agent {id!r}: expected exactly one enabled brain, got none; add one, such as "
                "brains=[LocalBrain(controller=WASDRBMoveController())]",
                id=agent.id,
            )
        )
        problem.where = (agent, "brains")
        raise problem
    if len(enabled) > 1:
        names = [brain.title() for brain in enabled]
        problem = SetupError(
            _(
                "agent {id!r}: expected exactly one enabled brain, got {count}: {names}; set "
                "enabled=False on the others",
                id=agent.id,
                count=len(enabled),
                names=listed(names),
            )
        )
        problem.where = (agent, enabled[1])
        raise problem
    return enabled[0]


_TWO_REWARDS = _(
    "agent {id!r}: two reward functions have the name {name!r}; give one of them another, as in "
    "name='{name}_2'"
)
_TWO_SENSORS = _(
    "agent {id!r}: two sensors have the perception_key {name!r}; give one of them another, as in "
    "perception_key='{name}_2'"
)
_TWO_ACTUATORS = _(
    "agent {id!r}: two actuators have the action_name {name!r}; give one of them another, as in "
    "action_name='{name}_2'"
)


def _check_unique(agent: _Agent, two: Text, field: str, blocks: Sequence[Block]) -> None:
    """Raise a SetupError if two blocks of an agent have the same name.

    Args:
        agent: the owner of the blocks.
        two: the message, with the agent's id and the name.
        field: the parameter that holds the name.
        blocks: all blocks of that kind.
    """
    names: set[str] = set()
    for block in blocks:
        name = getattr(block, field)
        if name in names:
            problem = SetupError(Text(two.msgid, {"id": agent.id, "name": name}))
            problem.where = (agent, block)
            raise problem
        names.add(name)


def _read_text(sensor: Sensor, body: BodyView, view: WorldView) -> Texts:
    """Return the reading of a sensor of type sstring."""
    return str(sensor.read(body, view)) if sensor.is_active else ""


def _read_texts(sensor: Sensor, body: BodyView, view: WorldView) -> Texts:
    """Return the reading of a sensor of type sstrings.

    Raises:
        ReadingError: the reading is not a list of texts.
    """
    if not sensor.is_active:
        return ()
    texts = sensor.read(body, view)
    if not isinstance(texts, list | tuple) or not all(isinstance(each, str) for each in texts):
        raise ReadingError(_("expected a list of texts, got {texts}", texts=repr(texts)))
    return tuple(texts)


def _refuse_amount(amount: float) -> None:
    raise ReadingError(_("expected a finite number, got {amount}", amount=amount))


def _as_amount(value: object) -> float:
    """Return an amount that a reward function paid as a float.

    Raises:
        ReadingError: the amount is no number.
    """
    try:
        return float(value)  # type: ignore[arg-type]  # anything may come; the next line says so
    except (TypeError, ValueError):
        raise ReadingError(
            _("expected a number from on_update, got {value}", value=repr(value))
        ) from None
