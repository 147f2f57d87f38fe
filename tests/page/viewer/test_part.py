"""The rate at which a part of a frame is drawn."""

import pytest

from ai4u_edu.base.log_limit import ErrorLog
from ai4u_edu.page.viewer.backend import part
from ai4u_edu.page.viewer.backend.part import RatedPart
from ai4u_edu.snapshot import Snapshot, StaticScene
from tests.page.viewer.worlds import busy_sim, picture


class Clock:
    now = 100.0

    def monotonic(self) -> float:
        return self.now

    def thread_time(self) -> float:
        return self.now


class Drawn:
    """A part that takes its time."""

    def __init__(self, clock: Clock, takes: float) -> None:
        self.clock = clock
        self.takes = takes
        self.times = 0

    def build(self, static_scene: StaticScene) -> None:
        pass

    def draw(self, snapshot: Snapshot) -> None:
        self.times += 1
        self.clock.now += self.takes


@pytest.mark.parametrize(("takes", "times"), [(0.001, 60), (0.01, 17), (0.1, 2)])
def test_slow_parts_are_drawn_less_often(
    takes: float, times: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = Clock()
    monkeypatch.setattr(part, "time", clock)
    drawn = Drawn(clock, takes)
    paced = RatedPart(drawn, 60, ErrorLog())
    sim = busy_sim()
    sim.reset(1)
    snapshot = picture(sim)
    paced.build(snapshot.static_scene)
    end = clock.now + 1
    while clock.now < end:
        paced.draw(snapshot)
        clock.now = round(clock.now * 60 + 1) / 60
    assert drawn.times == pytest.approx(times, abs=3)
