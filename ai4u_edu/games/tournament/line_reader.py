"""Lines of a pipe, with a time limit."""

import queue
import threading
import time
from contextlib import suppress
from typing import IO

MAX_WAITING_LINES = 4
"""Lines that are read before somebody asks for them; then the writer has to wait."""
END_TIMEOUT_S = 1.0
"""Time in which the thread notices that the writer has ended."""
JOIN_TIMEOUT_S = 0.01


class LineReader:
    """Reads a pipe in a thread of its own: Windows can't wait for a pipe with a time limit.

    One other thread calls it.

    Args:
        pipe: what is read; it is closed with the reader.
        max_bytes: a longer line is cut off there.
    """

    def __init__(self, pipe: IO[bytes], max_bytes: int) -> None:
        self._pipe, self._max_bytes = pipe, max_bytes
        self._lines: queue.Queue[bytes] = queue.Queue(MAX_WAITING_LINES)
        self._is_closed = False
        self._thread = threading.Thread(target=self._read, name="line reader", daemon=True)
        self._thread.start()

    def line(self, timeout_s: float) -> bytes | None:
        """Return the next line; None if none comes in time.

        At the end of the pipe the line has no line break, and is usually empty; nor has a line that
        was cut off.
        """
        try:
            return self._lines.get(timeout=timeout_s)
        except queue.Empty:
            return None

    def close(self) -> None:
        """End the thread and close the pipe, once the writer has ended.

        If somebody else still holds the pipe open, both stay.
        """
        self._is_closed = True
        until = time.monotonic() + END_TIMEOUT_S
        while self._thread.is_alive() and time.monotonic() < until:
            with suppress(queue.Empty):  # it may wait for a place in the queue
                self._lines.get_nowait()
            self._thread.join(JOIN_TIMEOUT_S)
        if not self._thread.is_alive():
            self._pipe.close()

    def _read(self) -> None:
        line = b"\n"
        while line.endswith(b"\n") and not self._is_closed:
            try:
                line = self._pipe.readline(self._max_bytes + 1)
            except (OSError, ValueError):
                line = b""
            self._lines.put(line)
