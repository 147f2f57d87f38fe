"""Finished episodes on the page: look, continue from a step, race against one, export, import."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from ai4u_edu.recording import Episode, Replay
from tests.browser.keys import body, where
from tests.browser.whole import (
    Picture,
    button,
    card,
    open_tab,
    press,
    unfold,
    until_drawn,
    until_settled,
    whole_page,
)
from tests.playing import Played, played
from tests.waiting import until

pytestmark = pytest.mark.browser

MIDDLE = 5
"""A seed with which box_chase_ai4u puts the robot into the middle, looking along +x."""


@pytest.fixture
def server() -> Iterator[Played]:
    with played("box_chase_ai4u", "--seed", str(MIDDLE)) as server:
        yield server


@pytest.fixture
def page(server: Played, chromium: Browser) -> Iterator[Page]:
    """A page with an episode in its past: the robot drove ahead for a while."""
    with whole_page(chromium, server, draws=True) as page:
        page.keyboard.down("KeyW")
        until(lambda: where(server, "robot")[0] > 1)
        page.keyboard.up("KeyW")
        server.restart(MIDDLE)
        open_tab(page, "Past")
        card(page, "Episode 1").wait_for()
        yield page


def moment(page: Page) -> Locator:
    """Return the words that say which step is shown."""
    return page.get_by_role("group", name="Player").locator(".ai4u-moment")


def test_an_episode_is_shown_by_a_click_played_and_continued(server: Played, page: Page) -> None:
    unfold(page, "Episode 1")
    until(lambda: server.snapshot()["past"].startswith("episode 1, "))
    expect(moment(page)).to_contain_text("Step 1 of")
    assert (server.snapshot()["seed"], server.snapshot()["paused"]) == (MIDDLE, True)
    tick = server.snapshot()["tick"]
    press(page, "Step forward")
    until(lambda: server.snapshot()["tick"] == tick + 5)
    press(page, "Step back")
    until(lambda: server.snapshot()["tick"] == tick)
    press(page, "4x")
    press(page, "Play")
    expect(moment(page)).to_contain_text("The end, after")
    assert where(server, "robot")[0] > 1
    press(page, "Step back")
    expect(moment(page)).not_to_contain_text("The end")
    there = server.snapshot()["tick"]
    press(page, "Continue here")
    until(lambda: not server.snapshot()["past"] and server.snapshot()["tick"] > there)
    assert where(server, "robot")[0] > 0
    heading = (body(server, "robot") or [])[3]
    page.keyboard.down("KeyA")  # the keys drive again
    until(lambda: (body(server, "robot") or [])[3] > heading + 0.2)
    page.keyboard.up("KeyA")
    press(page, "Step back")
    until(lambda: server.snapshot()["past"])
    press(page, "Back to live")
    until(lambda: not server.snapshot()["past"])


def test_a_ghost_of_an_episode_drives_beside_the_robot(server: Played, page: Page) -> None:
    server.restart(MIDDLE)
    unfold(page, "Episode 1")
    press(page, "Race against it")
    expect(button(page, "Remove ghost")).to_be_visible()
    until(lambda: not server.snapshot()["past"])
    until(lambda: server.snapshot()["time"] > 3)  # there the ghost is ahead
    assert where(server, "robot")[0] == 0
    press(page, "Pause")
    until(lambda: server.snapshot()["paused"])
    expect(page.locator(".ai4u-banner")).to_contain_text("Paused")  # in the picture, too
    before = until_settled(page)
    press(page, "Remove ghost")
    expect(button(page, "Remove ghost")).to_have_count(0)
    until_drawn(page, lambda picture: bool((changed(before, picture)).any()))
    after = until_settled(page)
    rows, columns = np.nonzero(changed(before, after))
    assert 10 < np.ptp(columns) < 150  # a robot, the word above it, and nothing else
    assert 10 < np.ptp(rows) < 150


def changed(before: Picture, after: Picture) -> npt.NDArray[np.bool_]:
    """Return the pixels that differ visibly."""
    differs: npt.NDArray[np.bool_] = np.abs(before.astype(int) - after).max(axis=-1) > 24
    return differs


def test_an_episode_is_exported_and_a_recording_is_opened(
    server: Played, page: Page, tmp_path: Path
) -> None:
    card = unfold(page, "Episode 1")
    kept = []
    for title in ("Recording", "Web page"):
        with page.expect_download() as download:
            card.get_by_role("link", name=title, exact=True).click()
        kept.append(tmp_path / download.value.suggested_filename)
        download.value.save_as(kept[-1])
    recording, html = kept
    assert recording.name == f"box_chase_ai4u_{MIDDLE}.episode"
    episode = Episode.load(recording)
    assert episode.seed == MIDDLE
    assert Replay(episode).verdict.exact
    assert "Box chase" in html.read_text()
    for file in (recording, html):
        with page.expect_file_chooser() as chooser:
            press(page, "Open a recording")
        chooser.value.set_files(str(file))
        if file is recording:
            expect(page.locator("article.ai4u-card[data-open]")).to_contain_text(recording.name)
    expect(page.locator(".ai4u-notices [role=alert]")).to_contain_text(html.name)
