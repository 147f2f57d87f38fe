"""A beginner's afternoon in the tab "Code": every mistake on the way to three stars, and abuse.

World, page and Python are real.
"""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.code_page import WORLD_WAITS, set_limits
from tests.browser.served_viser import ready
from tests.browser.test_code_drives import CodeTab
from tests.browser.test_play import MIDDLE
from tests.chromium import DRAW_NOTHING, new_page, until_on
from tests.code_sheet import programs_in_docs
from tests.playing import Played, played
from tests.waiting import until

pytestmark = [pytest.mark.browser, pytest.mark.nightly]

RUNS = 1000
CALL_MS = 2000
"""Time after which the page ends a program that nothing interrupts (ms)."""


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    with played("box_chase", "--seed", MIDDLE, *WORLD_WAITS) as server:
        yield server


@pytest.fixture
def tab(server: Played, chromium: Browser) -> Iterator[CodeTab]:
    page = new_page(chromium)
    page.add_init_script(DRAW_NOTHING)
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    server.restart(int(MIDDLE))
    page.goto(server.url)
    ready(page)
    set_limits(page)
    tab = CodeTab(page)
    expect(tab.editor).to_contain_text("def decide")
    yield tab
    page.context.close()
    assert problems == []


def stars(page: Page, count: int) -> None:
    """Wait until a program has earned ``count`` stars."""
    row = page.locator(".ai4u-code-state .ai4u-stars")
    expect(row).to_have_attribute("aria-label", f"{count} of 3 stars")


def lives(server: Played, page: Page) -> None:
    """Check that the world goes on, and that the page answers."""
    tick = server.snapshot()["tick"]
    until(lambda: server.snapshot()["tick"] > tick)
    assert page.evaluate("1 + 1") == 2
    # the one that runs, and a spare one; Chromium ends others a bit later
    until_on(page, lambda: sum("code/worker" in each.url for each in page.workers) <= 2)


def test_the_way_to_three_stars(server: Played, tab: CodeTab) -> None:
    right = programs_in_docs()[0]
    assert len(right.splitlines()) == 7
    stars(tab.page, 0)
    mistakes = [
        ("(percept):", "(percept)", "A colon (:) is missing"),
        ("    cosine =", "cosine =", "four more spaces"),
        ('["orientation"][0]', '["orientation"[0]', "is never closed"),
        ('"orientation"', '"orientatoin"', "'orientation'"),
        ("if cosine", "if cosin", "did you mean 'cosine'?"),
        ("return {", "{", "Is `return` missing?"),
        ('"move"', '"mvoe"', "'move'"),
        ("[1, 0, 0, 0]", "[1, 0]", "4"),
        ("[0, 0.3, 0, 0]", '["left", 0.3, 0, 0]', "number"),
        ('    print("cosine", cosine)', "    while cosine < 2:\n        pass", "without an answer"),
    ]
    for good, bad, words in mistakes:
        assert good in right
        server.restart(int(MIDDLE))
        if words == "without an answer":
            set_limits(tab.page, programS=1)
        tab.write(right.replace(good, bad))
        tab.press("Run")
        expect(tab.mistake).to_contain_text(words)
    set_limits(tab.page)
    stars(tab.page, 0)

    server.restart(int(MIDDLE))
    tab.write(right)
    tab.press("Run")
    expect(tab.state).to_contain_text("Goal reached")
    stars(tab.page, 1)
    tab.press("Test")
    expect(tab.state).to_contain_text("10 of 10 reached the goal, in")
    stars(tab.page, 3)
    expect(tab.page.locator(".ai4u-code-stars i")).to_have_text(["★"] * 3)


ABUSE = {
    "an endless loop": ("    while True: pass", "without an answer"),
    "a loop that nothing interrupts": ("    10**10**8", "did not come back"),
    "a huge print": ("    print('x' * 10**8)\n    return {}", ""),
    "many prints": ("    for each in range(20000): print(each)\n    return {}", ""),
    "a text of 10 MB": ("    return {'move': 'x' * 10**7}", "move"),
    "a list of 10 MB": ("    return {'move': [0.5] * 10**6}", ""),
    "all memory": ("    return {'move': [0] * 10**10}", ""),
    "import os": ("    import os\n    os.system('ls'); return {}", ""),
    "import socket": ("    import socket\n    socket.create_connection(('127.0.0.1', 80))", ""),
    "an exit": ("    import sys\n    sys.exit()", ""),
    "deep recursion": ("    return decide(percept)", ""),
}
"""Bodies of programs, and words of the sentence about them."""


def test_a_program_that_does_its_worst_harms_neither_page_nor_world(
    server: Played, tab: CodeTab
) -> None:
    for name, (body, words) in ABUSE.items():
        server.restart(int(MIDDLE))
        # the page has no limit of its own where Python has one
        limits = {
            "an endless loop": {"programS": 1},
            "a loop that nothing interrupts": {"callMs": CALL_MS},
        }
        set_limits(tab.page, **limits.get(name, {}))
        tab.write(f"def decide(percept):\n{body}\n")
        tab.press("Run")
        said = re.compile(r"The run ended|Runs|Stopped|after \d")
        expect(tab.state, name).to_contain_text(said)
        if words:
            expect(tab.mistake, name).to_contain_text(words)
        lives(server, tab.page)
        if tab.page.get_by_role("button", name="Stop", exact=True).is_enabled():
            tab.press("Stop")
    server.restart(int(MIDDLE))
    tab.write(programs_in_docs()[0])
    tab.press("Run")
    expect(tab.state).to_contain_text("Goal reached")


def test_a_thousand_runs(server: Played, tab: CodeTab) -> None:
    tab.write('def decide(percept):\n    return {"move": [0, 0.3, 0, 0]}\n')
    tab.press("Run")
    expect(tab.state).to_contain_text("Runs")
    run = tab.page.get_by_role("button", name="Run", exact=True)
    # real time: a pause between clicks, of any length; the runs that count are waited for
    pressed = """async (run, runs) => {
      const state = document.querySelector(".ai4u-code-state");
      const soon = () => new Promise((done) => setTimeout(done, 5));
      for (let number = 1; number <= runs; number += 1) {
        run.click();
        await soon(); // most are pressed while the one before joins
        if (number % 50) continue;
        while (!/Runs/.test(state.textContent)) await soon();
      }
    }"""
    run.evaluate(pressed, RUNS)
    expect(tab.state).to_contain_text(re.compile(r"Runs\s*decision \d"))
    lives(server, tab.page)
    until(lambda: "Remote" in server.snapshot()["agents"][0]["brain"])
    tab.press("Stop")
    until(lambda: "Remote" not in server.snapshot()["agents"][0]["brain"])
    server.restart(int(MIDDLE))
    tab.write(programs_in_docs()[0])
    tab.press("Run")
    expect(tab.state).to_contain_text("Goal reached")
