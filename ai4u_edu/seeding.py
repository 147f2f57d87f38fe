"""One seed an episode; all chance in it grows from that seed."""

from operator import index
from typing import Any
from zlib import crc32

import numpy as np

from ai4u_edu.errors import SeedError


class Seeds:
    """The chance of one episode: a generator for the world and one for each block by name.

    An episode depends on its seed alone, not on what was drawn before it, so any episode of a
    long run can be played again from the number it began with.

    Args:
        seed: a whole number >= 0.

    >>> seeds = Seeds(7)
    >>> first = seeds.child("vision").random()
    >>> seeds.child("hearing").random() != first
    True
    >>> Seeds(7).child("vision").random() == first
    True
    """

    def __init__(self, seed: int) -> None:
        try:
            self.seed = index(seed)
        except TypeError:
            self.seed = -1
        if self.seed < 0:
            raise SeedError(f"seed: expected a whole number >= 0, got {seed!r}")
        self._children: dict[str, np.random.Generator] = {}

    @property
    def generator(self) -> np.random.Generator:
        """The world's own generator."""
        return self.child("")

    def child(self, name: str) -> np.random.Generator:
        """The generator that belongs to a name; the same object at every call."""
        child = self._children.get(name)
        if child is None:
            entropy: Any = [self.seed, crc32(name.encode())]
            if self.seed < 2**32:  # an array gives the same numbers as a list, in half the time
                entropy = np.array(entropy, np.uint32)
            sequence = np.random.SeedSequence(entropy)
            child = self._children[name] = np.random.Generator(np.random.PCG64(sequence))
        return child

    def next(self) -> "Seeds":
        """The seeds of the episode that follows when nobody gives a seed."""
        return Seeds(int(np.random.SeedSequence(self.seed).generate_state(1)[0]))
