"""Seeds: all random numbers of an episode follow from one seed."""

from collections.abc import Mapping
from operator import index
from typing import Any
from zlib import crc32

import numpy as np

from ai4u_edu.base.errors import SeedError, shown
from ai4u_edu.locale import gettext as _

MAX_SEED = 2**63 - 1
"""Largest seed: recordings and messages keep seeds as signed 64-bit integers."""
MAX_TRAINING_SEED = 2**32 - 1
"""Largest seed of a training: Stable-Baselines3 seeds NumPy's global generator with it."""


def checked_seed(seed: Any) -> int:
    """Return a seed as a Python int.

    Raises:
        SeedError: the seed is no whole number from 0 to :data:`MAX_SEED`.

    >>> checked_seed(7)
    7
    >>> checked_seed(10**20)
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.SeedError: seed: expected a whole number from 0 to 9223372036854775807, \
got 100000000000000000000
    """
    try:
        found = -1 if isinstance(seed, bool | np.bool_) else index(seed)
    except TypeError:
        found = -1
    if not 0 <= found <= MAX_SEED:
        raise SeedError(
            _(
                "seed: expected a whole number from 0 to {max_seed}, got {got}",
                max_seed=MAX_SEED,
                got=shown(seed),
            )
        )
    return found


def seeds_from(first: Any, count: int) -> range:
    """Return the seeds of some episodes, one by one.

    Raises:
        SeedError: the last one would be larger than :data:`MAX_SEED`.

    >>> list(seeds_from(7, 3))
    [7, 8, 9]
    """
    first = checked_seed(first)
    if first + count - 1 > MAX_SEED:
        raise SeedError(
            _(
                "seed: expected room for {count} seeds up to {max_seed}, got {first} as the first "
                "one",
                count=count,
                max_seed=MAX_SEED,
                first=first,
            )
        )
    return range(first, first + count)


class Seeds:
    """The random generators of one episode: one for the world and one for each block by name.

    An episode depends on its seed alone, not on what was drawn before it, so any episode of a
    long run can be played again from the number it began with.

    Args:
        seed: a whole number from 0 to :data:`MAX_SEED`.

    Raises:
        SeedError: it is no such number.

    >>> seeds = Seeds(7)
    >>> first = seeds.child("vision").random()
    >>> seeds.child("hearing").random() != first
    True
    >>> Seeds(7).child("vision").random() == first
    True
    """

    def __init__(self, seed: int) -> None:
        self.seed = checked_seed(seed)
        self._children: dict[str, np.random.Generator] = {}

    @property
    def generator(self) -> np.random.Generator:
        """The world's own generator."""
        return self.child("")

    def child(self, name: str) -> np.random.Generator:
        """Return the generator of a name, the same object at every call."""
        child = self._children.get(name)
        if child is None:
            entropy: Any = [self.seed, crc32(name.encode())]
            if self.seed < 2**32:  # an array gives the same numbers as a list, in half the time
                entropy = np.array(entropy, np.uint32)
            sequence = np.random.SeedSequence(entropy)
            child = self._children[name] = np.random.Generator(np.random.PCG64(sequence))
        return child

    def get_state(self) -> dict[str, Mapping[str, Any]]:
        """Return the states of all generators that were used, by name."""
        return {name: child.bit_generator.state for name, child in self._children.items()}

    def set_state(self, state: Mapping[str, Mapping[str, Any]]) -> None:
        """Let the generators go on as those of another episode of the same seed would."""
        for name, numbers in state.items():
            self.child(name).bit_generator.state = numbers

    def next(self) -> "Seeds":
        """Return the seeds of the next episode, for a reset without a seed."""
        return Seeds(int(np.random.SeedSequence(self.seed).generate_state(1)[0]))
