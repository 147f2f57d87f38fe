"""Columns of numbers as bytes in an episode file.

Numbers are little-endian and shuffled: the first bytes of all numbers come before all second bytes,
and so on, which compresses better.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.table import Table


def unpack_table(
    forms: list[list[tuple[str, int]]], form: bytes, numbers: bytes, what: str
) -> Table:
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
        names = [name for name, _ in each]
        if len(set(names)) < len(names) or not all(0 <= width <= 1024 for _, width in each):
            raise RecordingError(f"{what}_forms: expected names and how many numbers, got {each}")
    rows = unpack_column(form, np.uint16, f"{what}_form")
    amounts = check_finite(unpack_column(numbers, np.float64, f"{what}_numbers"), f"{what}_numbers")
    if len(rows) and int(rows.max()) >= len(forms):
        raise RecordingError(f"{what}_form: expected numbers below {len(forms)}, got {rows.max()}")
    widths = np.array([sum(width for _, width in each) for each in forms], np.int64)
    expected = int(widths[rows].sum()) if len(rows) else 0
    if len(amounts) != expected:
        raise RecordingError(f"{what}_numbers: expected {expected} numbers, got {len(amounts)}")
    return Table(tuple(tuple(each) for each in forms), rows, amounts)


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
            f"{what}: expected numbers of {kind.itemsize} bytes, got {len(data)} bytes"
        )
    shuffled = np.frombuffer(data, np.uint8).reshape(kind.itemsize, -1)
    return shuffled.T.copy().view(kind.newbyteorder("<")).reshape(-1).astype(kind)


def check_finite(column: npt.NDArray[Any], what: str) -> npt.NDArray[Any]:
    """Return a column, or raise a RecordingError if it has a number that is not finite."""
    if not np.isfinite(column).all():
        raise RecordingError(f"{what}: expected finite numbers")
    return column
