"""Read and compare the numbers that students hand in; NaN, infinity and text never pass.

Every comparison with NaN is false, so ``if abs(got - wanted) > 0.01: not right`` takes NaN for a
right answer. The checks of all exercises compare with :func:`is_close` instead.
"""

import math
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from types import CodeType
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.lessons.exercise import NotYet, named
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.locale import gettext as _


@dataclass(frozen=True)
class Slip:
    """Mistake that explains a wrong number."""

    name: str
    """Name of the diagnosis; empty if none explains it."""
    words: str
    """Words to follow the number in a sentence."""


def finite_number(given: Any, *, hint: str = "") -> float:
    """Return a student's number as a float.

    Args:
        given: a number, or an array that holds exactly one.
        hint: the name of the hint if it is none.

    Raises:
        NotYet: it is no number (text, True and None are none), or it is NaN or infinite.
    """
    if given is None:
        raise NotYet(NOTHING_RETURNED, hint="no-return")
    if given is ...:
        text = _("Your function returns `...`: put your answer there.")
        raise NotYet(text, hint="unfinished")
    if isinstance(given, list | tuple | dict | set):
        kind = "table" if isinstance(given, dict) else "list"
        text = _("Expected a number, got {got}.", got=_kind(given))
        raise NotYet(text, hint=f"{kind}-for-number")
    one = given.item() if isinstance(given, np.ndarray) and given.size == 1 else given
    if isinstance(one, bool | np.bool_) or not isinstance(one, Real):
        text = _("Expected a number, got {got}.", got=named(given))
        raise NotYet(text, hint=hint or "not-a-number")
    try:
        found = float(one)
    except OverflowError:
        found = math.inf
    if not math.isfinite(found):
        shown = repr(given)
        if len(shown) >= 60:
            shown = _("a number too large to compute with")
        text = _("Expected a number, got `{shown}`, which has no end.", shown=shown)
        if math.isnan(found):
            text = _(
                "Expected a number, got `{shown}`, which is no number: perhaps 0 was divided by 0.",
                shown=shown,
            )
        raise NotYet(text, hint="not-finite")
    return found


def finite_numbers(given: Any, count: int, *, expected: str = "", hint: str = "") -> list[float]:
    """Return a student's numbers as floats.

    Args:
        given: a list, a tuple or an array.
        count: expected number of values.
        expected: a sentence that says what was expected; default: the count.
        hint: the name of the hint if they are not that.

    Raises:
        NotYet: there are more or fewer, or one of them is not a finite number.
    """
    try:
        found = [*given.ravel()] if isinstance(given, np.ndarray) else [*given]
    except TypeError:
        found = []
    if isinstance(given, str | bytes | dict) or len(found) != count:
        if given is None:
            raise NotYet(NOTHING_RETURNED, hint="no-return")
        single = isinstance(given, int | float) and "number-for-list"
        got = named(given)
        text = _("Expected {count} numbers, got {got}.", count=count, got=got)
        if expected:
            text = _("{expected}, got {got}.", expected=expected, got=got)
        raise NotYet(text, hint=hint or single or "")
    return [finite_number(each, hint=hint) for each in found]


def difference(got: float, slips: Mapping[str, tuple[str, float]], tolerance: float) -> Slip:
    """Return the mistake that explains a wrong number, in words.

    Args:
        got: the student's number.
        slips: by name of the diagnosis: the words for the mistake, and the number that it gives.
        tolerance: largest difference.

    >>> difference(6.0, {"half": ("twice the right number", 6.0)}, 0.01)
    Slip(name='half', words=': that is twice the right number')
    """
    for name, (words, number) in slips.items():
        if is_close(got, number, tolerance):
            return Slip(name, _(": that is {words}", words=words))
    return Slip("", "")


def _kind(given: Any) -> str:
    kind, got = type(given).__name__, named(given)
    if len(given) == 1:
        return _("a {kind} with one number: {got}", kind=kind, got=got)
    return _("a {kind}: {got}", kind=kind, got=got)


def is_close(got: Any, wanted: Any, tolerance: float) -> bool:
    """Return True if numbers differ by at most a tolerance; never for NaN, infinity or text.

    Args:
        got: a number, or an array of them.
        wanted: of the same shape.
        tolerance: the largest difference; of each, in an array.

    >>> is_close(0.1 + 0.2, 0.3, 1e-6)
    True
    >>> is_close(float("nan"), 0.3, 1e-6)
    False
    """
    one, other = _numbers(got), _numbers(wanted)
    if one is None or other is None or one.shape != other.shape:
        return False
    return bool((np.abs(one - other) <= tolerance).all())


def _numbers(given: Any) -> npt.NDArray[np.float64] | None:
    try:
        found = np.asarray(given)
    except ValueError:  # rows of different lengths
        return None
    if found.dtype.kind not in "iuf" or not found.size or not np.isfinite(found).all():
        return None
    return found.astype(np.float64)


def chance_for(exercise_id: str, function: Any) -> np.random.Generator:
    """Return the generator of an exercise's numbers, seeded by the student's code.

    The same code gets the same numbers again. Changed code gets others, so that nobody can collect
    the right results from the messages.

    Args:
        exercise_id: such as ``"02.1"``.
        function: the student's function.
    """
    code = getattr(function, "__code__", None)
    parts = [exercise_id, *_constants_of(code)]
    tables = getattr(function, "__globals__", {})
    known = [tables.get(name) for name in getattr(code, "co_names", ())]
    parts += [repr(each) for each in known if isinstance(each, dict | list | tuple | float | str)]
    return np.random.default_rng(zlib.crc32("|".join(parts).encode()))


def _constants_of(code: Any) -> list[str]:
    """Return what tells a function's code from another's, without addresses."""
    if not isinstance(code, CodeType):
        return []
    found = [code.co_code.hex(), *code.co_names]
    for each in code.co_consts:
        found += _constants_of(each) if isinstance(each, CodeType) else [repr(each)]
    return found
