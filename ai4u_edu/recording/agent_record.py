"""The decisions of one agent in a recorded episode."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.recording.table import Table

REPEAT, ENDED, TERMINATED, TRUNCATED, DONE_REQUESTED, PERSON = 1, 2, 4, 8, 16, 32
"""Bits of a decision's flags. Files of earlier versions have no PERSON."""

NO_ROWS = Table.of([])
Ticks = npt.NDArray[np.uint32]


class RecordedDecision(NamedTuple):
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
    """(n,) REPEAT, ENDED, TERMINATED, TRUNCATED, DONE_REQUESTED (before it was taken), PERSON (a
    brain that listens to keys decided)."""
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

    def __getitem__(self, step: int) -> RecordedDecision:
        flags = int(self.flags[step])
        return RecordedDecision(
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

    def reached(self, goal: str) -> bool | None:
        """Return True if a reward term paid above 0; None if the agent has no such term."""
        if not any(name == goal for form in self.terms.forms for name, _ in form):
            return None
        return any(decision.reward_terms.get(goal, 0.0) > 0 for decision in self)

    def carried_into(self, step: int) -> dict[str, float]:
        """Return the reward terms that were paid before a decision was taken."""
        if not len(self.carried):
            return {}
        return {name: amount for name, (amount,) in self.carried[step].items()}

    def __iter__(self) -> Iterator[RecordedDecision]:
        return (self[step] for step in range(len(self)))

    @property
    def total(self) -> float:
        """Sum of all rewards."""
        return float(self.rewards.sum())
