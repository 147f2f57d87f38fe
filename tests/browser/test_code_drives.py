"""A program in the page drives a real world: Python, the connection and the page are real, too."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.code_editor import WithEditor
from tests.browser.code_page import WORLD_WAITS, set_limits
from tests.browser.served_viser import ready, record_texts
from tests.browser.test_play import MIDDLE, agent
from tests.chromium import new_page, until_on
from tests.code_sheet import programs_in_docs
from tests.playing import Played, played
from tests.waiting import until

pytestmark = pytest.mark.browser

BODY = "def decide(percept):\n    "
NUMBERS_AND_TEXTS = (
    'items => items.map(item => ["b", "span"].map(tag => item.querySelector(tag).innerText))'
)
"""A script: what a program printed, by the number of the decision."""
MISTAKES = [
    ("def decide(percept)\n    return {}", 1, "A colon (:) is missing"),
    ("def decide(percept):\nreturn {}", 2, "Put four more spaces"),
    (f'{BODY}return {{"move": [1, 0, 0, 0]', 2, "is never closed"),
    (f"{BODY}percept", None, "Is `return` missing?"),
    (f'{BODY}return {{"move": [percept["orientatoin"][0], 0, 0, 0]}}', 2, "'orientation'"),
    (f'{BODY}return {{"mvoe": [1, 0, 0, 0]}}', None, "'move'"),
    (f'{BODY}return {{"move": [1, 0]}}', None, "4"),
    (f'{BODY}return {{"move": ["fast", 0, 0, 0]}}', None, "number"),
    (f"{BODY}cosine = 1\n    return cosin", 3, "did you mean 'cosine'?"),
    (f"{BODY}import numpy\n    return {{}}", 2, "numpy is not there"),
]
"""Programs, the lines of their mistakes (None: some line or none), and words of their sentences."""


class CodeTab(WithEditor):
    """The tab of a real page."""

    def __init__(self, page: Page) -> None:
        self.page = page
        page.get_by_role("tab", name="Code").click()
        expect(self.editor).to_contain_text("def ")  # it would take the place of what is written
        self.mistake = page.locator(".ai4u-code-mistake")

    @property
    def state(self) -> Locator:
        return self.page.locator(".ai4u-code-state")


@pytest.fixture(scope="module")
def server() -> Iterator[Played]:
    with played("box_chase", "--seed", MIDDLE, *WORLD_WAITS) as server:
        yield server


@pytest.fixture(scope="module")
def asked(chromium: Browser) -> list[bytes]:
    """Return the requests for more time that the page has sent to the world."""
    return []


@pytest.fixture(scope="module")
def opened(server: Played, chromium: Browser, asked: list[bytes]) -> Iterator[CodeTab]:
    page = new_page(chromium)
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))

    def note(frame: str | bytes) -> None:
        if isinstance(frame, bytes) and b"order" in frame and b"wait" in frame:
            asked.append(frame)

    page.on("websocket", lambda socket: socket.on("framesent", note))
    page.goto(server.url)
    ready(page)
    set_limits(page)
    yield CodeTab(page)
    page.context.close()
    assert problems == []


@pytest.fixture
def tab(server: Played, opened: CodeTab) -> CodeTab:
    server.restart(int(MIDDLE))
    return opened


def test_seven_lines_reach_the_box(server: Played, tab: CodeTab) -> None:
    program = programs_in_docs()[0]
    assert len(program.splitlines()) == 7
    tab.editor.click()
    tab.page.keyboard.press("ControlOrMeta+a")
    for line in program.splitlines():
        tab.page.keyboard.type(line.strip())  # the editor indents, and closes brackets
        tab.page.keyboard.press("Enter")
        if line.strip().startswith("return"):
            tab.page.keyboard.press("Shift+Tab")
    driver = tab.page.locator(".ai4u-row .ai4u-driver")
    drivers = record_texts(tab.page, ".ai4u-row .ai4u-driver")
    tab.page.keyboard.press("ControlOrMeta+Enter")
    expect(tab.state).to_contain_text("Goal reached! Your program decided")
    assert any("Your program drives" in text for text in drivers())
    assert agent(server)["reward_terms"]["touch"] == 100
    expect(tab.page.get_by_role("log")).to_contain_text("cosine 0.9")
    expect(driver).not_to_contain_text("Your program")


@pytest.mark.parametrize(("program", "line", "words"), MISTAKES)
def test_a_mistake_is_a_sentence_at_its_line(
    tab: CodeTab, program: str, line: int | None, words: str
) -> None:
    tab.write(program)
    tab.press("Run")
    expect(tab.mistake).to_contain_text(words)
    if line is not None:
        expect(tab.mistake).to_contain_text(f"Line {line}: ")
        marked = tab.page.locator(".ai4u-code-mistake-line")
        expect(marked).to_have_text(program.splitlines()[line - 1])
    expect(tab.page.get_by_role("button", name="Stop", exact=True)).to_be_disabled()


def test_an_endless_loop_is_ended_at_its_line(tab: CodeTab) -> None:
    set_limits(tab.page, programS=1)
    tab.write(f"{BODY}while True:\n        pass")
    tab.press("Run")
    expect(tab.mistake).to_contain_text("Line 2: ")
    expect(tab.mistake).to_contain_text("running for 1 second without an answer")
    expect(tab.page.locator(".ai4u-code-mistake-line")).to_have_text("    while True:")
    set_limits(tab.page)


def test_a_class_of_the_docs_drives(server: Played, tab: CodeTab) -> None:
    (_, patrol) = programs_in_docs()
    assert "def get_action" in patrol
    tab.write(patrol)
    tab.press("Run")
    expect(tab.state).to_contain_text(re.compile(r"Runs\s*decision \d"))
    until(lambda: server.snapshot()["agents"][0]["action"]["move"][0] != 0)
    expect(tab.page.locator(".ai4u-code-variables")).to_contain_text("self")
    tab.press("Stop")


def test_stop_gives_the_robot_back(server: Played, tab: CodeTab) -> None:
    tab.write(BODY + 'return {"move": [0, 0.3, 0, 0]}')
    tab.press("Run")
    expect(tab.state).to_contain_text("Runs")
    until(lambda: "Remote" in agent(server)["brain"])
    tab.press("Stop")
    until(lambda: "Remote" not in agent(server)["brain"])
    tab.page.keyboard.down("KeyW")
    until(lambda: abs(agent(server)["pose"][0]) > 0.3)
    tab.page.keyboard.up("KeyW")


def test_back_in_time_stands_what_the_program_did_at_that_decision(
    server: Played, tab: CodeTab
) -> None:
    counts = "global count\n    count += 1\n    print('count', count)\n    "
    tab.write(f'count = 0\n{BODY}{counts}return {{"move": [0, 0.3, 0, 0]}}')
    tab.press("Run")
    expect(tab.state).to_contain_text(re.compile(r"decision ([5-9]|\d\d)"))
    tab.press("Stop")
    until(lambda: "Remote" not in agent(server)["brain"])
    steps = agent(server)["steps"]
    until(lambda: agent(server)["steps"] > steps + 1)
    tab.page.get_by_role("tab", name="Past").click()
    tab.page.get_by_role("button", name="Current episode").click()
    # the end, if no decision was taken while it was made
    expect(tab.page.get_by_text(re.compile("Past: episode .* (step|the end)"))).to_be_visible()
    tab.page.get_by_role("tab", name="Code").click()
    moment = tab.page.locator(".ai4u-code-moment")
    words = moment.get_by_role("status")
    expect(words).to_contain_text("your program did not make it")  # the latest ones were the keys'
    printed = dict(tab.page.get_by_role("log").locator("li").evaluate_all(NUMBERS_AND_TEXTS))
    for number in sorted(map(int, printed), reverse=True)[
        :3
    ]:  # realtime: not each is the program's
        step_back_to(moment, number)
        expect(words).to_contain_text("the lines that ran are marked")
        expect(tab.page.locator(".ai4u-code-ran-line")).to_have_count(3)
        expect(moment.locator("pre")).to_have_text(printed[str(number)])
        count = printed[str(number)].removeprefix("count ")
        expect(tab.page.locator(".ai4u-code-variables")).to_have_text(f"count{count}")
    moment.get_by_role("button", name="Back to live").click()
    expect(moment).to_be_hidden()


def step_back_to(moment: Locator, number: int) -> None:
    """Press "Decision before" until the moment is the decision with a number."""
    words = moment.get_by_role("status")
    while f"Decision {number} of" not in (said := words.inner_text()):
        moment.get_by_role("button", name="Decision before").click()
        expect(words).not_to_have_text(said)


def test_step_makes_one_decision_and_run_goes_on(
    server: Played, tab: CodeTab, asked: list[bytes]
) -> None:
    counts = "global count\n    count += 1\n    if count <= 3: print(count)\n    return {}"
    tab.write(f"count = 0\n{BODY}{counts}")
    tab.press("Step")
    expect(tab.state).to_contain_text("Waits for the next step")
    log = tab.page.get_by_role("log").locator("span")
    expect(log).to_have_text(["1"])
    ticks = server.snapshot()["tick"]
    before = len(asked)
    until_on(tab.page, lambda: len(asked) >= before + 3)
    assert server.snapshot()["tick"] == ticks
    tab.press("Step")
    expect(log).to_have_text(["1", "2"])
    until(lambda: server.snapshot()["tick"] > ticks)
    tab.press("Run")
    expect(log).to_have_text(["3"])
    tab.press("Stop")
