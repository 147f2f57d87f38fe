"""The keys and the stick that a person holds, shared between the server's and world's threads."""

import math
import threading
import time
from collections.abc import Callable, Iterable
from typing import NamedTuple

KEY_TIMEOUT_S = 0.3
"""Time (s) without a message after which keys count as released. A page that holds keys sends about
ten messages a second."""


class Stick(NamedTuple):
    """Deflection of a stick, on a screen or a gamepad; each number from -1 to 1."""

    forward: float = 0.0
    """Forward deflection; 1 is full speed ahead."""
    turn: float = 0.0
    """Sideways deflection; 1 is to the right (clockwise), as in an action."""


CENTERED = Stick()


class Keyboard:
    """The keys that are held; thread-safe: the server's thread writes, the world's thread reads.

    Keys are codes of positions on the keyboard (``KeyW``, ``ArrowUp``, ``Space``), as in a
    browser's ``KeyboardEvent.code``, so they don't depend on the layout. A stick does the same as
    the keys for forward, backward, left and right, in finer steps.

    Args:
        clock: returns seconds.

    >>> now = 0.0
    >>> keyboard = Keyboard(clock=lambda: now)
    >>> keyboard.hold(["KeyW"])
    >>> sorted(keyboard.read())
    ['KeyW']
    >>> now = 0.5
    >>> sorted(keyboard.read())
    []
    """

    timeout_s: float = KEY_TIMEOUT_S
    """Time (s) without a message after which keys count as released. May be set, as for one
    keyboard whose pages have a slow network, or for all: ``Keyboard.timeout_s = 1.0``."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self.clock = clock
        """Returns seconds; may be replaced."""
        self._lock = threading.Lock()
        self._held: frozenset[str] = frozenset()
        self._tapped: frozenset[str] = frozenset()
        self._stick = CENTERED
        self._last_message = -math.inf

    def hold(self, codes: Iterable[str], stick: Stick = CENTERED) -> None:
        """Set the keys that are held now, and the stick's deflection."""
        codes = frozenset(codes)
        with self._lock:
            self._tapped |= codes - self._held
            self._held, self._stick, self._last_message = codes, stick, self.clock()

    def release(self) -> None:
        """Release all keys, also those that were only tapped, and the stick."""
        with self._lock:
            self._let_go()

    def held(self) -> frozenset[str]:
        """Return the keys that are held now."""
        with self._lock:
            return self._current()

    def read(self) -> frozenset[str]:
        """Return the keys held now or pressed since the last read, so that no tap is missed."""
        with self._lock:
            keys = self._current() | self._tapped
            self._tapped = frozenset()
            return keys

    def stick(self) -> Stick:
        """Return the stick's present deflection."""
        with self._lock:
            self._current()
            return self._stick

    def _current(self) -> frozenset[str]:
        if self.clock() - self._last_message > self.timeout_s:
            self._let_go()
        return self._held

    def _let_go(self) -> None:
        self._held = self._tapped = frozenset()
        self._stick = CENTERED


def combine(keys: float, stick: float) -> float:
    """Combine keys and a stick for one direction into a number from -1 to 1.

    >>> combine(1, 0.5), combine(-1, 0.25), combine(0, 0.25)
    (1, -0.75, 0.25)
    """
    return max(-1, min(1, keys + stick))
