"""Sentences for students' exceptions, with the line of their code."""

import linecache
import re
import sys
import sysconfig
from dataclasses import dataclass
from pathlib import Path

from ai4u_edu.agent.block_frames import line_at
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.locale import gettext as _

_OURS = str(Path(__file__).resolve().parent.parent)
_LIBRARIES = tuple({*sysconfig.get_paths().values(), sys.prefix, sys.base_prefix})

NOTHING_RETURNED = _("Your function returned nothing (None). Is `return` missing?")
_PARAMETERS = re.compile(
    r"(?P<name>[\w.<>]+)\(\) (?:takes (?:from )?\d+(?: to \d+)? positional arguments?"
    r" but \d+ (?:was|were) given|missing \d+ required positional argument|got an unexpected)"
)
_NONE_IN_PLACE_OF_A_NUMBER = re.compile(r"float\(\) argument must be .*'NoneType'")
_NO_NUMBER = re.compile(r"float\(\) argument must be|could not convert string to float")
_ACTION = re.compile(r"expected an action|has no actuator|ActionError")


@dataclass(frozen=True)
class Mistake:
    """A student's mistake, as a sentence."""

    text: str
    name: str = "error"
    """Name of the diagnosis."""
    function: str = ""
    """Function whose parameters are wrong, such as ``Patrol.get_action``; empty for others."""


def mistake_in(error: BaseException) -> Mistake | None:
    r"""Return the mistake behind an exception; None if no student's line and no block caused it.

    >>> try:
    ...     exec(compile("def f(x):\n    return 1 / x\nf(0)", "<cell>", "exec"))
    ... except ZeroDivisionError as error:
    ...     print(mistake_in(error).text)
    Your code stopped with ZeroDivisionError: division by zero (line 2 of its cell).
    """
    line = line_of(error)
    if isinstance(error, SystemExit):
        words = _("Your code called `exit`, which ends the program.")
        if line:
            words = _("Your code called `exit`, which ends the program ({line}).", line=line)
        return Mistake(words, "exit")
    if line:  # it says more than the notes about which block was asked
        name = "called" if text_of(error).startswith("connect: ") else "error"
        words = _(
            "Your code stopped with {kind}: {error} ({line}).",
            kind=type(error).__name__,
            error=text_of(error) if isinstance(error, AI4UError) else str(error),
            line=line,
        )
        return Mistake(words, name)
    text = str(text_of(error))  # in English, whatever the notebook speaks
    parameters = _PARAMETERS.search(text)
    if parameters and isinstance(error, TypeError):
        return Mistake(text, "parameters", parameters["name"].rpartition("<locals>.")[2])
    if _NONE_IN_PLACE_OF_A_NUMBER.search(text) or (
        isinstance(error, AI4UError) and re.search(r"got None\b", text)
    ):
        return Mistake(NOTHING_RETURNED, "no-return")
    notes = "".join(f" ({note})" for note in getattr(error, "__notes__", ()))
    if isinstance(error, AI4UError):
        name = "action" if _ACTION.search(text) else "set-up"
        words = _(
            "It could not be put together or run: {text}{notes}", text=text_of(error), notes=notes
        )
        return Mistake(words, name)
    if _NO_NUMBER.search(text):
        words = _("Expected a number from your code: {text}{notes}.", text=text, notes=notes)
        return Mistake(words, "not-a-number")
    return None


def line_of(error: BaseException) -> str:
    """Return the student's innermost line in a traceback, in words; empty if there is none."""
    trace, words = error.__traceback__, ""
    while trace is not None:
        code = trace.tb_frame.f_code
        if is_students(code.co_filename):
            words = line_words(code.co_filename, line_at(code, trace.tb_lasti))
        trace = trace.tb_next
    return words


def line_words(file: str, number: int) -> str:
    """Return a line of a student's cell, in words."""
    text = linecache.getline(file, number).strip()
    if text:
        return _("line {number} of its cell: {text}", number=number, text=text)
    return _("line {number} of its cell", number=number)


def is_students(file: str) -> bool:
    """Return True if a source file is a notebook's cell or a file of the student's."""
    if file.startswith("<"):
        return not file.startswith(("<frozen", "<doctest", "<__array_function__", "<string>"))
    if "ipykernel_" in file:  # what was typed into a cell
        return True
    # a library's part that was compiled names its source without a folder: "numpy/random/x.pyx"
    return file.endswith(".py") and not file.startswith((_OURS, *_LIBRARIES))
