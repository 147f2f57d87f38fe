"""Ctrl-C during a training: the first one ends it after a step, the second one at once."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from stable_baselines3.common.callbacks import BaseCallback


class Interrupt(BaseCallback):  # type: ignore[misc]  # seen without its types
    """Callback that ends a training after the step in which Ctrl-C was pressed."""

    def __init__(self) -> None:
        super().__init__()
        self.asked = False

    def _on_step(self) -> bool:
        return not self.asked

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
