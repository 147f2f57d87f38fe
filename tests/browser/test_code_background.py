"""A page in the background lets its program drive on, or says that it was stopped."""

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.code_page import WORLD_WAITS, code_page
from tests.browser.code_tab import PROGRAM, CodePage
from tests.browser.test_code_lockstep import CHEAP, DRIVE, SEED
from tests.playing import played
from tests.program.solutions import solution
from tests.waiting import until

pytestmark = pytest.mark.browser

HIDDEN = """
window.requestAnimationFrame = () => 0;
for (const name of ["setTimeout", "setInterval"]) {
  const now = window[name];
  window[name] = (call, delay = 0, ...rest) => now(call, Math.max(60_000, delay), ...rest);
}
"""
"""The worst that browsers do to hidden pages: no frames, and timers only once in a minute."""


def test_without_frames_and_timers_the_program_drives_on(chromium: Browser) -> None:
    with CodePage.opened(chromium) as tab:
        tab.write(PROGRAM)
        tab.page.evaluate(HIDDEN)
        tab.press("Run")
        for step in range(20):
            tab.sense(step)
            until(lambda: tab.page.evaluate("!fake.percepts.length && Boolean(fake.taker)"))
        assert len(tab.calls("act")) == 20


def test_a_browser_that_stops_the_page_ends_the_run_and_the_tab_says_so(
    chromium: Browser,
) -> None:
    with CodePage.opened(chromium) as tab:
        tab.write(PROGRAM)
        tab.press("Run")
        tab.sense()
        expect(tab.state).to_contain_text("Runs")
        tab.page.evaluate("document.dispatchEvent(new Event('freeze'))")
        assert tab.page.evaluate("fake.closed") == 1
        expect(tab.mistake).to_contain_text("stopped this page in the background")
        expect(tab.state).to_contain_text("The run ended at decision 1")


@pytest.mark.nightly
def test_a_real_program_needs_no_timers_either(chromium: Browser) -> None:
    with played(CHEAP, "--time-scale", "100", *WORLD_WAITS) as server:
        page = code_page(chromium, server.url)
        page.evaluate("engine.warm()")
        page.evaluate(HIDDEN)
        assert '"terminated":true' in page.evaluate(DRIVE, [solution(CHEAP), SEED, "0"])
        page.context.close()
