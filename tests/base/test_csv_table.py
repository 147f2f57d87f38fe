"""Tables that people open in a spreadsheet, with names that others chose."""

import csv
import io

import pytest

from ai4u_edu.base.csv_table import csv_table

FORMULAS = [
    '=HYPERLINK("http://x.org")',
    '+HYPERLINK("http://x.org")',
    "-2+3+cmd|' /C calc'!A0",
    "@SUM(1)",
    " =1+1",
    "\t=1",
    "\r=1",
    "\n=1",
    "-E5",
    "\uff1d1+1",
]


@pytest.mark.parametrize("text", FORMULAS)
def test_no_cell_and_no_heading_is_a_formula(text: str) -> None:
    rows = [*csv.reader(io.StringIO(csv_table([text], [[text], [f"a{text}"]]), newline=""))]
    shown = text.replace("\r", "\n")
    assert rows == [[f"'{shown}"], [f"'{shown}"], [f"a{shown}"]]


@pytest.mark.parametrize("value", [-1.5, "-1.5", "-1.5 +2e-07 3", "-0.25 ", "Ann=1", "", None])
def test_numbers_and_other_texts_stay_as_they_are(value: object) -> None:
    _, row = csv.reader(csv_table(["a", "b"], [[value, "x"]]).splitlines())
    assert row == ["" if value is None else str(value), "x"]


def test_a_cell_with_separators_is_one_cell() -> None:
    text = csv_table(["a", "b"], [['x,"=1"', 1]])
    assert [*csv.reader(text.splitlines())] == [["a", "b"], ['x,"=1"', "1"]]
