"""Who paid what: the reward of a decision and of an episode, by named term."""

from collections import deque
from collections.abc import Mapping
from typing import NamedTuple

HANDLERS = "handlers"
"""The term under which ``agent.add_reward`` books what is given no other name."""

NOTHING: tuple[float, Mapping[str, float]] = (0.0, {})
"""The total and the terms before the first decision of an episode is over."""


class Entry(NamedTuple):
    """What one decision was paid."""

    step: int
    """The number of the decision in its episode, from 1."""
    terms: Mapping[str, float]
    """By name."""
    so_far: float
    """The episode's total, this decision's reward included."""

    @property
    def total(self) -> float:
        """What it was paid altogether."""
        return sum(self.terms.values(), 0.0)


class Ledger:
    """The breakdown of rewards.

    Attributes:
        terms: by name, what was paid in the last decision, or in the one that is under way.
        episode_terms: by name, what was paid in this episode.
        total: of the last decision, or of the one that is under way.
        episode_total: of this episode.
        history: the latest decisions of this episode, if :meth:`remember` was called.

    >>> ledger = Ledger()
    >>> ledger.pay("touch", 100.0); ledger.pay("step", -0.5)
    >>> ledger.total, ledger.terms
    (99.5, {'touch': 100.0, 'step': -0.5})
    >>> ledger.open()
    >>> ledger.total, ledger.episode_total
    (0.0, 99.5)
    """

    def __init__(self) -> None:
        self.terms: dict[str, float] = {}
        self.episode_terms: dict[str, float] = {}
        self.total = 0.0
        self.episode_total = 0.0
        self.history: deque[Entry] = deque(maxlen=0)
        self._latest: tuple[Entry, ...] | None = None
        self._is_closed = False
        self._finished: tuple[float, Mapping[str, float]] = NOTHING

    @property
    def finished(self) -> tuple[float, Mapping[str, float]]:
        """The total and the terms of the last decision that is over; the one under way is not."""
        return (self.total, self.terms) if self._is_closed else self._finished

    def remember(self, decisions: int) -> None:
        """Keeps the latest decisions from now on, for those who look; training needs none."""
        if self.history.maxlen != decisions:
            self.history = deque(self.history, decisions)
            self._latest = None

    def open(self) -> None:
        """A decision begins: nothing is paid for it yet."""
        if self._is_closed:
            self._finished = self.total, self.terms
            self._is_closed = False
        self.terms = {}
        self.total = 0.0

    def pay(self, name: str, amount: float) -> None:
        """Books an amount under a name."""
        terms, episode_terms = self.terms, self.episode_terms
        terms[name] = terms.get(name, 0.0) + amount
        episode_terms[name] = episode_terms.get(name, 0.0) + amount
        self.total += amount
        self.episode_total += amount

    def close(self, step: int) -> None:
        """A decision is over: what is added until the next one begins still belongs to it."""
        self._is_closed = True
        if self.history.maxlen:
            self.history.append(Entry(step, self.terms, self.episode_total))
            self._latest = None

    def clear(self) -> None:
        """An episode begins."""
        self.open()
        self._finished = NOTHING
        self.episode_terms = {}
        self.episode_total = 0.0
        self.history.clear()
        self._latest = None

    def latest(self) -> tuple[Entry, ...]:
        """The history as it is now: the same object until another decision is over."""
        if self._latest is None:
            self._latest = tuple(self.history)
        return self._latest
