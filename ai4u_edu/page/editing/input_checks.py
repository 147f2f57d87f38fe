"""Limits of what an edit from a page may contain."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import BaseModel

from ai4u_edu.base.errors import MAX_SHOWN_CHARS, shown
from ai4u_edu.base.parameters import Problem
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.plain import BlockPath

MAX_TEXT_CHARS = 10_000
"""Length of a text in an edit."""
MAX_NAME_CHARS = 500
"""Length of a name in an edit; a file's path may be one."""
MAX_DEPTH = 50
"""Nesting depth of lists and mappings in an edit."""
MAX_VALUES = 100_000
"""Number of values in an edit."""


def check_plain(values: Any) -> None:
    """Raise a ChangeError for values that a scene file can't hold, or too many of them."""
    problem = next(_not_plain(values), None)
    if problem is not None:
        raise ChangeError([problem])


def check_number(value: Any, what: str, largest: float) -> None:
    """Raise a ChangeError unless a value is a finite number within bounds.

    Args:
        value: a value in an edit.
        what: its name, for the message.
        largest: the bound of its absolute value.
    """
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if is_number and isinstance(value, float) and not math.isfinite(value):
        raise ChangeError([Problem((what,), f"expected finite numbers, got {value}")])
    if not is_number or abs(value) > largest:
        text = f"expected a number from {-largest:g} to {largest:g}, got {shown(value)}"
        raise ChangeError([Problem((what,), text)])


def check_name(value: Any, what: str) -> None:
    """Raise a ChangeError unless a value is a text short enough for a name."""
    if not isinstance(value, str) or len(value) > MAX_NAME_CHARS:
        text = f"expected {what} of at most {MAX_NAME_CHARS} characters, got {shown(value)}"
        raise ChangeError([Problem((), text)])


def _not_plain(values: Any) -> Iterator[Problem]:
    """Yield values that are no plain data; iterative, since nesting could exceed the stack."""
    waiting: list[tuple[BlockPath, Any]] = [((), values)]
    count = 0
    while waiting:
        path, value = waiting.pop()
        count += 1
        if len(path) > MAX_DEPTH or count > MAX_VALUES:
            yield Problem(path[:1], "expected less: it is nested too deep, or has too many values")
            return
        if isinstance(value, str):
            if len(value) > MAX_TEXT_CHARS:
                yield Problem(path, f"expected at most {MAX_TEXT_CHARS} characters")
            elif not value.isprintable() and any("\ud800" <= char <= "\udfff" for char in value):
                yield Problem(path, f"expected text, got {shown(value)}")
        elif isinstance(value, int) and value.bit_length() > 64:
            yield Problem(path, "expected a number of at most 64 bits, got a larger one")
        elif isinstance(value, Mapping):
            for key, each in value.items():
                if not isinstance(key, str | int):
                    yield Problem(path, f"expected names as keys, got {shown(key)}")
                waiting.append(((*path, str(key)[:MAX_SHOWN_CHARS]), each))
        elif isinstance(value, list | tuple):
            waiting += [((*path, index), each) for index, each in enumerate(value)]
        elif not (value is None or isinstance(value, bool | int | float | BaseModel)):
            text = f"expected plain data (numbers, text, lists, mappings), got {shown(value)}"
            yield Problem(path, text)
