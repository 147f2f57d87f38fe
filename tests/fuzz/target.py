"""A fuzz target: generator of inputs, reader, and the errors that the reader may raise."""

import random
from collections.abc import Callable
from dataclasses import dataclass

MILLION, MANY = 1_000_000, 100_000


@dataclass(frozen=True)
class Target:
    """One reader of untrusted input."""

    name: str
    make: Callable[[random.Random], bytes]
    """Return a random input."""
    read: Callable[[bytes], object]
    allowed: tuple[type[Exception], ...]
    """Errors that the reader declares; any other one is a finding."""
    count: int = MILLION
    """Inputs of a long run."""
    packages: tuple[str, ...] = ()
    """Packages whose branches a coverage-guided fuzzer instruments."""
    seeds: tuple[bytes, ...] = ()
    """Initial corpus of the coverage-guided fuzzer."""

    def reads(self, data: bytes) -> bool:
        """Return True if an input is accepted, False on a declared error; raise any other error."""
        try:
            self.read(data)
        except self.allowed:
            return False
        return True
