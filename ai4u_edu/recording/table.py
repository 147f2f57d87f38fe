"""Compact tables of rows of named numbers: actions and reward terms."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate

import numpy as np
import numpy.typing as npt

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
        widths = np.array([width_of(each) for each in self.forms], np.int64)
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


def width_of(form: Form) -> int:
    """Return the count of numbers in a row of a form."""
    return sum(width for _, width in form)
