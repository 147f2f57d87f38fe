import re

import numpy as np
import pytest

from ai4u_edu.snapshot.block_info import ActuatorInfo, Component, block_info_of
from ai4u_edu.viewer.panel.readings import BAR_CHARS, MAX_LISTED_NUMBERS, action, reading, rewards
from tests.builders import small_sim

EVIL = "<script>alert('&')</script>"


def bars(html: str) -> list[list[str]]:
    """The bars of a reading, by table and row."""
    return [table.split("\n") for table in re.findall("<pre>(.*?)</pre>", html, re.DOTALL)]


@pytest.mark.parametrize(
    "html",
    [
        action({EVIL: (1.0,)}),
        action({EVIL: (1.0,)}, [ActuatorInfo(EVIL, EVIL, (Component(EVIL, -1, 1),), False)]),
        rewards({EVIL: 1.0}, {EVIL: 2.0}),
    ],
)
def test_what_a_scene_names_is_escaped(html: str) -> None:
    assert "<script" not in html
    assert "&lt;script&gt;" in html


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (True, "yes"),
        (np.False_, "no"),
        (3, "3"),
        (0.123456, "0.12"),
        ("word", "word"),
        (np.array([1.0, -2.5]), "1.00&ensp;-2.50"),
        (np.array([[1], [2]], np.int32), "1&ensp;2"),
        (np.array([True, False]), "1&ensp;0"),
        (np.array([]), ""),
    ],
)
def test_short_readings_are_shown_in_full(value: object, expected: str) -> None:
    assert reading(value) == expected


def test_long_text_is_cut() -> None:
    assert len(reading("x" * 10_000)) == 200


def test_long_arrays_are_bars_of_their_size() -> None:
    assert bars(reading(np.linspace(0, 1, 16))) == [["".join(f"{bar}{bar}" for bar in BAR_CHARS)]]


def test_bars_of_small_numbers_mean_the_same_at_any_time() -> None:
    assert bars(reading(np.full(MAX_LISTED_NUMBERS + 1, 0.5))) == [
        [BAR_CHARS[4] * (MAX_LISTED_NUMBERS + 1)]
    ]


def test_bars_reach_from_the_lowest_to_the_highest_number() -> None:
    ((row,),) = bars(reading(np.array([-4.0, 4.0] * 5)))
    assert row == (BAR_CHARS[0] + BAR_CHARS[-1]) * 5


def test_arrays_are_laid_out_as_they_are() -> None:
    html = reading(np.zeros((4, 2, 3, 5)))
    assert "4 x 2 x 3 x 5" in html
    assert "in part" not in html
    tables = bars(html)
    assert len(tables) == 8
    assert [len(row) for row in tables[0]] == [5, 5, 5]


def test_long_rows_are_wrapped_and_large_arrays_shown_in_part() -> None:
    assert [len(row) for row in bars(reading(np.zeros(100)))[0]] == [40, 40, 20]
    large = reading(np.zeros((200, 300), np.uint8))
    assert "in part" in large
    assert len(large) < 3000


def test_rewards_are_shown_by_term_with_their_sum() -> None:
    html = rewards({"touch": 1.0}, {"touch": 1.0, "time": -0.5})
    cells = re.findall("<th>(.*?)</th><td>(.*?)</td><td>(.*?)</td>", html)
    assert cells[1:] == [
        ("touch", "1.00", "1.00"),
        ("time", "0.00", "-0.50"),
        ("sum", "1.00", "0.50"),
    ]


def test_small_rewards_do_not_vanish() -> None:
    assert "<td>-0.0012</td>" in rewards({"step": -0.0012}, {"step": -0.0012})


def test_an_action_is_shown_by_the_names_of_its_components() -> None:
    (control,) = block_info_of(small_sim().agents[0]).actuator_infos
    html = action({"move": (0.5, -1.0, 0.0, 0.0)}, [control])
    lines = re.findall('<span>(.*?)</span><div class="bar">(.*?)</div><b>(.*?)</b>', html)
    assert [(name, number) for name, _, number in lines] == [
        ("forward", "0.50"),
        ("turn", "-1.00"),
        ("jump", "0.00"),
        ("forward jump", "0.00"),
    ]
    assert "left:50.0%;width:25.0%" in lines[0][1]  # from the middle to the right
    assert "left:0.0%;width:50.0%" in lines[1][1]
    assert "nothing yet" in action({})


def test_a_choice_is_a_number_out_of_some() -> None:
    control = ActuatorInfo("move", "GridMoveActuator", (Component("", 0.0, 4.0),), True)
    assert "choice <b>3</b> <small>of 0 to 4</small>" in action({"move": (3.0,)}, [control])


def test_of_an_actuator_that_is_gone_the_numbers_are_shown() -> None:
    assert "0.50&ensp;-1.00" in action({"move": (0.5, -1.0)})
