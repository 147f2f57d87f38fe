"""How soon the next picture comes."""

import pytest

from ai4u_edu.viewer.backend.pace import CALM, HEAVY, LATE, LEAST, QUICK, Pace


@pytest.mark.parametrize(("pages", "least", "most"), [(1, 75, 75), (8, 75, 75), (16, 40, 50)])
def test_the_more_pages_the_fewer_pictures(pages: int, least: float, most: float) -> None:
    rate = 1 / Pace().period(pages=pages, late=0.0, spent=0.0)
    assert least - 1e-6 <= rate <= most + 1e-6


@pytest.mark.parametrize("pages", [24, 60, 1000])
def test_there_are_always_enough(pages: int) -> None:
    pace = Pace()
    for _ in range(100):
        assert 1 / pace.period(pages=pages, late=1.0, spent=0.0) == pytest.approx(CALM)
        assert 1 / pace.period(pages=pages, late=1.0, spent=10.0) == pytest.approx(LEAST)


def test_late_ticks_calm_the_pictures_and_a_quiet_time_quickens_them_again() -> None:
    pace = Pace()

    def rates(count: int, late: float, spent: float = 1.1 * HEAVY) -> list[float]:
        return [1 / pace.period(pages=1, late=late, spent=spent) for _ in range(count)]

    assert rates(12, 2 * LATE, 0.9 * HEAVY)[-1] == pytest.approx(QUICK)  # they are not the cause
    falling = rates(12, 2 * LATE)
    assert falling == sorted(falling, reverse=True)
    assert falling[-1] == pytest.approx(CALM)
    rising = rates(120, 0.0)
    assert rising == sorted(rising)
    assert rising[20] < QUICK / 1.5
    assert rising[-1] == pytest.approx(QUICK)
