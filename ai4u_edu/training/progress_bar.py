"""How far something is: a bar in a terminal, or in a notebook's cell."""

import time
from collections import deque
from collections.abc import Iterable, Iterator
from html import escape
from typing import Any, Protocol, TypeVar

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

OFTEN = 0.2
"""Seconds between two changes of what is shown."""
NOTES = 6
"""Lines that stay above a notebook's bar."""

T = TypeVar("T")


class Meter(Protocol):
    """Shows how far something is."""

    def show(self, done: int, told: str = "") -> None:
        """So much is done; and what else there is to tell of it."""

    def note(self, line: str) -> None:
        """Something that stays."""

    def close(self) -> None:
        """Lets go of the place where it is shown."""


def meter(
    total: int, unit: str, *, console: Console | None = None, quiet: bool = False, keep: bool = True
) -> Meter:
    """A meter for where this runs.

    Args:
        total: when all is done.
        unit: what is counted, such as ``steps``.
        console: a terminal to show it in.
        quiet: whether to show nothing.
        keep: whether it stays to be seen when all is done.
    """
    where = console or Console(stderr=True)
    if quiet or not (keep or where.is_terminal or where.is_jupyter):
        return Silence()
    # Rich shows nothing in a notebook without ipywidgets
    return NotebookMeter(total, unit, keep) if where.is_jupyter else Line(total, unit, where, keep)


def counted(things: Iterable[T], name: str, *, quiet: bool = False) -> Iterator[T]:
    """The same things one by one, with a meter that tells how many have come."""
    all_of_them = list(things)
    shown = meter(len(all_of_them), f"episodes, {name}", quiet=quiet, keep=False)
    before = 0.0
    try:
        for index, each in enumerate(all_of_them):
            if time.perf_counter() - before > OFTEN:
                before = time.perf_counter()
                shown.show(index)
            yield each
    finally:
        shown.close()


class Silence:
    """Shows nothing."""

    def show(self, done: int, told: str = "") -> None:
        """Not here."""

    def note(self, line: str) -> None:
        """Not here."""

    def close(self) -> None:
        """Nothing was held."""


class Line:
    """A bar in a terminal."""

    def __init__(self, total: int, unit: str, console: Console, keep: bool) -> None:
        self._progress = Progress(
            BarColumn(bar_width=24),
            TextColumn(f"{{task.completed}}/{{task.total}} {unit}"),
            TextColumn("{task.fields[told]}"),
            TimeElapsedColumn(),
            TextColumn("left"),
            TimeRemainingColumn(),
            console=console,
            auto_refresh=False,
            transient=not keep,
        )
        self._task = self._progress.add_task("", total=total, told="")
        self._progress.start()

    def show(self, done: int, told: str = "") -> None:
        """Draws it anew."""
        self._progress.update(self._task, completed=done, told=told, refresh=True)

    def note(self, line: str) -> None:
        """A line above the bar."""
        self._progress.console.print(line, style="dim", highlight=False)

    def close(self) -> None:
        """Gives the terminal back."""
        self._progress.stop()


class NotebookMeter:
    """A bar in a notebook's cell: one output that changes."""

    def __init__(self, total: int, unit: str, keep: bool) -> None:
        self._total, self._unit, self._keep = total, unit, keep
        self._notes: deque[str] = deque(maxlen=NOTES)
        self._began = time.perf_counter()
        self._done, self._told = 0, ""
        self._handle: Any = None

    def show(self, done: int, told: str = "") -> None:
        """Changes the output."""
        self._done, self._told = done, told
        self._refresh()

    def note(self, line: str) -> None:
        """A line above the bar; the last few stay."""
        self._notes.append(line)
        self._refresh()

    def close(self) -> None:
        """Leaves it as it is, or takes it away."""
        if not self._keep and self._handle is not None:
            self._handle.update(Cell("", ""))

    def text(self) -> str:
        """The last line."""
        gone = time.perf_counter() - self._began
        left = gone * (self._total - self._done) / self._done if self._done else None
        told = f"{self._told}  " if self._told else ""
        remaining = "-" if left is None else _clock(left)
        return f"{self._done}/{self._total} {self._unit}  {told}{_clock(gone)}  left {remaining}"

    def _refresh(self) -> None:
        from IPython import display as notebook

        display: Any = notebook.display
        text = self.text()
        above = "".join(f"<div style='opacity:.65'>{escape(line)}</div>" for line in self._notes)
        bar = (
            f"<progress max='{self._total}' value='{self._done}' aria-label='{escape(self._unit)}'>"
            "</progress>"
        )
        cell = Cell(
            f"<div style='font-variant-numeric:tabular-nums'>{above}{bar} {escape(text)}</div>",
            "\n".join((*self._notes, text)),
        )
        if self._handle is None:
            self._handle = display(cell, display_id=True)
        else:
            self._handle.update(cell)


class Cell:
    """What a notebook shows: HTML where it can, text where it can't."""

    def __init__(self, html: str, text: str) -> None:
        self._html, self._text = html, text

    def _repr_html_(self) -> str:
        return self._html

    def __repr__(self) -> str:
        return self._text


def _clock(seconds: float) -> str:
    """Minutes and seconds.

    >>> _clock(75.2)
    '1:15'
    """
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}:{rest:02}"
