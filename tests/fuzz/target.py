"""What is fuzzed: where its inputs come from, what reads them, and what it may raise."""

import random
from collections.abc import Callable
from dataclasses import dataclass

MILLION, MANY = 1_000_000, 100_000


@dataclass(frozen=True)
class Target:
    """One reader of what somebody else wrote."""

    name: str
    make: Callable[[random.Random], bytes]
    """An input, by chance."""
    read: Callable[[bytes], object]
    allowed: tuple[type[Exception], ...]
    """The errors that it declares; anything else is a finding."""
    count: int = MILLION
    """Inputs of a long run."""
    packages: tuple[str, ...] = ()
    """Whose branches a coverage-guided fuzzer looks at."""
    seeds: tuple[bytes, ...] = ()
    """Inputs for it to begin with."""

    def reads(self, data: bytes) -> bool:
        """Whether an input is a right one; what it must not raise, it raises."""
        try:
            self.read(data)
        except self.allowed:
            return False
        return True
