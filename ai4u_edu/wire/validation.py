"""Checks that what came over a wire is what a message declares, field by field.

A message is a NamedTuple. Its annotations say what may stand in each field, and
:func:`reader` makes of them, once, a function that lets nothing else through.
"""

import math
import sys
from collections.abc import Callable, Mapping
from types import NoneType, UnionType
from typing import (
    Annotated,
    Any,
    Literal,
    NamedTuple,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from ai4u_edu.base import errors
from ai4u_edu.base.errors import AI4UError

M = TypeVar("M")
Check = Callable[[Any], Any]
"""Gives back the value as it belongs into the message, or raises a :class:`WireError`."""

LARGEST_INT = 2**53
"""Every language has the whole numbers below this one."""
LONGEST_TEXT = 400
"""Characters of a text that has no limit of its own."""
MOST = 1024
"""Entries of a list or a mapping."""


LARGEST_FLOAT = sys.float_info.max


class Bounds(NamedTuple):
    """The lowest and the highest number of a field."""

    low: float
    high: float


FINITE = Bounds(-LARGEST_FLOAT, LARGEST_FLOAT)
ENDLESS = Bounds(-math.inf, math.inf)
"""Any number, and the infinities."""
UNCHECKED: Literal["any number"] = "any number"
"""Any number, the infinities, and what is no number (NaN)."""


class WireError(AI4UError):
    """What came over a wire is no message; the text says what was expected."""


def reader(message: type[M]) -> Callable[[tuple[Any, ...]], M]:
    """A function that makes a message of its fields' values, or raises a WireError.

    Known are int (0 and more, below 2**53, or with ``Annotated[..., n]`` up to n), float (finite,
    or with :class:`Bounds`; whole numbers too), bool, str and bytes (with ``Annotated[..., n]`` of
    up to n characters or bytes), ``Literal``, ``| None``,
    ``tuple[x, ...]``, ``Mapping[str, x]``, and other messages. Fields that have a default may be
    left out at the end.

    >>> from typing import NamedTuple
    >>> class Step(NamedTuple):
    ...     number: int
    ...     rewards: tuple[float, ...]
    >>> reader(Step)((7, (1, 2.5)))
    Step(number=7, rewards=(1.0, 2.5))
    >>> reader(Step)((-7, ()))
    Traceback (most recent call last):
    ...
    ai4u_edu.wire.validation.WireError: number: expected a whole number from 0 on, got -7
    """
    hints = get_type_hints(message, include_extras=True)
    checks = {name: _check(hints[name]) for name in hints}
    every = tuple(checks.values())
    most = len(every)
    least = most - len(getattr(message, "_field_defaults", ()))

    def read(values: tuple[Any, ...]) -> M:
        if not least <= len(values) <= most:
            count = f"{most}" if least == most else f"{least} to {most}"
            raise WireError(f"expected {count} fields ({', '.join(checks)}), got {len(values)}")
        try:
            return message(*[check(value) for check, value in zip(every, values, strict=False)])
        except WireError:
            _name_the_wrong_one(checks, values)
            raise

    return read


def shown(value: object) -> str:
    """A value in a message of an error: its beginning."""
    return errors.shown(value, 40)


def _name_the_wrong_one(checks: Mapping[str, Check], values: tuple[Any, ...]) -> None:
    for (name, check), value in zip(checks.items(), values, strict=False):
        try:
            check(value)
        except WireError as error:
            raise WireError(f"{name}: {error}") from None


def _check(kind: Any, size: Any = None) -> Check:
    origin, parts = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return _check(parts[0], parts[1])
    if origin in (UnionType, Union):
        (inner,) = (_check(part) for part in parts if part is not NoneType)
        return lambda value: None if value is None else inner(value)
    if origin is Literal:
        return _one_of(parts)
    if origin is tuple:
        return _sequence(_check(parts[0]))
    if origin is Mapping:
        return _mapping(_check(parts[1]))
    if kind is int:
        return _whole(LARGEST_INT - 1 if size is None else size)
    if kind is float:
        return _float if size is UNCHECKED else _number(size or FINITE)
    if kind is bool:
        return _bool
    if kind in (str, bytes):
        return _text(kind, size or LONGEST_TEXT)
    read = reader(kind)
    return lambda value: read(_sequence(lambda part: part)(value))


def _whole(most: int) -> Check:
    def check(value: Any) -> int:
        if type(value) is int and 0 <= value <= most:
            return value
        upwards = f"to {most}" if type(value) is int and value > most else "on"
        raise WireError(f"expected a whole number from 0 {upwards}, got {shown(value)}")

    return check


def _number(bounds: Bounds) -> Check:
    low, high = bounds
    if bounds == FINITE:
        what = "a finite number"
    else:
        what = "a number" if bounds == ENDLESS else f"a number from {low:g} to {high:g}"

    def check(value: Any) -> float:
        number = _float(value)
        if low <= number <= high:  # which NaN never is
            return number
        raise WireError(f"expected {what}, got {shown(value)}")

    return check


def _float(value: Any) -> float:
    if type(value) is float:
        return value
    if type(value) is int:
        return float(value)
    raise WireError(f"expected a number, got {shown(value)}")


def _bool(value: Any) -> bool:
    if type(value) is bool:
        return value
    raise WireError(f"expected true or false, got {shown(value)}")


def _text(kind: type[str | bytes], size: int) -> Check:
    what = f"text of up to {size} characters" if kind is str else f"up to {size} bytes"

    def check(value: Any) -> Any:
        if type(value) is kind and len(value) <= size:
            return value
        raise WireError(f"expected {what}, got {shown(value)}")

    return check


def _one_of(known: tuple[Any, ...]) -> Check:
    def check(value: Any) -> Any:
        if type(value) is str and value in known:
            return value
        raise WireError(f"expected one of {', '.join(map(repr, known))}, got {shown(value)}")

    return check


def _sequence(inner: Check) -> Check:
    def check(value: Any) -> tuple[Any, ...]:
        if type(value) is tuple and len(value) <= MOST:
            return tuple([inner(part) for part in value])
        raise WireError(f"expected a list of up to {MOST}, got {shown(value)}")

    return check


def _mapping(inner: Check) -> Check:
    name = _text(str, LONGEST_TEXT)

    def check(value: Any) -> dict[str, Any]:
        if type(value) is dict and len(value) <= MOST:
            return {name(key): inner(part) for key, part in value.items()}
        raise WireError(f"expected names and values, up to {MOST}, got {shown(value)}")

    return check
