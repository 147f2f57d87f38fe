"""Builds the record of an episode while it happens."""

from collections import Counter
from collections.abc import Iterable, Mapping
from importlib.metadata import version

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.driving_keys import active_brain, has_driving_keys
from ai4u_edu.base.version import __version__
from ai4u_edu.blocks import Brain
from ai4u_edu.blocks.agent_view import AgentInput
from ai4u_edu.recording.agent_record import (
    DONE_REQUESTED,
    ENDED,
    NO_ROWS,
    PERSON,
    REPEAT,
    TERMINATED,
    TRUNCATED,
    AgentRecord,
)
from ai4u_edu.recording.checksum import percept_checksum, world_checksum
from ai4u_edu.recording.episode import (
    MAX_DRIVER_CHARS,
    MAX_INPUTS,
    MAX_TICK,
    Episode,
    Input,
    Restart,
)
from ai4u_edu.recording.table import Table
from ai4u_edu.scenes import SceneDescription

MAX_EPISODE_BYTES = 6_000_000
"""Approximate memory of an episode; what happens after it is reached is not recorded."""

VERSIONS = {"ai4u-edu": __version__} | {name: version(name) for name in ("pymunk", "numpy")}


class _AgentColumns:
    """Columns of one agent's decisions so far."""

    def __init__(self, agent_id: str) -> None:
        self.id = agent_id
        self.begin: list[int] = []
        self.end: list[int] = []
        self.skip: list[int] = []
        self.flags: list[int] = []
        self.actions: list[dict[str, tuple[float, ...]]] = []
        self.terms: list[dict[str, float]] = []
        self.carried: list[Mapping[str, float]] = []
        self.rewards: list[float] = []
        self.percepts: list[int] = []
        self.worlds: list[int] = []
        self.starts: list[int] = []
        self.firsts: list[int] = []
        self.brain: Brain | None = None
        self.driver = ""
        """Title of that brain."""
        self.decider: Brain | None = None
        """That brain, or one by which a person overrides it."""
        self.is_person = False
        """True if the decider listens to keys."""
        self.drivers: Counter[str] = Counter()
        """Number of decisions by the title of the brain that took them."""
        self.open_step = -1
        """The agent's step count when its unfinished decision began; -1 if there is none."""

    def record(self, count: int) -> AgentRecord:
        """Return the record of the first ``count`` decisions."""
        return AgentRecord(
            id=self.id,
            begin=np.array(self.begin[:count], np.uint32),
            end=np.array(self.end[:count], np.uint32),
            skip=np.array(self.skip[:count], np.uint16),
            flags=np.array(self.flags[:count], np.uint8),
            actions=Table.of(self.actions[:count]),
            terms=_amounts(self.terms[:count]),
            carried=_amounts(self.carried[:count]) if any(self.carried[:count]) else NO_ROWS,
            rewards=np.array(self.rewards[:count], np.float64),
            percepts=np.array(self.percepts[:count], np.uint32),
            worlds=np.array(self.worlds[:count], np.uint32),
            starts=np.array(self.starts, np.uint32),
            firsts=np.array(self.firsts, np.uint32),
            driver=", ".join(each for each, _ in self.drivers.most_common())[:MAX_DRIVER_CHARS],
        )


def _amounts(rows: Iterable[Mapping[str, float]]) -> Table:
    return Table.of({name: (amount,) for name, amount in row.items()} for row in rows)


