"""An episode while it happens."""

from importlib.metadata import version

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.version import __version__
from ai4u_edu.blocks import Brain
from ai4u_edu.recording.checksum import percept_checksum, world_checksum
from ai4u_edu.recording.episode import (
    ENDED,
    LONGEST_DRIVER,
    REPEAT,
    TERMINATED,
    TRUNCATED,
    AgentRecord,
    Episode,
    Restart,
)
from ai4u_edu.recording.table import Table
from ai4u_edu.scenes import SceneDescription

LONGEST = 6_000_000
"""Bytes, about, that an episode may take up in memory; what comes after is not recorded."""
LATEST = 2_000_000
"""The last tick that is recorded: nine hours, at 60 a second."""

VERSIONS = {"ai4u-edu": __version__} | {name: version(name) for name in ("pymunk", "numpy")}


class _Column:
    """What one agent did so far."""

    def __init__(self, agent_id: str) -> None:
        self.id = agent_id
        self.begin: list[int] = []
        self.end: list[int] = []
        self.skip: list[int] = []
        self.flags: list[int] = []
        self.actions: list[dict[str, tuple[float, ...]]] = []
        self.terms: list[dict[str, float]] = []
        self.rewards: list[float] = []
        self.percepts: list[int] = []
        self.worlds: list[int] = []
        self.starts: list[int] = []
        self.firsts: list[int] = []
        self.brain: Brain | None = None
        self.drivers: dict[str, None] = {}
        self.under_way = -1
        """The agent's own count of its decisions when the open one began; -1 for none."""

    def record(self, count: int) -> AgentRecord:
        """The first ``count`` decisions."""
        return AgentRecord(
            id=self.id,
            begin=np.array(self.begin[:count], np.uint32),
            end=np.array(self.end[:count], np.uint32),
            skip=np.array(self.skip[:count], np.uint16),
            flags=np.array(self.flags[:count], np.uint8),
            actions=Table.of(self.actions[:count]),
            terms=Table.of(
                {name: (amount,) for name, amount in row.items()} for row in self.terms[:count]
            ),
            rewards=np.array(self.rewards[:count], np.float64),
            percepts=np.array(self.percepts[:count], np.uint32),
            worlds=np.array(self.worlds[:count], np.uint32),
            starts=np.array(self.starts, np.uint32),
            firsts=np.array(self.firsts, np.uint32),
            driver=", ".join(self.drivers)[:LONGEST_DRIVER],
        )


class EpisodeBuilder:
    """An episode of a world under way.

    Args:
        sim: the world and its agents, just reset.
        scene: what they are.
    """

    def __init__(self, sim: ControlRequestor, scene: SceneDescription) -> None:
        self._sim = sim
        self._scene = scene
        self._seed = sim.world.seeds.seed
        self._columns = [_Column(agent.id) for agent in sim.agents]
        self._index = {agent.id: index for index, agent in enumerate(sim.agents)}
        self._order: list[int] = []
        self._restarts: list[tuple[int, list[int]]] = []
        self._together: list[int] | None = None
        self._ticks = 0
        self._size = 0
        self.changed: int | None = None
        self.cut = False

    @property
    def restarts(self) -> int:
        """How many times agents began anew so far."""
        return len(self._restarts)

    def leave(self) -> None:
        """Agents are about to begin anew: those that do it together follow each other."""
        self._together = None

    def first(self, agent: BasicAgent) -> None:
        """An agent's own episode begins."""
        if self.cut:
            return
        index = self._index[agent.id]
        column = self._columns[index]
        ticks = self._sim.world.ticks
        if column.firsts:  # the first one is the world's own
            if self._together is None:
                self._together = []
                self._order.append(-1 - len(self._restarts))
                self._restarts.append((ticks, self._together))
            self._together.append(index)
            self._ticks = ticks
        column.under_way = -1
        column.starts.append(len(column.begin))
        column.firsts.append(percept_checksum(agent.percept))

    def decided(self, agent: BasicAgent) -> None:
        """A decision begins."""
        world, brain = self._sim.world, agent.brain
        self._size += 80 + 8 * sum(map(len, agent.last_action.values()))
        if self.cut or self._size > LONGEST or world.ticks > LATEST:
            self.cut = True
            return
        index = self._index[agent.id]
        column = self._columns[index]
        self._order.append(index)
        column.begin.append(world.ticks)
        column.end.append(world.ticks)
        column.skip.append(brain.skip_frame)
        column.flags.append(REPEAT * brain.repeat_action)
        column.actions.append(agent.last_action)
        column.terms.append({})
        column.rewards.append(0.0)
        column.percepts.append(0)
        column.worlds.append(world_checksum(world))
        column.under_way = agent.steps
        if brain is not column.brain:
            column.brain = brain
            column.drivers[brain.title()] = None

    def sensed(self, agent: BasicAgent) -> None:
        """What an agent senses first after a decision ends it: all is paid by then."""
        column = self._columns[self._index[agent.id]]
        if self.cut or column.under_way < 0 or agent.steps != column.under_way + 1:
            return
        column.under_way = -1
        ledger = agent.ledger
        self._size += 8 * len(ledger.terms)
        self._ticks = column.end[-1] = self._sim.world.ticks
        column.flags[-1] |= ENDED | TERMINATED * agent.terminated | TRUNCATED * agent.truncated
        column.terms[-1] = dict(ledger.terms)
        column.rewards[-1] = ledger.total
        column.percepts[-1] = percept_checksum(agent.percept)

    def episode(self) -> Episode:
        """What happened so far."""
        order, counts = list(self._order), [len(column.begin) for column in self._columns]
        while order and order[-1] >= 0 and self._came_to_nothing(order[-1], counts):
            counts[order.pop()] -= 1
        return Episode(
            scene=self._scene,
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
        )

    def _came_to_nothing(self, index: int, counts: list[int]) -> bool:
        """Whether an agent's last decision was taken when all that counts was over."""
        column, last = self._columns[index], counts[index] - 1
        return not column.flags[last] & ENDED and column.begin[last] >= self._ticks
