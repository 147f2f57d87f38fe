"""Latency from a key to the first tick that obeys it: measured and printed, not asserted."""

import statistics
import time

import pytest

from ai4u_edu import BasicAgent
from tests.browser.served_viser import ServedViser
from tests.waiting import until

pytestmark = [pytest.mark.browser, pytest.mark.alone, pytest.mark.nightly]

PRESSES = 30


def test_from_a_key_to_the_tick_that_obeys(
    site: ServedViser, capsys: pytest.CaptureFixture[str]
) -> None:
    agent = site.room.sim.agents[0]
    agent.brain.skip_frame = 0
    obeyed: list[float] = []
    before = [0.0]

    def note(agent: BasicAgent) -> None:
        ahead = agent.last_action["move"][0]
        if ahead and not before[0]:
            obeyed.append(time.time())  # real time: it is measured, and nothing depends on it
        before[0] = ahead

    agent.begin_of_apply_action.connect(note)
    page = site.page(has_viser=True, draws=True)
    page.evaluate(
        """() => {
            window.pressed = [];
            window.addEventListener("keydown", (event) => {
                window.pressed.push(performance.timeOrigin + event.timeStamp);
            }, {capture: true});
        }"""
    )
    for number in range(1, PRESSES + 1):
        page.keyboard.down("KeyW")
        until(lambda number=number: len(obeyed) == number)  # type: ignore[misc]
        page.keyboard.up("KeyW")
        until(lambda: before[0] == 0)
        # real time: presses are to come at different times of a tick, whichever these are
        page.wait_for_timeout(20 + 7 * number % 40)
    pressed = page.evaluate("window.pressed")
    waits = [1000 * end - begin for begin, end in zip(pressed, obeyed, strict=True)]
    middle, worst = statistics.median(waits), max(waits)
    with capsys.disabled():
        print(f"\nkey to tick, {PRESSES} presses: median {middle:.1f} ms, worst {worst:.1f} ms")
