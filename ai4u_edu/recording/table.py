"""Compact tables of rows of named numbers, such as reward terms, and their columns as bytes.

Numbers in a column are little-endian and shuffled: the first bytes of all numbers come before all
second bytes, and so on, which compresses better.
"""

from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.errors import RecordingError

Form = tuple[tuple[str, int], ...]
"""Names in a row, in order, with the count of numbers of each."""

MAX_FORMS = 2**16


class Table:
    """Rows of named numbers.

    Args:
        forms: all forms of rows.
        form: (n,) index of each row's form.
        numbers: all numbers, row after row.

    >>> table = Table.of([{"move": (1.0, 0.5), "catch": (1.0,)}, {}, {"move": (0.0, 0.0)}])
    >>> table.forms
    ((('move', 2), ('catch', 1)), (), (('move', 2),))
    >>> table[0], table[1]
    ({'move': (1.0, 0.5), 'catch': (1.0,)}, {})
    """

    def __init__(
        self,
        forms: Sequence[Form],
        form: npt.NDArray[np.uint16],
        numbers: npt.NDArray[np.float64],
    ) -> None:
        self.forms = tuple(forms)
        self.form = form
        self.numbers = numbers
        widths = _widths(self.forms)
        self._begin = np.concatenate(([0], np.cumsum(widths[form]))) if len(form) else np.zeros(1)

    @classmethod
    def of(cls, rows: Iterable[Mapping[str, Sequence[float]]]) -> "Table":
        """Make a table of rows."""
        forms: dict[Form, int] = {}
        form: list[int] = []
        numbers: list[float] = []
        for row in rows:
            kind = tuple((name, len(each)) for name, each in row.items())
            form.append(forms.setdefault(kind, len(forms)))
            for each in row.values():
                numbers += each
        return cls(tuple(forms), np.array(form, np.uint16), np.array(numbers, np.float64))

    @classmethod
    def unpack(
        cls, forms: Sequence[Sequence[tuple[str, int]]], form: bytes, numbers: bytes, what: str
    ) -> "Table":
        """Return a table from its columns.

        Args:
            forms: the names in each form, and the width of each.
            form: packed column of each row's form.
            numbers: packed column of all numbers.
            what: prefix of the columns' names, for messages.

        Raises:
            RecordingError: the columns do not fit together.
        """
        for each in forms:
            names = [name for name, _width in each]
            if len(set(names)) < len(names) or not all(0 <= width <= 1024 for _name, width in each):
                raise RecordingError(
                    _(
                        "{what}_forms: expected names and how many numbers, got {each}",
                        what=what,
                        each=str(each),
                    )
                )
        rows = unpack_column(form, np.uint16, f"{what}_form")
        amounts = unpack_column(numbers, np.float64, f"{what}_numbers")
        check_finite(amounts, f"{what}_numbers")
        if len(rows) and int(rows.max()) >= len(forms):
            raise RecordingError(
                _(
                    "{what}_form: expected numbers below {count}, got {value}",
                    what=what,
                    count=len(forms),
                    value=rows.max(),
                )
            )
        expected = int(_widths(forms)[rows].sum()) if len(rows) else 0
        if len(amounts) != expected:
            raise RecordingError(
                _(
                    "{what}_numbers: expected {expected} numbers, got {count}",
                    what=what,
                    expected=expected,
                    count=len(amounts),
                )
            )
        return cls([tuple(each) for each in forms], rows, amounts)

    def __len__(self) -> int:
        return len(self.form)

    def __getitem__(self, index: int) -> dict[str, tuple[float, ...]]:
        form = self.forms[self.form[index]]
        start = int(self._begin[index])
        ends = list(accumulate((width for _, width in form), initial=start))
        return {
            name: tuple(self.numbers[begin:end].tolist())
            for (name, _), begin, end in zip(form, ends[:-1], ends[1:], strict=True)
        }


def pack_column(column: npt.NDArray[Any]) -> bytes:
    """Return a column as shuffled bytes."""
    little = np.ascontiguousarray(column, column.dtype.newbyteorder("<"))
    return little.view(np.uint8).reshape(-1, column.dtype.itemsize).T.tobytes()


def unpack_column(data: bytes, dtype: npt.DTypeLike, what: str) -> npt.NDArray[Any]:
    """Return a column from its shuffled bytes.

    Raises:
        RecordingError: the length is no multiple of a number's size.
    """
    kind = np.dtype(dtype)
    if len(data) % kind.itemsize:
        raise RecordingError(
            _(
                "{what}: expected numbers of {itemsize} bytes, got {count} bytes",
                what=what,
                itemsize=kind.itemsize,
                count=len(data),
            )
        )
    shuffled = np.frombuffer(data, np.uint8).reshape(kind.itemsize, -1)
    return shuffled.T.copy().view(kind.newbyteorder("<")).reshape(-1).astype(kind)


def check_finite(column: npt.NDArray[Any], what: str) -> npt.NDArray[Any]:
    """Return a column, or raise a RecordingError if it has a number that is not finite."""
    if not np.isfinite(column).all():
        raise RecordingError(_("{what}: expected finite numbers", what=what))
    return column


def _widths(forms: Sequence[Sequence[tuple[str, int]]]) -> npt.NDArray[np.int64]:
    """Return the count of numbers in a row of each form."""
    return np.array([sum(width for _, width in form) for form in forms], np.int64)
