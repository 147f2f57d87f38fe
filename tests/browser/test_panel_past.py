"""The panel's tab "Past", with a fake panel."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, expect

from ai4u_edu.recording.episode import MAX_RECORDING_BYTES
from tests.browser.served_viser import record_texts
from tests.browser.tab_page import TabPage
from tests.chromium import until_on

MINE = {
    "number": 3,
    "scene": "Donut",
    "is_here": True,
    "source": "",
    "driver": "Keys W, A, S, D",
    "is_person": True,
    "end": "goal",
    "reward": 9.7312,
    "decisions": 80,
    "seconds": 14.2,
    "seed": "8061527393621437281",
    "is_pinned": False,
    "is_best": True,
}
NETWORKS = {
    **MINE,
    "number": 4,
    "driver": "Trained network",
    "is_person": False,
    "end": "fell",
    "is_best": False,
}
PLAYING = {
    "number": 3,
    "scene": "Donut",
    "is_here": True,
    "step": 11,
    "steps": 80,
    "is_playing": False,
    "speed": 1.0,
}
PART: dict[str, Any] = {
    "episodes": [MINE, NETWORKS],
    "playing": None,
    "is_showing": True,
    "ghost": "",
    "problem": "",
    "downloads": [],
    "max_recording_bytes": MAX_RECORDING_BYTES,
}
DOWNLOADS = [
    {"format": "gif", "title": "GIF", "url": "api/past/3.gif"},
    {"format": "episode", "title": "Recording", "url": "api/past/3.episode"},
]


@pytest.fixture
def tab(chromium: Browser) -> Iterator[TabPage]:
    tab = TabPage(chromium, "panel/past/tab", "PastTab", "past")
    tab.give(PART)
    yield tab
    tab.close()
    assert tab.errors == []


def test_a_persons_drives_stand_apart(tab: TabPage) -> None:
    drives = tab.page.locator("details").filter(has_text="Your drives")
    expect(drives.locator("article")).to_have_count(1)
    expect(drives).to_contain_text("Episode 3 · Donutwon in 14.2 s★ best")
    programs = tab.page.locator("details").filter(has_text="Networks and programs")
    expect(programs).to_contain_text("Episode 4 · Donutfell after")
    expect(tab.page.get_by_text("Finished episodes appear here.")).to_be_hidden()
    tab.give({**PART, "episodes": []})
    expect(tab.page.get_by_text("Finished episodes appear here.")).to_be_visible()
    expect(drives).to_be_hidden()


def test_what_was_driven_elsewhere_stands_apart(tab: TabPage) -> None:
    maze = {**MINE, "number": 5, "scene": "Maze", "is_here": False}
    loaded = {**maze, "number": 6, "source": "friend.episode"}
    tab.give({**PART, "episodes": [MINE, maze, loaded]})
    expect(tab.page.locator("details").filter(has_text="Your drives")).not_to_contain_text("Maze")
    files = tab.page.locator("details").filter(has_text="Opened recordings")
    expect(files.locator("article")).to_contain_text("Episode 6 · Maze")
    others = tab.page.locator("details").filter(has_text="In other scenes")
    expect(others).not_to_have_attribute("open", "")
    expect(others.locator("article")).to_have_count(1)
    expect(others).to_contain_text("Episode 5 · Maze")
    tab.give({**PART, "playing": {**PLAYING, "number": 5, "scene": "Maze", "is_here": False}})
    expect(tab.page.get_by_text("Showing episode 5 · Maze")).to_be_visible()
    # its drivers are those of another scene
    expect(tab.page.get_by_text("Compare two drivers")).to_be_hidden()


def test_a_click_on_a_row_chooses_and_shows_it(tab: TabPage) -> None:
    tab.head("Episode 3 · Donut").click()
    assert tab.shown["episode"] == 3
    assert tab.sent() == [
        {"command": "episode", "number": 3},
        {"command": "step", "step": 0},
    ]
    tab.give({**PART, "playing": PLAYING, "downloads": DOWNLOADS})
    row = tab.page.locator("article").filter(has_text="Episode 3")
    expect(row).to_contain_text("8061527393621437281")
    expect(row.get_by_role("link", name="GIF")).to_have_attribute("href", "api/past/3.gif")
    expect(row).to_have_attribute("aria-current", "true")


def test_a_click_on_the_slider_shows_the_step_where_it_stands(tab: TabPage) -> None:
    tab.give({**PART, "playing": {**PLAYING, "step": 80}, "is_showing": False})
    slider = tab.page.get_by_role("slider", name="Step")
    box = slider.bounding_box()
    assert box is not None
    slider.click(position={"x": box["width"] - 3, "y": box["height"] / 2})
    assert tab.sent() == [{"command": "step", "step": 80}]


def test_the_full_seed_is_copied(chromium: Browser) -> None:
    tab = TabPage(
        chromium,
        "panel/past/tab",
        "PastTab",
        "past",
        permissions=["clipboard-read", "clipboard-write"],
    )
    tab.page.evaluate(
        """Object.defineProperty(navigator, "clipboard",
          {value: {writeText: async (text) => (window.copied = text)}})"""
    )
    tab.give(PART)
    tab.head("Episode 3 · Donut").click()
    texts = record_texts(tab.page, "button")
    tab.page.get_by_role("button", name="Copy the seed").click()
    until_on(tab.page, lambda: "Copied" in texts())
    assert tab.page.evaluate("window.copied") == MINE["seed"]
    tab.close()


def test_one_number_tells_the_moment(tab: TabPage) -> None:
    tab.give({**PART, "playing": PLAYING})
    expect(tab.page.get_by_text("Step 12 of 80")).to_be_visible()
    expect(tab.page.get_by_text("Showing episode 3")).to_be_visible()
    slider = tab.page.get_by_role("slider", name="Step")
    expect(slider).to_have_value("11")
    expect(slider).to_have_attribute("aria-valuetext", "Step 12 of 80")
    tab.page.get_by_role("button", name="Step back").click()
    tab.page.get_by_role("button", name="Step forward").click()
    slider.fill("40")
    assert [each["step"] for each in tab.sent()] == [10, 12, 40]
    tab.give({**PART, "playing": {**PLAYING, "step": 80}})
    expect(tab.page.get_by_role("button", name="Step forward")).to_be_disabled()
    expect(tab.page.get_by_text("The end, after 80 steps")).to_be_visible()


def test_it_is_played_at_a_speed(tab: TabPage) -> None:
    tab.give({**PART, "playing": PLAYING})
    tab.page.get_by_role("button", name="Play", exact=True).click()
    tab.page.get_by_role("button", name="2x").click()
    tab.give({**PART, "playing": {**PLAYING, "is_playing": True, "speed": 2.0}})
    expect(tab.page.get_by_role("button", name="2x")).to_have_attribute("aria-pressed", "true")
    tab.page.get_by_role("button", name="Stop", exact=True).click()
    assert tab.sent() == [
        {"command": "play"},
        {"command": "play_speed", "speed": 2},
        {"command": "stop"},
    ]


def test_from_a_moment_the_world_goes_on_or_races(tab: TabPage) -> None:
    tab.give({**PART, "playing": PLAYING, "ghost": "Ghost: episode 3"})
    for name in ("Back to live", "Continue here", "Race against it", "Remove ghost"):
        tab.page.get_by_role("button", name=name).click()
    assert tab.sent() == [
        {"command": "back_to_live"},
        {"command": "continue"},
        {"command": "race"},
        {"command": "remove_ghost"},
    ]
    proceed = tab.page.get_by_role("button", name="Continue here")
    before = proceed.bounding_box()
    tab.give({**PART, "playing": PLAYING, "is_showing": False})
    expect(tab.page.get_by_role("button", name="Back to live")).to_be_disabled()
    assert proceed.bounding_box() == before
    expect(tab.page.get_by_role("button", name="Remove ghost")).to_be_hidden()


def test_the_current_episode_is_shown_and_can_not_be_raced(tab: TabPage) -> None:
    tab.page.get_by_role("button", name="Current episode").click()
    assert tab.sent() == [{"command": "episode", "number": 0}]
    tab.give({**PART, "playing": {**PLAYING, "number": 0}, "is_showing": False})
    assert tab.sent() == [{"command": "step", "step": 11}]
    tab.give({**PART, "playing": {**PLAYING, "number": 0}})
    assert tab.sent() == []
    expect(tab.page.get_by_role("button", name="Race against it")).to_be_hidden()


def test_episodes_are_pinned(tab: TabPage) -> None:
    tab.page.get_by_role("button", name="Pin episode 4").click()
    assert tab.sent() == [{"command": "pin", "number": 4, "on": True}]
    tab.give({**PART, "episodes": [MINE, {**NETWORKS, "is_pinned": True}]})
    pinned = tab.page.locator("details").filter(has_text="Pinned")
    expect(pinned.get_by_role("button", name="Unpin episode 4")).to_be_visible()
    expect(tab.page.locator("article")).to_have_count(2)


def test_a_recording_is_opened(tab: TabPage, tmp_path: Path) -> None:
    file = tmp_path / "friend.episode"
    file.write_bytes(b"\x00\x01recorded")
    tab.answer("open_recording", number=5)
    with tab.page.expect_file_chooser() as chooser:
        tab.page.get_by_role("button", name="Open a recording").click()
    chooser.value.set_files(file)
    tab.page.wait_for_function("panel.shown.episode === 5")
    (sent,) = tab.sent()
    assert sent == {
        "command": "open_recording",
        "name": "friend.episode",
        "text": "\x00\x01recorded",
    }


def test_a_recording_that_the_server_would_refuse_is_not_sent(tab: TabPage, tmp_path: Path) -> None:
    file = tmp_path / "long.episode"
    file.write_bytes(bytes(MAX_RECORDING_BYTES + 1))
    with tab.page.expect_file_chooser() as chooser:
        tab.page.get_by_role("button", name="Open a recording").click()
    chooser.value.set_files(file)
    until_on(tab.page, lambda: tab.page.evaluate("panel.notices.length"))
    (notice,) = tab.page.evaluate("panel.notices")
    assert f"at most {MAX_RECORDING_BYTES // 2**20} MB, got 16.0 MB" in notice
    assert tab.sent() == []


@pytest.mark.parametrize(("is_touch", "smallest"), [(False, 28), (True, 40)])
def test_controls_are_large_enough_and_have_names(
    chromium: Browser, is_touch: bool, smallest: float
) -> None:
    size = (390, 844)
    options: dict[str, Any] = {"has_touch": is_touch, "is_mobile": is_touch}
    tab = TabPage(chromium, "panel/past/tab", "PastTab", "past", size=size, **options)
    tab.give(PART)
    tab.head("Episode 3 · Donut").click()
    tab.give({**PART, "playing": PLAYING, "ghost": "Ghost: episode 3", "downloads": DOWNLOADS})
    assert tab.small_controls(smallest) == []
    assert tab.unnamed_controls() == []
    tab.close()


def test_what_paid_in_the_episode(tab: TabPage) -> None:
    title = tab.page.locator("summary").filter(has_text="Where the points came from")
    expect(title).to_be_hidden()
    near = {"term": "near", "amount": -0.001}
    moments = [
        {"step": 79, "terms": [{"term": "touch", "amount": 100}, near]},
        {"step": 3, "terms": [near]},
    ]
    terms = [
        {"term": "touch", "total": 100, "curve": [0, 0, 100]},
        {"term": "near", "total": 1, "curve": [0, 0.5, 1]},
    ]
    tab.answer("paid", terms=terms, moments=moments)
    tab.give({**PART, "playing": PLAYING})
    title.click()
    tab.page.get_by_role("button", name="Step 80: touch 100, near \N{MINUS SIGN}0.001").click()
    assert tab.sent()[-1] == {"command": "step", "step": 79}
    curve = tab.page.get_by_role("img", name="The sum of touch during the episode")
    expect(curve).to_be_visible()
    assert tab.unnamed_controls() == []
    tab.answer("paid", terms=[], moments=[])
    tab.give({**PART, "playing": {**PLAYING, "number": 4}})
    expect(tab.page.get_by_text("Nothing was paid in this episode.")).to_be_visible()
    expect(curve).to_have_count(0)


def test_two_drivers_on_the_episode(tab: TabPage) -> None:
    rivals = [
        {"value": "what-it-did", "text": "What I did", "steps": None},
        {"value": "network:zoo:box_chase", "text": "Network zoo:box_chase", "steps": None},
        {"value": "network:checkpoint-2.onnx", "text": "Network checkpoint-2.onnx", "steps": 2000},
        {"value": "network:checkpoint-1.onnx", "text": "Network checkpoint-1.onnx", "steps": 1000},
    ]
    tab.answer("rivals", rivals=rivals)
    turn = {"name": "turn", "low": -1, "high": 1, "has_effect": True, "now": 0.5, "then": -0.5}
    found = {"step": 11, "count": 80, "distance": [0, 0.1, 1.0], "largest": 1.0, "action": [turn]}
    reasons = {"first": "", "second": "It turns right because of ray 1."}
    tab.answer("compare", **found, **reasons)
    title = tab.page.locator("summary").filter(has_text="Compare two drivers")
    expect(title).to_be_hidden()
    tab.give({**PART, "playing": PLAYING})
    title.click()
    first, second = tab.page.get_by_label("First"), tab.page.get_by_label("Second", exact=True)
    expect(first).to_have_value("what-it-did")
    expect(second).to_have_value("network:checkpoint-1.onnx")
    second.select_option("Network zoo:box_chase")
    tab.page.get_by_role("button", name="Compare").click()
    says = tab.page.get_by_text("They first disagree at step 12 of 80.")
    expect(says).to_be_visible()
    sent = [each for each in tab.sent() if each["command"] == "compare"]
    assert sent == [
        {"command": "compare", "first": "what-it-did", "second": "network:zoo:box_chase"}
    ]
    expect(tab.page.get_by_text("It turns right because of ray 1.")).to_be_visible()
    expect(tab.page.locator(".ai4u-bar-row")).to_have_text(re.compile("^turn0.50 . .0.50$"))
    tab.page.get_by_role("button", name="Show step 12").click()
    assert tab.sent()[-1] == {"command": "step", "step": 11}
    # a slider through the checkpoints, in the order of what they learned from
    slider = tab.page.get_by_role("slider", name="The second one, after learning from")
    expect(slider).to_have_attribute("max", "1")
    tab.answer("compare", **found | {"step": None, "largest": 0.04})
    slider.press("End")
    expect(tab.page.get_by_text("They agree in all 80 steps")).to_be_visible()
    assert tab.sent()[-1]["second"] == "network:checkpoint-2.onnx"
    expect(tab.page.get_by_text("2,000 decisions")).to_be_visible()
    assert tab.unnamed_controls() == []
    tab.give({**PART, "playing": {**PLAYING, "number": 4}})
    expect(tab.page.get_by_text("They agree in all 80 steps")).to_be_hidden()
    tab.give({"can_edit": False}, "scene")
    tab.give({**PART, "playing": PLAYING})
    expect(title).to_be_hidden()


def test_a_click_counts_though_an_episode_ends_before_it_is_let_go(tab: TabPage) -> None:
    tab.head("Episode 3 · Donut").hover()
    tab.page.mouse.down()
    tab.give({**PART, "episodes": [*PART["episodes"], {**MINE, "number": 5}]})
    tab.page.mouse.up()
    until_on(tab.page, lambda: tab.shown["episode"] == 3)
    expect(tab.head("Episode 5 · Donut")).to_be_visible()


def test_an_episode_that_ends_during_a_press_appears_when_it_is_let_go_elsewhere(
    tab: TabPage,
) -> None:
    tab.head("Episode 3 · Donut").hover()
    tab.page.mouse.down()
    tab.give({**PART, "episodes": [*PART["episodes"], {**MINE, "number": 5}]})
    expect(tab.head("Episode 5 · Donut")).to_have_count(0)
    tab.page.mouse.move(0, 0)
    tab.page.mouse.up()
    expect(tab.head("Episode 5 · Donut")).to_be_visible()
    assert tab.shown["episode"] is None
