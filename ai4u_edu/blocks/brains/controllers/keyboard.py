"""The keys that a person holds and the stick that they push, as the physics' thread sees them."""

import threading
import time
from collections.abc import Callable, Iterable
from typing import NamedTuple

__all__ = ["Keyboard"]

SILENCE = 0.3
"""A page that holds keys says so about ten times a second; after this long without a word (s) the
keys count as released."""


class Stick(NamedTuple):
    """How far a stick is pushed, on a screen or a gamepad; each number from -1 to 1."""

    forward: float = 0.0
    """1 is ahead."""
    turn: float = 0.0
    """1 is to the right, clockwise, as in an action."""


AT_REST = Stick()


class Keyboard:
    """Which keys are held: written by the server's thread, read by the world's.

    Keys are codes of places on the keyboard (``KeyW``, ``ArrowUp``, ``Space``), as a browser's
    ``KeyboardEvent.code`` has them, so they don't depend on the layout. A stick does by halves what
    the keys for ahead, back, left and right do.

    Args:
        clock: seconds; to be replaced in tests.

    >>> now = 0.0
    >>> keyboard = Keyboard(clock=lambda: now)
    >>> keyboard.hold(["KeyW"])
    >>> sorted(keyboard.read())
    ['KeyW']
    >>> now = 0.5
    >>> sorted(keyboard.read())
    []
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._lock = threading.Lock()
        self._held: frozenset[str] = frozenset()
        self._tapped: frozenset[str] = frozenset()
        self._stick = AT_REST
        self._heard = -SILENCE

    def hold(self, codes: Iterable[str], stick: Stick = AT_REST) -> None:
        """These keys, and no others, are held now, and a stick is pushed so far."""
        codes = frozenset(codes)
        with self._lock:
            self._tapped |= codes - self._held
            self._held, self._stick, self._heard = codes, stick, self._clock()

    def release(self) -> None:
        """Lets all keys go, also those that were only tapped, and the stick."""
        with self._lock:
            self._let_go()

    def held(self) -> frozenset[str]:
        """The keys that are held now."""
        with self._lock:
            return self._current()

    def read(self) -> frozenset[str]:
        """The keys held now or pressed since the last read: so a quick tap is never missed."""
        with self._lock:
            keys = self._current() | self._tapped
            self._tapped = frozenset()
            return keys

    def stick(self) -> Stick:
        """How far the stick is pushed now."""
        with self._lock:
            self._current()
            return self._stick

    def _current(self) -> frozenset[str]:
        if self._clock() - self._heard > SILENCE:
            self._let_go()
        return self._held

    def _let_go(self) -> None:
        self._held = self._tapped = frozenset()
        self._stick = AT_REST


def combine(keys: float, stick: float) -> float:
    """What keys and a stick say of one direction, from -1 to 1.

    >>> combine(1, 0.5), combine(-1, 0.25), combine(0, 0.25)
    (1, -0.75, 0.25)
    """
    return max(-1, min(1, keys + stick))
