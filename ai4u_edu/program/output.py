"""The texts that a program prints, bounded in size."""

import builtins
import sys
from typing import Any

from ai4u_edu.program.texts import deferred
from ai4u_edu.program.texts import gettext as _

MAX_DECISION_CHARS = 2_000
"""Characters that one decision may print."""
MAX_TOTAL_CHARS = 200_000
"""Characters that all decisions since the program was loaded may print."""
CUT = deferred("... (cut: a decision may print 2,000 characters)")
END = deferred("... (nothing more is printed until the program is run again)")


class PrintedOutput:
    r"""The program's ``print``, and what it printed in the present decision.

    >>> output = PrintedOutput()
    >>> output.print("left", 0.5)
    >>> output.take()
    'left 0.5\n'
    >>> output.take()
    ''
    """

    def __init__(self) -> None:
        self._pieces: list[str] = []
        self._left = MAX_DECISION_CHARS
        self._total = MAX_TOTAL_CHARS

    def print(
        self,
        *values: Any,
        sep: str | None = " ",
        end: str | None = "\n",
        file: Any = None,
        flush: bool = False,
    ) -> None:
        """Print as Python's function does, up to a number of characters.

        Args:
            values: printed with ``str``.
            sep: between two of them.
            end: after the last one.
            file: a file of the program's own; by default the console.
            flush: for a file of the program's own.
        """
        if file not in (None, sys.stdout, sys.stderr):
            builtins.print(*values, sep=sep, end=end, file=file, flush=flush)
            return
        for place, value in enumerate(values):
            if self._left <= 0:
                return
            if place:
                self._write(" " if sep is None else str(sep))
            self._write(str(value))
        self._write("\n" if end is None else str(end))

    def take(self) -> str:
        """Return the texts since the last call, and begin the next decision."""
        text = "".join(self._pieces)
        self._pieces.clear()
        self._left = min(MAX_DECISION_CHARS, self._total)
        return text

    def _write(self, text: str) -> None:
        if self._left <= 0:
            return
        piece = text[: self._left]
        self._pieces.append(piece)
        self._left -= len(piece)
        self._total -= len(piece)
        if self._total <= 0:
            self._pieces.append(f"\n{_(END)}\n")
        elif len(piece) < len(text):
            self._left = 0
            self._pieces.append(f"\n{_(CUT)}\n")
