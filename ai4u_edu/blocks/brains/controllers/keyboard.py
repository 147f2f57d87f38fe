"""The keys that a person holds, as the physics' thread sees them."""

import threading
import time
from collections.abc import Callable, Iterable

SILENCE = 0.3
"""A page that holds keys says so about ten times a second; after this long without a word (s) the
keys count as released."""


class Keyboard:
    """Which keys are held: written by the server's thread, read by the world's.

    Keys are codes of places on the keyboard (``KeyW``, ``ArrowUp``, ``Space``), as a browser's
    ``KeyboardEvent.code`` has them, so they don't depend on the layout.

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
        self._heard = -SILENCE

    def hold(self, codes: Iterable[str]) -> None:
        """These keys, and no others, are held now."""
        codes = frozenset(codes)
        with self._lock:
            self._tapped |= codes - self._held
            self._held, self._heard = codes, self._clock()

    def release(self) -> None:
        """Lets all keys go, also those that were only tapped."""
        with self._lock:
            self._held = self._tapped = frozenset()

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

    def _current(self) -> frozenset[str]:
        if self._clock() - self._heard > SILENCE:
            self._held = self._tapped = frozenset()
        return self._held