class EpisodeBuilder:
    """Builds an :class:`Episode` from an agent's events; the runner's thread calls it.

    Args:
        sim: the world and its agents, just reset.
        scene: their description.
    """

    def __init__(self, sim: ControlRequestor, scene: SceneDescription) -> None:
        self._sim = sim
        self.scene = scene
        """Description of the world and its agents."""
        self._seed = sim.world.seeds.seed
        self._options = dict(sim.options.values)
        self._columns = [_AgentColumns(agent.id) for agent in sim.agents]
        self._index = {agent.id: index for index, agent in enumerate(sim.agents)}
        self._order: list[int] = []
        self._restarts: list[tuple[int, list[int]]] = []
        self._restarting: list[int] | None = None
        self._inputs: list[Input] = []
        self._ticks = 0
        self._size = 0
        self.changed: int | None = None
        self.cut = False

    def add_input(self, agent: BasicAgent, given: AgentInput) -> None:
        """Record numbers that a script gave to an agent's sensor."""
        self._size += 40 + 8 * len(given.values)
        if len(self._inputs) >= MAX_INPUTS:
            self.cut = True
        if not self.cut:
            index = self._index[agent.id]
            self._inputs.append(Input(self._sim.world.ticks, index, *given))

    @property
    def restarts(self) -> int:
        """Number of restarts so far."""
        return len(self._restarts)

    def end_restart(self) -> None:
        """End a group of agents that restart together; the next one that begins starts another."""
        self._restarting = None

    def begin_episode(self, agent: BasicAgent) -> None:
        """Record that an agent's own episode begins."""
        if self.cut:
            return
        index = self._index[agent.id]
        column = self._columns[index]
        ticks = self._sim.world.ticks
        if column.firsts:  # the first one begins with the world's reset
            if self._restarting is None:
                self._restarting = []
                self._order.append(-1 - len(self._restarts))
                self._restarts.append((ticks, self._restarting))
            self._restarting.append(index)
            self._ticks = ticks
        column.open_step = -1
        column.starts.append(len(column.begin))
        column.firsts.append(percept_checksum(agent.percept))

    def begin_decision(self, agent: BasicAgent) -> None:
        """Record that a decision begins."""
        world, brain = self._sim.world, agent.brain
        self._size += 80 + 8 * sum(map(len, agent.last_action.values()))
        if self.cut or self._size > MAX_EPISODE_BYTES or world.ticks > MAX_TICK:
            self.cut = True
            return
        index = self._index[agent.id]
        column = self._columns[index]
        self._order.append(index)
        column.begin.append(world.ticks)
        column.end.append(world.ticks)
        column.skip.append(brain.skip_frame)
        decider = active_brain(brain)
        if decider is not column.decider:
            column.decider, column.is_person = decider, has_driving_keys(agent)
        column.flags.append(
            REPEAT * brain.repeat_action
            | DONE_REQUESTED * agent.is_done_requested
            | PERSON * column.is_person
        )
        column.carried.append(agent.ledger.brought)
        column.actions.append(agent.last_action)
        column.terms.append({})
        column.rewards.append(0.0)
        column.percepts.append(0)
        column.worlds.append(world_checksum(world))
        column.open_step = agent.steps
        if brain is not column.brain:
            column.brain = brain
            column.driver = brain.title()
        column.drivers[column.driver] += 1

    def end_decision(self, agent: BasicAgent) -> None:
        """Record the end of a decision: the first percept after it, when all rewards are paid."""
        column = self._columns[self._index[agent.id]]
        if self.cut or column.open_step < 0 or agent.steps != column.open_step + 1:
            return
        column.open_step = -1
        ledger = agent.ledger
        self._size += 8 * len(ledger.terms)
        self._ticks = column.end[-1] = self._sim.world.ticks
        column.flags[-1] |= ENDED | TERMINATED * agent.terminated | TRUNCATED * agent.truncated
        column.terms[-1] = dict(ledger.terms)
        column.rewards[-1] = ledger.total
        column.percepts[-1] = percept_checksum(agent.percept)

    @property
    def has_open_decision(self) -> bool:
        """True while a decision has begun and not ended; False for an episode that was cut."""
        return not self.cut and any(column.open_step >= 0 for column in self._columns)

    def episode(self) -> Episode:
        """Return the episode so far."""
        order, counts = list(self._order), [len(column.begin) for column in self._columns]
        while order and order[-1] >= 0 and self._is_unfinished(order[-1], counts):
            counts[order.pop()] -= 1
        return Episode(
            scene=self.scene,
            seed=self._seed,
            agents=tuple(
                column.record(count) for column, count in zip(self._columns, counts, strict=True)
            ),
            order=np.array(order, np.int32),
            restarts=tuple(Restart(tick, tuple(agents)) for tick, agents in self._restarts),
            ticks=self._ticks,
            changed=self.changed,
            cut=self.cut,
            versions=dict(VERSIONS),
            inputs=tuple(self._inputs),
            options=self._options,
        )

    def _is_unfinished(self, index: int, counts: list[int]) -> bool:
        """Return True if an agent's last decision began at the end and never ended."""
        column, last = self._columns[index], counts[index] - 1
        return not column.flags[last] & ENDED and column.begin[last] >= self._ticks
