"""Ctrl-C as a request to end a training, so that it keeps what it has learned."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


class Interrupt:
    """Request to end, made by Ctrl-C; a second one ends the program at once.

    Attributes:
        asked: True once Ctrl-C was pressed.
    """

    def __init__(self) -> None:
        self.asked = False

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Turn Ctrl-C into a request to end, within this context."""
        if threading.current_thread() is not threading.main_thread():
            yield  # signals come to the main thread only
            return
        if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
            yield  # of a process whose parent decides, such as a job's
            return

        def ask(_number: int, _frame: FrameType | None) -> None:
            if self.asked:
                raise KeyboardInterrupt
            self.asked = True

        before = signal.signal(signal.SIGINT, ask)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)
