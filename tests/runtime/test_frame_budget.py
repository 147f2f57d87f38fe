"""Rates of frames, and turns of pages."""

import pytest

from ai4u_edu.runtime.frame_budget import (
    MAX_FRAMES_PER_S,
    MIN_FRAMES_PER_S,
    PAGES_SLICE_S,
    FrameBudget,
    PageTurns,
)


def rate(*, pages: int = 1, tick_lateness: float = 0.0, draw_time: float = 0.0) -> float:
    return 1 / FrameBudget().frame_period(
        pages=pages, tick_lateness=tick_lateness, draw_time=draw_time
    )


def test_the_more_pages_the_fewer_frames() -> None:
    rates = [rate(pages=pages) for pages in (1, 9, 12, 18, 24, 1000)]
    assert rates == sorted(rates, reverse=True)
    assert rates[:2] == pytest.approx([MAX_FRAMES_PER_S] * 2)
    assert rates[-2:] == pytest.approx([MIN_FRAMES_PER_S] * 2)


@pytest.mark.parametrize(("cost", "reached"), [("tick_lateness", 0.02), ("draw_time", 0.01)])
def test_late_ticks_and_slow_frames_lower_the_rate_and_not_below_the_least(
    cost: str, reached: float
) -> None:
    rates = [rate(**{cost: part * reached}) for part in (0.1, 0.5, 0.9, 1.0, 100.0)]  # type: ignore[arg-type]
    assert rates == sorted(rates, reverse=True)
    assert rates[0] == pytest.approx(MAX_FRAMES_PER_S)
    assert MIN_FRAMES_PER_S < rates[1] < MAX_FRAMES_PER_S
    assert rates[3:] == pytest.approx([MIN_FRAMES_PER_S] * 2)


class Times:
    """Wall clock and processor time that pass when a test says so."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def drawn(turns: PageTurns, pages: int, times: Times, takes: float) -> list[int]:
    """Numbers of the pages that one frame draws, each of which takes `takes` seconds."""
    found = []
    for page in turns.due(range(pages)):
        times.now += takes
        found.append(page)
    return found


def test_pages_take_turns_within_the_share_of_a_frame() -> None:
    times = Times()
    turns = PageTurns(8, times, times)
    frames = [drawn(turns, 10, times, PAGES_SLICE_S / 3.5) for _ in range(3)]
    assert frames == [[0, 1, 2, 3], [4, 5, 6, 7], [8, 9]]
    assert drawn(turns, 10, times, 0.0) == []  # all of them have been drawn lately
    times.now += 1 / 8
    assert drawn(turns, 3, times, 0.0) == [0, 1, 2]
    assert drawn(turns, 4, times, 0.0) == [3]  # one that has just come is drawn at once


def test_a_page_that_is_slow_to_draw_has_its_turn_too() -> None:
    times = Times()
    turns = PageTurns(30, times, times)
    assert [drawn(turns, 2, times, 1.0) for _ in range(3)] == [[0], [1], [0]]
    assert drawn(turns, 0, times, 1.0) == []
