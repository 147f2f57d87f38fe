"""Guesses of students and their results, as they are saved."""

import math
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from typing import Any

Value = str | float | list[str | float]
"""Number, short text or list of them, as it is saved."""
MAX_TEXT_CHARS = 200
MAX_ITEMS = 50
MAX_WHOLE = 1e12
"""Limit of the whole numbers that are shown with all digits."""


@dataclass(frozen=True)
class Prediction:
    """Guess of a student, and the result."""

    guess: Value
    actual: Value | None = None
    """Result; None until it was compared."""


def shown(value: Value) -> str:
    """Return a guess or a result in a few characters.

    >>> shown([12548.0, 2.34567, "left"])
    '12548, 2.346, left'
    """
    if isinstance(value, list):
        return ", ".join(shown(each) for each in value)
    if isinstance(value, str):
        return value
    is_whole = value == round(value) and abs(value) < MAX_WHOLE
    return str(round(value)) if is_whole else f"{value:.4g}"


def saved_value(given: Any) -> Value:
    """Return a student's number, text or list as plain JSON values; anything else as text."""
    if hasattr(given, "tolist"):  # arrays and numbers of numpy
        given = given.tolist()
    if isinstance(given, Mapping):
        given = list(given.values())
    if isinstance(given, list | tuple):
        return [_single(each) for each in given[:MAX_ITEMS]]
    return _single(given)


def read_predictions(plain: Any) -> dict[str, Prediction]:
    """Return the predictions in a progress file by id; what can't be read is left out."""
    found = {}
    for name, each in plain.items() if isinstance(plain, dict) else ():
        if isinstance(each, dict) and each.get("guess") is not None:
            actual = each.get("actual")
            found[str(name)] = Prediction(
                saved_value(each["guess"]), None if actual is None else saved_value(actual)
            )
    return found


def _single(given: Any) -> str | float:
    given = given.item() if hasattr(given, "item") else given
    if not isinstance(given, bool) and isinstance(given, Real):
        try:
            number = float(given)
        except OverflowError:
            number = math.inf
        return number if math.isfinite(number) else str(number)
    return (given.strip() if isinstance(given, str) else reprlib.repr(given))[:MAX_TEXT_CHARS]
