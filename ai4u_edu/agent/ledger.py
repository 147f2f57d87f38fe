"""Rewards of a decision and of an episode, by named term."""

from collections import deque
from collections.abc import Mapping
from copy import copy
from typing import Any, NamedTuple

HANDLERS = "handlers"
"""Default term of ``agent.add_reward``."""

NOTHING: tuple[float, Mapping[str, float]] = (0.0, {})
"""Total and terms before the first decision of an episode is over."""
CARRIED = (
    "terms",
    "episode_terms",
    "total",
    "episode_total",
    "carried",
    "brought",
    "_is_closed",
    "_is_sealed",
    "_finished",
)
"""Attributes of a ledger that a copy of the world at one moment gets; the history stays."""


class LedgerEntry(NamedTuple):
    """The rewards of one decision."""

    step: int
    """Number of the decision in its episode, from 1."""
    terms: Mapping[str, float]
    """Amounts by the term's name."""
    so_far: float
    """Episode total, this decision included."""

    @property
    def total(self) -> float:
        """Sum of the terms."""
        return sum(self.terms.values(), 0.0)


class Ledger:
    """The breakdown of rewards: each amount is in one decision, or in no total at all.

    An amount belongs to the decision under way. After its end (:meth:`close`) the decision still
    gets what its reading and other agents pay, until it is sealed (:meth:`seal`). What is paid
    after that, as by a controller, is carried into the next decision.

    Attributes:
        terms: amounts by name of the last decision, or of the one under way.
        episode_terms: amounts by name of this episode.
        total: sum of ``terms``.
        episode_total: sum of ``episode_terms``.
        history: latest decisions of this episode, if :meth:`keep_history` was called.

    >>> ledger = Ledger()
    >>> ledger.pay("touch", 100.0); ledger.pay("step", -0.5)
    >>> ledger.total, ledger.terms
    (99.5, {'touch': 100.0, 'step': -0.5})
    >>> ledger.open()
    >>> ledger.total, ledger.episode_total
    (0.0, 99.5)
    >>> ledger.close(2); ledger.seal()
    >>> ledger.pay("asked", 1.0)
    >>> ledger.total, ledger.episode_total
    (0.0, 99.5)
    >>> ledger.open()
    >>> ledger.total, ledger.episode_total
    (1.0, 100.5)
    """

    def __init__(self) -> None:
        self.terms: dict[str, float] = {}
        self.episode_terms: dict[str, float] = {}
        self.total = 0.0
        self.episode_total = 0.0
        self.history: deque[LedgerEntry] = deque(maxlen=0)
        self.carried: dict[str, float] = {}
        """Amounts by name that were paid between two decisions; the next one gets them."""
        self.brought: Mapping[str, float] = {}
        """The carried amounts that the decision under way has got."""
        self._latest: tuple[LedgerEntry, ...] | None = None
        self._is_closed = False
        self._is_sealed = False
        self._finished: tuple[float, Mapping[str, float]] = NOTHING

    @property
    def finished(self) -> tuple[float, Mapping[str, float]]:
        """Total and terms of the last finished decision, not of the one under way."""
        return (self.total, self.terms) if self._is_closed else self._finished

    def keep_history(self, decisions: int) -> None:
        """Keep the latest ``decisions`` decisions in :attr:`history`; by default none."""
        if self.history.maxlen != decisions:
            self.history = deque(self.history, decisions)
            self._latest = None

    def open(self) -> None:
        """Begin a decision, with the carried amounts alone."""
        if self._is_closed:
            self._finished = self.total, self.terms
        self._is_closed = self._is_sealed = False
        self.terms = {}
        self.total = 0.0
        self.brought, self.carried = self.carried, {}
        for name, amount in self.brought.items():
            self.pay(name, amount)

    def pay(self, name: str, amount: float) -> None:
        """Book an amount under a name."""
        if self._is_sealed:
            self.carried[name] = self.carried.get(name, 0.0) + amount
            return
        terms, episode_terms = self.terms, self.episode_terms
        terms[name] = terms.get(name, 0.0) + amount
        episode_terms[name] = episode_terms.get(name, 0.0) + amount
        self.total += amount
        self.episode_total += amount
        if self._is_closed and self.history:
            self.history[-1] = self.history[-1]._replace(so_far=self.episode_total)
            self._latest = None

    def close(self, step: int) -> None:
        """End a decision; amounts that are added until it is sealed still belong to it."""
        self._is_closed = True
        if self.history.maxlen:
            self.history.append(LedgerEntry(step, self.terms, self.episode_total))
            self._latest = None

    def seal(self) -> None:
        """Carry amounts into the next decision from now on."""
        self._is_sealed = True

    def drop_carried(self) -> None:
        """Drop the carried amounts: the first decision of an episode begins."""
        self.carried = {}

    def clear(self) -> None:
        """Begin an episode; amounts are carried until its first decision."""
        self.drop_carried()
        self.open()
        self.seal()
        self._finished = NOTHING
        self.episode_terms = {}
        self.episode_total = 0.0
        self.history.clear()
        self._latest = None

    def get_state(self) -> dict[str, Any]:
        """Return the amounts of this episode, by attribute."""
        return {name: copy(getattr(self, name)) for name in CARRIED}

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Take over the amounts of a ledger in another copy of the world."""
        for name, value in state.items():
            setattr(self, name, copy(value))
        self._latest = None

    def latest(self) -> tuple[LedgerEntry, ...]:
        """Return the history as a tuple, the same object until another decision is over."""
        if self._latest is None:
            self._latest = tuple(self.history)
        return self._latest
