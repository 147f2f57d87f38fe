"""The count of answers that remote brains owe, and a wake-up when the last one is there."""

import threading


class PendingAnswers:
    """Counts the answers that the runner's thread waits for.

    The runner's thread clears and waits; links expect and notify, from any thread.

    Args:
        wake: set when the last answer that was expected is there.
    """

    def __init__(self, wake: threading.Event) -> None:
        self._wake = wake
        self._lock = threading.Lock()
        self._count = 0

    def clear(self) -> None:
        """Expect nothing."""
        with self._lock:
            self._count = 0

    def expect(self, answers: int = 1) -> int:
        """Expect so many more answers; return how many are outstanding."""
        with self._lock:
            self._count += answers
            return self._count

    def notify(self) -> None:
        """Note an answer. The caller's thread does nothing else: the next tick may take long."""
        with self._lock:
            self._count -= 1
            is_last = self._count <= 0
        if is_last:
            self._wake.set()
