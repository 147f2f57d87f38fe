"""CSV as spreadsheets open it: no cell is a formula, whoever chose its text."""

import csv
import io
import re
from collections.abc import Iterable

FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\n", "\uff1d", "\uff0b", "\uff0d", "\uff20")
"""Characters with which a formula begins in a spreadsheet, also in their full-width forms."""
NUMBERS = re.compile(r"([-+]?\d+(\.\d*)?([eE][-+]?\d+)?( |$))+")
"""Texts of numbers, such as a learning curve."""


def csv_table(header: Iterable[object], rows: Iterable[Iterable[object]]) -> str:
    r"""Return a table as CSV, with an apostrophe before texts that a spreadsheet would evaluate.

    Args:
        header: names of the columns.
        rows: cells; numbers stay as they are.

    >>> csv_table(["name", "points"], [["=1+1", -5.0], ["Ann, the first", 3]])
    'name,points\n\'=1+1,-5.0\n"Ann, the first",3\n'
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(map(_cell, header))
    writer.writerows(map(_cell, row) for row in rows)
    return out.getvalue()


def _cell(value: object) -> object:
    if not isinstance(value, str):
        return value
    value = value.replace("\r\n", "\n").replace("\r", "\n")  # the latter would end a row unquoted
    is_formula = value.lstrip(" ").startswith(FORMULA_STARTS) and not NUMBERS.fullmatch(value)
    return f"'{value}" if is_formula else value
