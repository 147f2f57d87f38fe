"""Sentences for students' exceptions, with the line of their code."""

import linecache
import sys
import sysconfig
import traceback
from pathlib import Path

from ai4u_edu.base.errors import AI4UError

_OURS = str(Path(__file__).resolve().parent.parent)
_LIBRARIES = tuple({*sysconfig.get_paths().values(), sys.prefix, sys.base_prefix})


def told(error: BaseException) -> str:
    r"""Return a sentence for an exception; empty if no student's line and no block caused it.

    >>> try:
    ...     exec(compile("def f(x):\n    return 1 / x\nf(0)", "<cell>", "exec"))
    ... except ZeroDivisionError as error:
    ...     print(told(error))
    Your code stopped with ZeroDivisionError: division by zero (line 2 of its cell).
    """
    line = _line(error)
    if line:  # it says more than the notes about which block was asked
        return f"Your code stopped with {type(error).__name__}: {error} ({line})."
    notes = "".join(f" ({note})" for note in getattr(error, "__notes__", ()))
    if isinstance(error, AI4UError):
        return f"It could not be put together or run: {error}{notes}"
    return ""


def _line(error: BaseException) -> str:
    frames = [
        each for each in traceback.extract_tb(error.__traceback__) if _is_theirs(each.filename)
    ]
    if not frames:
        return ""
    last = frames[-1]
    number = last.lineno or 0
    text = linecache.getline(last.filename, number).strip()
    return f"line {number} of its cell" + (f": {text}" if text else "")


def _is_theirs(file: str) -> bool:
    if file.startswith("<"):
        return not file.startswith(("<frozen", "<doctest", "<__array_function__"))
    if "ipykernel_" in file:  # what was typed into a cell
        return True
    return not file.startswith((_OURS, *_LIBRARIES))
