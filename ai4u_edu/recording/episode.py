"""Recorded episodes as data, from which they can be replayed."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple, Self

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.recording.table import Table
from ai4u_edu.scenes import SceneDescription

REPEAT, ENDED, TERMINATED, TRUNCATED, DONE_REQUESTED = 1, 2, 4, 8, 16
"""Bits of a decision's flags."""

NO_ROWS = Table.of([])
MAX_DRIVER_CHARS = 200
"""Length of a driver's title."""

Ticks = npt.NDArray[np.uint32]


class Decision(NamedTuple):
    """One decision of an agent: its action and its reward."""

    step: int
    """Index among the agent's decisions in this recording."""
    begin: int
    """Tick at which it was taken; the agent's percept was of the same tick."""
    end: int
    """Tick after which it was rewarded; ``begin`` if it never was."""
    action: dict[str, tuple[float, ...]]
    reward_terms: dict[str, float]
    reward: float
    ended: bool
    """True if it ended normally; False if a restart interrupted it."""
    terminated: bool
    truncated: bool
    skip_frame: int
    repeat_action: bool


@dataclass(frozen=True, eq=False)
class AgentRecord:
    """All n decisions of one agent, column by column."""

    id: str
    begin: Ticks
    """(n,) tick at which each was taken."""
    end: Ticks
    """(n,) tick after which each was rewarded."""
    skip: npt.NDArray[np.uint16]
    """(n,) ``skip_frame`` of the brain."""
    flags: npt.NDArray[np.uint8]
    """(n,) REPEAT, ENDED, TERMINATED, TRUNCATED, DONE_REQUESTED (before it was taken)."""
    actions: Table
    terms: Table
    rewards: npt.NDArray[np.float64]
    """(n,) sum of the reward terms."""
    percepts: npt.NDArray[np.uint32]
    """(n,) checksum of the percept after each."""
    worlds: npt.NDArray[np.uint32]
    """(n,) checksum of all poses and velocities when each was taken."""
    starts: npt.NDArray[np.uint32]
    """(m,) number of decisions before each of the agent's own episodes."""
    firsts: npt.NDArray[np.uint32]
    """(m,) checksum of the first percept of each of these episodes."""
    driver: str = ""
    """Title of the brain that decided; of several, that of the most decisions is the first."""
    carried: Table = NO_ROWS
    """(n,) reward terms that were paid before each was taken, as by a controller, which no replay
    can compute; no rows if none were."""

    def __len__(self) -> int:
        return len(self.begin)

    def __getitem__(self, step: int) -> Decision:
        flags = int(self.flags[step])
        return Decision(
            step=step,
            begin=int(self.begin[step]),
            end=int(self.end[step]),
            action=self.actions[step],
            reward_terms={name: amount for name, (amount,) in self.terms[step].items()},
            reward=float(self.rewards[step]),
            ended=bool(flags & ENDED),
            terminated=bool(flags & TERMINATED),
            truncated=bool(flags & TRUNCATED),
            skip_frame=int(self.skip[step]),
            repeat_action=bool(flags & REPEAT),
        )

    def carried_into(self, step: int) -> dict[str, float]:
        """Return the reward terms that were paid before a decision was taken."""
        if not len(self.carried):
            return {}
        return {name: amount for name, (amount,) in self.carried[step].items()}

    def __iter__(self) -> Iterator[Decision]:
        return (self[step] for step in range(len(self)))

    @property
    def total(self) -> float:
        """Sum of all rewards."""
        return float(self.rewards.sum())


class Restart(NamedTuple):
    """A restart of some agents' episodes while the world went on."""

    tick: int
    agents: tuple[int, ...]
    """Indices of the agents, in the order in which they act."""


@dataclass(frozen=True, eq=False)
class Episode:
    """A recorded episode of a world, from one reset to the next.

    It contains no percepts: :class:`~ai4u_edu.recording.Replay` computes them again from the scene,
    the seed and the actions, bit for bit, and checks them by their checksums.
    """

    scene: SceneDescription
    seed: int
    agents: tuple[AgentRecord, ...]
    """Agents in the order in which they act."""
    order: npt.NDArray[np.int32]
    """Order of events: the index of an agent for a decision, ``-1 - i`` for restart i."""
    restarts: tuple[Restart, ...]
    ticks: int
    """Tick at which the last decision ended."""
    changed: int | None
    """Tick at which a person edited the world, which ends the exact replay; None if nobody did."""
    cut: bool
    """True if it was too long to be recorded completely."""
    versions: dict[str, str]
    """Versions of the packages that ran, by name."""

    def agent(self, agent_id: str | None = None) -> AgentRecord:
        """Return the record of an agent; by default of the one that acts first."""
        for record in self.agents:
            if agent_id in (None, record.id):
                return record
        raise NameNotFoundError(
            f"no agent has the id {agent_id!r}; {suggest(str(agent_id), self.ids)}"
        )

    @property
    def ids(self) -> tuple[str, ...]:
        """Ids of the agents."""
        return tuple(record.id for record in self.agents)

    @property
    def seconds(self) -> float:
        """Duration in world time (s)."""
        return self.ticks / self.scene.world.ticks_per_second

    @property
    def success(self) -> bool | None:
        """True if an agent reached the scene's goal; None for a scene without a goal."""
        goal = self.scene.success
        if goal is None:
            return None
        return any(
            decision.reward_terms.get(goal, 0.0) > 0
            for record in self.agents
            if any(name == goal for form in record.terms.forms for name, _ in form)
            for decision in record
        )

    @cached_property
    def places(self) -> tuple[npt.NDArray[np.int64], ...]:
        """Indices in ``order`` of each agent's decisions."""
        return tuple(np.flatnonzero(self.order == index) for index in range(len(self.agents)))

    @cached_property
    def restart_places(self) -> npt.NDArray[np.int64]:
        """Indices in ``order`` of the restarts."""
        return np.flatnonzero(self.order < 0)

    def save(self, path: str | Path) -> Path:
        """Write the episode to a file atomically, and return the path.

        Args:
            path: of the file; ``.episode`` is the usual suffix.
        """
        from ai4u_edu.recording.file import save

        return save(self, Path(path))

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """Read an episode from a file; nothing in it is executed.

        Raises:
            RecordingError: it is no episode file, or something in it is wrong.
        """
        from ai4u_edu.recording.file import load

        return load(cls, Path(path))

    def __str__(self) -> str:
        told = ", ".join(f"agent {r.id}: {len(r)} decisions, {r.total:g}" for r in self.agents)
        return f"{self.scene.name}, seed {self.seed}, {self.seconds:.1f} s; {told}"
