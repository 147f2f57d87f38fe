"""Readings of sensors as plain Python numbers, with numpy's arithmetic where beginners use it."""

import math
import operator
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NoReturn

from ai4u_edu.program.texts import gettext as _
from ai4u_edu.program.words import suggest

MAX_SHOWN_NUMBERS = 100
"""Numbers of a reading that its repr shows."""


def plain_sum(values: Iterable[Any], /, start: Any = 0) -> Any:
    """Add values from left to right.

    From Python 3.12 on, the built-in function compensates for rounding; this one gives the same
    result in each version.

    >>> plain_sum([0.1, 0.2, 0.3])
    0.6000000000000001
    """
    for value in values:
        start = start + value
    return start


class Reading(Sequence[Any]):
    """An immutable list of numbers, or of lists of them, as one sensor reads it.

    Operators work on each number, as with numpy's arrays.

    Args:
        values: numbers, bools, or nested sequences of equal lengths.

    >>> eyes = Reading([0.5, 1.0, 0.0])
    >>> eyes.max(), eyes.argmin(), 2 * eyes, eyes > 0.4
    (1.0, 2, Reading([1.0, 2.0, 0.0]), Reading([True, True, False]))
    >>> Reading([[1, 2], [3, 4]]).shape
    (2, 2)
    """

    __slots__ = ("_parts",)
    __hash__ = None  # type: ignore[assignment]  # a comparison gives a reading, as with arrays

    def __init__(self, values: Iterable[Any]) -> None:
        parts = tuple(values)
        if parts and isinstance(parts[0], list | tuple):
            parts = tuple(map(Reading, parts))
        self._parts: tuple[Any, ...] = parts

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of entries along each axis."""
        first = self._parts[0] if self._parts else None
        return (len(self._parts), *(first.shape if isinstance(first, Reading) else ()))

    @property
    def ndim(self) -> int:
        """Number of axes."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """Count of all numbers."""
        return math.prod(self.shape)

    def flatten(self) -> "Reading":
        """Return all numbers in one list."""
        return Reading(self._flat())

    def tolist(self) -> list[Any]:
        """Return a list of Python numbers, nested as the reading is."""
        return [each.tolist() if isinstance(each, Reading) else each for each in self._parts]

    def min(self) -> Any:
        """Return the lowest number."""
        return min(self._flat())

    def max(self) -> Any:
        """Return the highest number."""
        return max(self._flat())

    def sum(self) -> Any:
        """Return the sum, added from the first to the last number."""
        return plain_sum(self._flat())

    def mean(self) -> float:
        """Return the sum divided by the count."""
        return float(self.sum() / self.size)

    def argmin(self) -> int:
        """Return the position of the lowest number; the first one of several."""
        flat = list(self._flat())
        return flat.index(min(flat))

    def argmax(self) -> int:
        """Return the position of the highest number; the first one of several."""
        flat = list(self._flat())
        return flat.index(max(flat))

    def any(self) -> bool:
        """Return True if a number is not zero."""
        return any(self._flat())

    def all(self) -> bool:
        """Return True if no number is zero."""
        return all(self._flat())

    def __len__(self) -> int:
        return len(self._parts)

    def __iter__(self) -> Iterator[Any]:
        return iter(self._parts)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, tuple):  # picture[2, 3]
            found: Any = self
            for place, each in enumerate(index):
                if isinstance(each, slice) and place < len(index) - 1:
                    rest = index[place + 1 :]
                    return Reading([row[rest] for row in found[each]])
                found = found[each]
            return found
        try:
            found = self._parts[index]
        except IndexError:
            raise IndexError(
                _(
                    "the reading has {count} numbers, from [0] to [{last}]; there is no [{index}]",
                    count=len(self),
                    last=len(self) - 1,
                    index=str(index),
                )
            ) from None
        return Reading(found) if isinstance(index, slice) else found

    def __contains__(self, value: object) -> bool:
        return any(each == value for each in self._flat())

    def __bool__(self) -> bool:
        if len(self) == 1:
            return bool(self._parts[0])
        raise ValueError(
            _(
                "a reading of {count} numbers is neither true nor false: ask for one of them, as "
                "in "
                "reading[0] > 0.5, or for reading.any() or reading.max()",
                count=len(self),
            )
        )

    def __repr__(self) -> str:
        if self.size <= MAX_SHOWN_NUMBERS:
            return f"Reading({self.tolist()!r})"
        return f"<Reading of {' x '.join(map(str, self.shape))} numbers>"

    def _flat(self) -> Iterator[Any]:
        for each in self._parts:
            if isinstance(each, Reading):
                yield from each._flat()
            else:
                yield each

    def _map(self, function: Callable[[Any], Any]) -> "Reading":
        return Reading(
            [
                each._map(function) if isinstance(each, Reading) else function(each)
                for each in self._parts
            ]
        )

    def _with(self, other: Any, function: Callable[[Any, Any], Any]) -> Any:
        if isinstance(other, bool | int | float):
            return self._map(lambda value: function(value, other))
        if not isinstance(other, Reading | list | tuple):
            return NotImplemented
        if len(other) != len(self):
            raise ValueError(
                _(
                    "expected as many numbers on both sides, got {count} and {other}",
                    count=len(self),
                    other=len(other),
                )
            )
        return Reading([function(mine, theirs) for mine, theirs in zip(self, other, strict=True)])

    def __eq__(self, other: object) -> Any:
        return self._with(other, operator.eq)

    def __ne__(self, other: object) -> Any:
        return self._with(other, operator.ne)

    def __lt__(self, other: Any) -> Any:
        return self._with(other, operator.lt)

    def __le__(self, other: Any) -> Any:
        return self._with(other, operator.le)

    def __gt__(self, other: Any) -> Any:
        return self._with(other, operator.gt)

    def __ge__(self, other: Any) -> Any:
        return self._with(other, operator.ge)

    def __add__(self, other: Any) -> Any:
        return self._with(other, operator.add)

    def __radd__(self, other: Any) -> Any:
        return self._with(other, lambda mine, theirs: theirs + mine)

    def __sub__(self, other: Any) -> Any:
        return self._with(other, operator.sub)

    def __rsub__(self, other: Any) -> Any:
        return self._with(other, lambda mine, theirs: theirs - mine)

    def __mul__(self, other: Any) -> Any:
        return self._with(other, operator.mul)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        return self._with(other, operator.truediv)

    def __rtruediv__(self, other: Any) -> Any:
        return self._with(other, lambda mine, theirs: theirs / mine)

    def __neg__(self) -> "Reading":
        return self._map(operator.neg)

    def __abs__(self) -> "Reading":
        return self._map(abs)

    def __setitem__(self, index: object, value: object) -> NoReturn:
        raise TypeError(_("a reading can't be changed; list(reading) makes a list that can"))


class MissingReadingError(KeyError):
    """No reading has this key; the message suggests the nearest known one."""

    def __str__(self) -> str:
        return str(self.args[0])  # KeyError's own method would quote the message


class Readings(Mapping[str, Any]):
    """The readings of one decision by perception key, as plain Python values.

    Each is converted when it is first asked for.

    Args:
        percept: numbers, bools, texts, (nested) lists of numbers or numpy arrays, by key.

    >>> Readings({"line": [0.0, 1.0]})["lien"]
    Traceback (most recent call last):
    ai4u_edu.program.reading.MissingReadingError: there is no sensor called 'lien'; did you mean \
