"""Back in time in the tab "Code", with a fake Python and a fake world."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.code_tab import PROGRAM, CodePage

pytestmark = pytest.mark.browser


@pytest.fixture
def tab(chromium: Browser) -> Iterator[CodePage]:
    with CodePage.opened(chromium) as tab:
        yield tab


PAST = {"type": "part", "name": "past", "episodes": [], "is_showing": True, "shown": "Episode 1"}


def test_back_in_time_it_shows_what_the_program_did_there(tab: CodePage) -> None:
    moment = tab.page.locator(".ai4u-code-moment")
    tab.page.evaluate("""() => (fake.decide = (percept, number) => ({
      ok: true, values: { move: [1, 0] }, printed: `here ${number}\\n`,
      lines: [number + 1, number + 1], variables: { near: String(number) } }))""")
    tab.write(PROGRAM)
    tab.sense(0)
    tab.sense(1)
    tab.press("Run")
    expect(tab.page.locator(".ai4u-code-variables")).to_have_text("near2")
    expect(moment).to_be_hidden()
    playing = {"number": 4, "step": 0, "steps": 3, "is_playing": False, "speed": 1}
    tab.give(PAST | {"playing": playing | {"world_episode": 1}}, "past")
    expect(moment).to_contain_text("Decision 1 of 3: the lines that ran are marked.")
    expect(moment.locator("pre")).to_have_text("here 1")
    expect(tab.page.locator(".ai4u-code-variables")).to_have_text("near1")
    expect(tab.page.locator(".ai4u-code-ran-line")).to_have_text(['    near = percept["box"][0]'])
    expect(moment.get_by_role("button", name="Decision before")).to_be_disabled()
    moment.get_by_role("button", name="Next decision").click()
    assert {"command": "step", "step": 1} in tab.sent()
    tab.give(PAST | {"playing": playing | {"world_episode": 1, "step": 2}}, "past")
    expect(moment).to_contain_text("Decision 3 of 3: your program did not make it")
    expect(tab.page.locator(".ai4u-code-variables")).to_be_hidden()
    tab.give(PAST | {"playing": playing | {"world_episode": 7}}, "past")
    expect(moment).to_contain_text("your program did not make it")
    tab.give(PAST | {"playing": playing | {"world_episode": 1, "step": 3}}, "past")
    expect(moment).to_contain_text("The end of the episode, after 3 decisions.")
    expect(moment.get_by_role("button", name="Next decision")).to_be_disabled()
    tab.write(PROGRAM + "\n")
    tab.give(PAST | {"playing": playing | {"world_episode": 1}}, "past")
    expect(moment).to_contain_text("Your program has changed since")
    expect(tab.page.locator(".ai4u-code-ran-line")).to_have_count(0)
    expect(tab.page.locator(".ai4u-code-variables")).to_have_text("near1")
    moment.get_by_role("button", name="Back to live").click()
    assert {"command": "back_to_live"} in tab.sent()
    tab.give(PAST | {"is_showing": False, "playing": None}, "past")
    expect(moment).to_be_hidden()
    expect(tab.page.locator(".ai4u-code-variables")).to_have_text("near2")


def test_the_timeline_keeps_so_much_and_drops_the_oldest(tab: CodePage) -> None:
    found = tab.page.evaluate(
        """async () => {
      const { CodeTimeline } = await import("./web/code/timeline.js");
      const timeline = new CodeTimeline();
      const told = (text = "") => ({ lines: [1], variables: {}, printed: text });
      for (let each = 1; each <= 20_010; each += 1) {
        timeline.add(each <= 5 ? 1 : 2, each, "a", told());
      }
      const many = [timeline.at(1, 5), timeline.at(2, 10), timeline.at(2, 11)?.source];
      timeline.add(3, 1, "a", told("x".repeat(3_999_000)));
      timeline.add(3, 2, "a", told("x".repeat(3_000)));
      const large = [timeline.at(2, 20_010), timeline.at(3, 1), timeline.at(3, 2)?.printed.length];
      timeline.add(4, 1, "a", told("first"));
      timeline.add(4, 2, "a", told("first"));
      timeline.add(4, 1, "a", told("again"));
      return [many, large, [timeline.at(4, 1).printed, timeline.at(4, 2)]];
    }"""
    )
    assert found == [[None, None, "a"], [None, None, 3000], ["again", None]]


def test_variables_that_are_numbers_have_a_curve_over_time(tab: CodePage) -> None:
    tab.page.evaluate("""() => (fake.decide = (percept, number) => ({
      ok: true, values: { move: [1, 0] }, printed: "", lines: [2],
      variables: { near: String(number * 2), word: "'left'" } }))""")
    for step in range(3):
        tab.sense(step)
    tab.press("Run")
    curves = tab.page.locator(".ai4u-code-variables svg")
    near = "near: from 2.00 to 6.00 in the latest 3 decisions"
    expect(curves.first).to_have_attribute("aria-label", near)
    expect(curves.first.locator("polyline")).to_have_attribute(
        "points", "0.0,24.0 100.0,12.0 200.0,0.0"
    )
    expect(curves.last).to_be_hidden()  # a text
    tab.press("Stop")
    tab.sense(3)  # for the run that was stopped
    for step in (3, 4):
        tab.sense(step)
    tab.press("Step")
    expect(tab.page.locator(".ai4u-code-variables")).to_have_text("near8word'left'")
    expect(curves.first).to_be_hidden()  # one number makes no curve
    tab.sense(5)
    tab.press("Step")
    two = "near: from 8.00 to 10.0 in the latest 2 decisions"
    expect(curves.first).to_have_attribute("aria-label", two)
