"""Progress bars in a terminal or a notebook's cell, by tqdm."""

import sys
from collections.abc import Iterable, Iterator
from typing import Any, TextIO, TypeVar

from tqdm.auto import tqdm

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

REFRESH_S = 0.2
"""Time between two updates of a bar."""
FORMAT = _("{bar:24} {n_fmt}/{total_fmt} {unit}{postfix}  {elapsed} left {remaining}")

T = TypeVar("T")


class ProgressBar:
    """Bar with a count, a text beside it, and lines above it.

    Args:
        total: the count at the end.
        unit: the things that are counted, such as ``steps``.
        done: the count at the beginning, for what was done in another run.
        quiet: True shows nothing.
        keep: False removes the bar at the end, and shows none where that can't be done.
        file: the stream to write to, stderr by default.
    """

    def __init__(
        self,
        total: int,
        unit: str,
        *,
        done: int = 0,
        quiet: bool = False,
        keep: bool = True,
        file: TextIO | None = None,
    ) -> None:
        can_remove = (file or sys.stderr).isatty() or is_kernel()
        is_shown = not quiet and (keep or can_remove)
        self._file = file
        self._bar: Any = None
        if is_shown:  # tqdm makes a lock in the system, which a process that is killed leaves
            self._bar = tqdm(
                total=total,
                initial=done,  # so that the time that is left follows from what this run does
                unit=translate(unit),
                file=file,
                leave=keep,
                mininterval=REFRESH_S,
                bar_format=translate(FORMAT),
            )

    def show(self, count: int, text: str = "") -> None:
        """Set the count, and the text beside the bar."""
        if self._bar is not None:
            self._bar.set_postfix_str(translate(text), refresh=False)
            self._bar.update(count - self._bar.n)

    def add(self, count: int) -> None:
        """Add to the count."""
        if self._bar is not None:
            self._bar.update(count)

    def note(self, line: str) -> None:
        """Print a line above the bar, which stays."""
        if self._bar is not None:
            # a notebook marks what comes from stderr as an error
            usual = sys.stdout if is_kernel() else sys.stderr
            self._bar.write(translate(line), file=self._file or usual)

    def close(self) -> None:
        """Draw the bar for the last time, or remove it."""
        if self._bar is not None:
            self._bar.close()


def counted(things: Iterable[T], name: str, *, quiet: bool = False) -> Iterator[T]:
    """Yield the things one by one while a bar shows how many have come."""
    items = list(things)
    bar = ProgressBar(len(items), _("episodes, {name}", name=name), quiet=quiet, keep=False)
    try:
        for index, item in enumerate(items):
            bar.show(index)
            yield item
    finally:
        bar.close()


def is_kernel() -> bool:
    """Return True if this process is a notebook's kernel; others may have loaded its module."""
    module = sys.modules.get("ipykernel.kernelapp")
    return module is not None and bool(module.IPKernelApp.initialized())