'line'?
    """

    __slots__ = ("_converted", "_percept")

    def __init__(self, percept: Mapping[str, Any]) -> None:
        self._percept = percept
        self._converted: dict[str, Any] = {}

    def __getitem__(self, key: str) -> Any:
        if key not in self._converted:
            if key not in self._percept:
                hint = suggest(str(key), self._percept)
                raise MissingReadingError(
                    _("there is no sensor called {key}; {hint}", key=repr(key), hint=hint)
                )
            self._converted[key] = _plain(self._percept[key])
        return self._converted[key]

    def __contains__(self, key: object) -> bool:
        return key in self._percept

    def __iter__(self) -> Iterator[str]:
        return iter(self._percept)

    def __len__(self) -> int:
        return len(self._percept)

    def __repr__(self) -> str:
        return repr(dict(self))


def readings_of(percept: Mapping[str, Any]) -> Readings:
    """Return the readings of a percept as plain Python values.

    Args:
        percept: numbers, bools, texts, (nested) lists of numbers or numpy arrays, by key.

    >>> readings_of({"line": [0.0, 1.0], "done": False, "names": ["a", "b"]})
    {'line': Reading([0.0, 1.0]), 'done': False, 'names': ('a', 'b')}
    """
    return Readings(percept)


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):  # an array, or one of its numbers
        value = value.tolist()
    if not isinstance(value, list | tuple):
        return value
    # several texts are a tuple, as in a percept; so is nothing, which may be no texts
    are_numbers = bool(value) and not isinstance(value[0], str)
    return Reading(value) if are_numbers else tuple(value)
