"""Ctrl-C once: finish the step under way and keep what was learned. Twice: at once."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from stable_baselines3.common.callbacks import BaseCallback


class Interrupt(BaseCallback):  # type: ignore[misc]  # seen without its types
    """Ends a training after the step in which it was asked to."""

    def __init__(self) -> None:
        super().__init__()
        self.asked = False

    def _on_step(self) -> bool:
        return not self.asked

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Ctrl-C asks, for as long as this lasts."""
        if threading.current_thread() is not threading.main_thread():
            yield  # signals come to the main thread only
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
