import re

import numpy as np
import pytest

from ai4u_edu.viewer.panel.bars import bar, strip


@pytest.mark.parametrize(
    ("value", "low", "high", "left", "width"),
    [
        (0.25, 0.0, 1.0, 0.0, 25.0),
        (0.5, -1.0, 1.0, 50.0, 25.0),
        (-0.5, -1.0, 1.0, 25.0, 25.0),
        (7.0, 5.0, 10.0, 0.0, 40.0),
        (-7.0, -10.0, -5.0, 60.0, 40.0),
        (99.0, 0.0, 1.0, 0.0, 100.0),
    ],
)
def test_a_bar_goes_from_zero_to_the_value(
    value: float, low: float, high: float, left: float, width: float
) -> None:
    assert f"left:{left:.1f}%;width:{width:.1f}%" in bar(value, low, high)


def test_zero_is_marked_where_it_lies_inside_the_range() -> None:
    assert 'class="zero" style="left:25%"' in bar(1.0, -1.0, 3.0)
    assert "zero" not in bar(1.0, 0.0, 3.0)


def test_a_range_without_an_end_has_no_bar() -> None:
    assert "bar" not in bar(3.0, -np.inf, np.inf)


def test_a_strip_has_a_bar_for_each_number_from_zero_on() -> None:
    ends = np.full(3, -1.0), np.full(3, 1.0)
    svg = strip(np.array([1.0, 0.0, -1.0]), *ends)
    tops = [
        (float(top), float(height)) for top, height in re.findall(r" ([\d.]+)h0.85v([\d.]+)", svg)
    ]
    assert tops == [(0.0, 0.5), (0.5, 0.03), (0.5, 0.5)]


def test_bars_of_one_colour_are_one_path() -> None:
    ends = np.zeros(3), np.ones(3)
    svg = strip(np.ones(3), *ends, colours=[(1, 2, 3), (4, 5, 6), (1, 2, 3)])
    assert svg.count("<path") == 2
