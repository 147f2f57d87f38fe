"""Stars for programs: earned by a run and by tests, kept in the browser, shown in the tab."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, expect

from tests.browser.code_tab import PROGRAM, CodePage
from tests.browser.fake_panel import PARTS
from tests.browser.schemes import SCHEMES
from tests.browser.test_panel_accessibility import findings

pytestmark = pytest.mark.browser

EPISODES = """
([goals, decisions]) => {
  const percept = { values: { box: [0.5, 2] }, reward: 0, tick: 0 };
  for (let number = 1; number <= 10; number += 1) {
    fake.episode = (fake.episode ?? 0) + 1;
    for (let step = 0; step <= decisions; step += 1) {
      const isOver = step === decisions;
      const isGoal = isOver && number <= goals;
      const terms = isGoal ? { touch: 100 } : {};
      // truncated, it asks nobody how it ended
      const ending = { terminated: isGoal, truncated: isOver && !isGoal };
      fake.percepts.push({ ...percept, episode: fake.episode, step, terms, ...ending });
    }
  }
}
"""
"""Lets the fake world give the percepts of ten starts, of which some reach the goal."""


@pytest.fixture(scope="module")
def opened(chromium: Browser) -> Iterator[CodePage]:
    with CodePage.opened(chromium) as tab:
        yield tab


@pytest.fixture
def tab(opened: CodePage) -> CodePage:
    opened.page.evaluate("localStorage.clear(); panel.notices.length = 0; panel.driver = null;")
    forget = "import('./web/shared/storage.js').then((each) => each.forget('stars-'))"
    opened.page.evaluate(forget)
    opened.give(PARTS["scene"], "scene")
    expect(row(opened)).to_have_text("☆☆☆")
    return opened


def row(tab: CodePage) -> Locator:
    return tab.page.locator(".ai4u-code-state .ai4u-stars")


def ran(tab: CodePage, **scene: Any) -> None:
    """Run a program that reaches the goal with its first decision."""
    tab.give(PARTS["scene"] | scene, "scene")
    tab.write(PROGRAM)
    begin(tab)
    tab.sense(1, terminated=True, terms={"touch": 100})
    expect(tab.state).to_contain_text("Goal reached! Your program decided")


def begin(tab: CodePage) -> None:
    """Have the program drive, and wait until nothing tells of the run before."""
    tab.press("Run")
    expect(tab.state).not_to_contain_text("Goal reached")
    tab.sense()


def try_out(tab: CodePage, goals: int, decisions: int = 1) -> None:
    """Test a program that reaches the goal from some of ten starts."""
    tab.page.evaluate(EPISODES, [goals, decisions])
    tab.press("Test")
    tab.page.wait_for_function("fake.percepts.length === 0")
    expect(tab.page.get_by_role("button", name="Stop")).to_be_disabled()
    expect(tab.state.locator("p")).to_have_text(re.compile(rf"^{goals} of 10 reached the goal"))


def notices(tab: CodePage) -> list[str]:
    found: list[str] = tab.page.evaluate("panel.notices.splice(0)")
    return found


def test_a_run_that_reaches_the_goal_earns_one_star_once(tab: CodePage) -> None:
    ran(tab)
    expect(row(tab)).to_have_attribute("aria-label", "1 of 3 stars")
    assert notices(tab) == ["info: A star: your program has reached the goal."]
    ran(tab)
    assert notices(tab) == []


def test_ten_of_ten_starts_earn_two_stars_and_few_decisions_three(tab: CodePage) -> None:
    try_out(tab, 9)
    expect(row(tab)).to_have_text("★☆☆")
    few = {"count": 3, "few_decisions": 2}
    tab.give(PARTS["scene"] | {"stars": few}, "scene")
    try_out(tab, 10, 3)
    expect(row(tab)).to_have_text("★★☆")
    try_out(tab, 10, 2)
    expect(row(tab)).to_have_text("★★★")
    expect(tab.state).to_contain_text("in 2 decisions on average")
    assert [each[:13] for each in notices(tab)] == [
        "info: A star:",
        "info: Two sta",
        "info: Three s",
    ]
    try_out(tab, 0)
    expect(row(tab)).to_have_text("★★★")


def test_the_goals_stand_there_with_those_that_are_reached(tab: CodePage) -> None:
    goals = tab.page.locator(".ai4u-code-stars li")
    expect(goals).to_have_text(
        [
            "☆Reach the goal once, with Run.",
            "☆Press Test: reach the goal from 10 new starts.",
            "☆... and do it fast: 80 decisions or fewer on average.",
        ]
    )
    ran(tab)
    expect(goals.locator("i")).to_have_text(["★", "☆", "☆"])
    tab.give(
        PARTS["scene"] | {"scene": "forage", "stars": {"count": 2, "few_decisions": None}}, "scene"
    )
    expect(goals.locator("i")).to_have_text(["☆", "☆"])
    tab.give(PARTS["scene"] | {"scene": "mine", "stars": None}, "scene")
    expect(goals.first).to_be_hidden()
    expect(row(tab)).to_be_hidden()


def test_a_changed_scene_another_robot_and_a_helping_person_earn_none(tab: CodePage) -> None:
    ran(tab, stars=None)
    others = [{**PARTS["scene"]["agents"][0], "id": "1"}, *PARTS["scene"]["agents"]]
    ran(tab, agents=others)
    tab.give(PARTS["scene"], "scene")
    begin(tab)
    tab.page.evaluate(
        """() => {
          panel.driver = { hello: { instead: "Your program" } };
          panel.dispatchEvent(new CustomEvent("driver"));
          panel.driver = null;
          panel.dispatchEvent(new CustomEvent("driver"));
        }"""
    )
    tab.sense(1, terminated=True, terms={"touch": 100})
    expect(tab.state).to_contain_text("Goal reached")
    expect(row(tab)).to_have_text("☆☆☆")
    assert notices(tab) == []
    ran(tab)
    expect(row(tab)).to_have_text("★☆☆")


def test_what_is_kept_is_checked(tab: CodePage) -> None:
    script = """async (kept) => {
      const { allStars, earn, starsOf } = await import("./web/scenes/stars.js");
      localStorage.setItem("ai4u-stars-", kept);
      const found = [allStars(), starsOf("maze"), starsOf("constructor")];
      return [...found, earn("maze", 4), earn("tag", 0)];
    }"""
    kept = '{"maze": 2, "tag": 7, "sumo": "3", "jumper": -1, "donut": 1.5}'
    assert tab.page.evaluate(script, kept) == [{"maze": 2}, 2, 0, False, False]
    for strange in ("[]", "null", "7", '"maze"'):
        assert tab.page.evaluate(script, strange)[:2] == [{}, 0]


@pytest.mark.parametrize("scheme", SCHEMES)
def test_it_fits_a_phone_and_has_no_grave_finding(chromium: Browser, scheme: str) -> None:
    size = (390, 844)
    with CodePage.opened(chromium, size=size, scheme=scheme, has_touch=True, is_mobile=True) as tab:
        ran(tab)
        expect(row(tab)).to_have_text("★☆☆")
        assert tab.page.evaluate("document.documentElement.scrollWidth") <= 390
        for part in (".ai4u-code-head", ".ai4u-section:has(.ai4u-code-stars)"):
            assert findings(tab.page, part) == []
