"""An episode as data: from it the same world can be made, and the same actions taken in it."""

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

REPEAT, ENDED, TERMINATED, TRUNCATED = 1, 2, 4, 8
"""The bits of a decision's flags."""

LONGEST_DRIVER = 200
"""Characters of a driver's name."""

Ticks = npt.NDArray[np.uint32]


class Decision(NamedTuple):
    """What an agent did once, and what it got for that."""

    step: int
    """Which of the agent's decisions it was in this recording, from 0 on."""
    begin: int
    """The tick at which it was taken; the agent's percept was that of the same tick."""
    end: int
    """The tick after which it was paid; ``begin`` if it never was."""
    action: dict[str, tuple[float, ...]]
    reward_terms: dict[str, float]
    reward: float
    ended: bool
    """Whether it came to its end; a restart in the middle of it takes that away."""
    terminated: bool
    truncated: bool
    skip_frame: int
    repeat_action: bool


@dataclass(frozen=True, eq=False)
class AgentRecord:
    """All decisions of one agent, n of them, column by column."""

    id: str
    begin: Ticks
    """(n,) the tick at which each was taken."""
    end: Ticks
    """(n,) the tick after which each was paid."""
    skip: npt.NDArray[np.uint16]
    """(n,) the brain's skip_frame."""
    flags: npt.NDArray[np.uint8]
    """(n,) REPEAT, ENDED, TERMINATED, TRUNCATED."""
    actions: Table
    terms: Table
    rewards: npt.NDArray[np.float64]
    """(n,) the sum of the terms."""
    percepts: npt.NDArray[np.uint32]
    """(n,) the checksum of what the agent sensed after each."""
    worlds: npt.NDArray[np.uint32]
    """(n,) the checksum of all poses and speeds when each was taken."""
    starts: npt.NDArray[np.uint32]
    """(m,) the agent's own episodes: how many decisions came before each."""
    firsts: npt.NDArray[np.uint32]
    """(m,) the checksum of the first percept of each."""
    driver: str = ""
    """The title of the brain that decided; of several, one after the other."""

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

    def __iter__(self) -> Iterator[Decision]:
        return (self[step] for step in range(len(self)))

    @property
    def total(self) -> float:
        """All rewards together."""
        return float(self.rewards.sum())


class Restart(NamedTuple):
    """Agents that began a new episode while the world went on."""

    tick: int
    agents: tuple[int, ...]
    """By their numbers, in the order in which they act."""


@dataclass(frozen=True, eq=False)
class Episode:
    """A recorded episode of a world, from one reset to the next.

    Percepts are not in it: the scene, the seed and the actions give them again, bit for bit, which
    :class:`~ai4u_edu.recording.Replay` does. Checksums tell whether they are the same.
    """

    scene: SceneDescription
    seed: int
    agents: tuple[AgentRecord, ...]
    """In the order in which they act."""
    order: npt.NDArray[np.int32]
    """What was decided after what: the number of an agent, or ``-1 - i`` for restart i."""
    restarts: tuple[Restart, ...]
    ticks: int
    """The tick at which the last decision ended."""
    changed: int | None
    """The tick at which somebody changed the world by hand; it can be played again up to there."""
    cut: bool
    """Whether it was too long to be recorded whole."""
    versions: dict[str, str]
    """Of the packages that ran, by name."""

    def agent(self, agent_id: str | None = None) -> AgentRecord:
        """The record of an agent; left out, of the one that acts first."""
        for record in self.agents:
            if agent_id in (None, record.id):
                return record
        raise NameNotFoundError(
            f"no agent has the id {agent_id!r}; {suggest(str(agent_id), self.ids)}"
        )

    @property
    def ids(self) -> tuple[str, ...]:
        """The agents' ids."""
        return tuple(record.id for record in self.agents)

    @property
    def seconds(self) -> float:
        """How long it lasted, in the world's time."""
        return self.ticks / self.scene.world.ticks_per_second

    @property
    def success(self) -> bool | None:
        """Whether somebody reached the scene's goal; None for a scene without one."""
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
        """Where in ``order`` each agent's decisions stand."""
        return tuple(np.flatnonzero(self.order == index) for index in range(len(self.agents)))

    @cached_property
    def restart_places(self) -> npt.NDArray[np.int64]:
        """Where in ``order`` the restarts stand."""
        return np.flatnonzero(self.order < 0)

    def save(self, path: str | Path) -> Path:
        """Writes it to a file, whole or not at all.

        Args:
            path: of the file; ``.episode`` is the usual ending.
        """
        from ai4u_edu.recording.file import save

        return save(self, Path(path))

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """Reads a file. Nothing in it is ever run.

        Raises:
            RecordingError: it is no such file, or something in it is wrong.
        """
        from ai4u_edu.recording.file import load

        return load(cls, Path(path))

    def __str__(self) -> str:
        told = ", ".join(f"agent {r.id}: {len(r)} decisions, {r.total:g}" for r in self.agents)
        return f"{self.scene.name}, seed {self.seed}, {self.seconds:.1f} s; {told}"
