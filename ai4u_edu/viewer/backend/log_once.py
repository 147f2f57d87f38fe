"""What goes wrong while drawing: said once, and then drawing goes on."""

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType


class Complaints:
    """Writes errors to stderr; an error of the same type from the same line only once."""

    def __init__(self) -> None:
        self._said: set[tuple[type, str, int]] = set()

    @contextmanager
    def caught(self) -> Iterator[None]:
        """Keeps an error in the block from going farther."""
        try:
            yield
        except Exception as error:
            self.write(error)

    def write(self, error: Exception) -> None:
        """Write an error, unless one of its type from its line was written before."""
        kind = (type(error), *_line(error.__traceback__))
        if kind not in self._said:
            self._said.add(kind)
            traceback.print_exception(error)


def _line(trace: TracebackType | None) -> tuple[str, int]:
    frames = traceback.extract_tb(trace)
    return (frames[-1].filename, frames[-1].lineno or 0) if frames else ("", 0)
