"""Makes the film of teaching for the docs: ``python -m tests.teach_film``.

The real page in Chromium: five drives by keys in box_chase, Learn, and the network drives. Pictures
are taken as fast as this machine draws them, and shown at an even pace.
"""

import argparse
import io
import math
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import Page, expect

from tests.browser.served_viser import ready
from tests.chromium import browser
from tests.playing import Played, played
from tests.screenshot import PICTURES
from tests.waiting import LIMIT_MS

WIDTH, HEIGHT = 1100, 700
SHOWN_WIDTH = 720
QUALITY = 55
FRAME_MS, LAST_MS = 140, 1500
DRIVES = 5
FRAMES_A_DRIVE = 12
"""Pictures of a drive, about; those between are left out."""
MAX_PICTURES = 150
FRAMES_OF_LEARNING, FRAMES_OF_RESULT = 8, 10
STARTS = 3
"""Starts from which the network drives."""
MAX_DRIVE_S = 120.0
SLOWLY = 0.12
"""Speed of the world, which a machine without a graphics chip can follow."""
AHEAD_RAD, NEARLY_RAD = 0.2, 0.6
"""Angles to the box below which no turn, and above which no step forward, is needed."""


class Film:
    """Pictures of a page."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self.frames: list[Image.Image] = []

    def take(self, times: int = 1) -> None:
        """Take a picture, and show it for several frames."""
        shot = Image.open(io.BytesIO(self._page.screenshot()))
        height = round(shot.height * SHOWN_WIDTH / shot.width)
        self.frames += [shot.convert("RGB").resize((SHOWN_WIDTH, height))] * times

    def shorten(self, first: int, count: int) -> None:
        """Leave out frames from the first one on, so that about as many are left."""
        taken = self.frames[first:]
        self.frames[first:] = taken[:: max(1, round(len(taken) / count))]

    def save(self, path: Path) -> None:
        """Write an animated WebP."""
        durations = [FRAME_MS] * (len(self.frames) - 1) + [LAST_MS]
        first, *others = self.frames
        first.save(
            path,
            save_all=True,
            append_images=others,
            duration=durations,
            loop=0,
            quality=QUALITY,
            method=4,
        )


def is_over(now: dict[str, Any], episode: int) -> bool:
    """Return True if an episode is over."""
    robot = now["agents"][0]
    return bool(now["episode"] != episode or robot["terminated"] or robot["truncated"])


def watch(server: Played, on_step: Callable[[], object]) -> None:
    """Take pictures until the episode is over, or until there are too many."""
    episode = server.snapshot()["episode"]
    for _ in range(MAX_PICTURES):
        on_step()
        if is_over(server.snapshot(), episode):
            break


def drive(page: Page, server: Played, on_step: Callable[[], object]) -> None:
    """Hold the keys that bring the robot to the box, until the episode is over."""
    episode, held = server.snapshot()["episode"], set[str]()
    end = time.monotonic() + MAX_DRIVE_S
    while time.monotonic() < end:
        now = server.snapshot()
        if is_over(now, episode):
            break
        poses = {body["name"]: body["pose"] for body in now["bodies"]}
        wanted = keys_to(poses["robot"], poses["box"])
        for key in held - wanted:
            page.keyboard.up(key)
        for key in wanted - held:
            page.keyboard.down(key)
        held = wanted
        on_step()
    for key in held:
        page.keyboard.up(key)


def keys_to(robot: Sequence[float], box: Sequence[float]) -> set[str]:
    """Return the keys that turn and move the robot towards the box, from their poses."""
    x, y, _, heading = robot
    angle = math.remainder(math.atan2(box[1] - y, box[0] - x) - heading, math.tau)
    keys = {"KeyA" if angle > 0 else "KeyD"} if abs(angle) > AHEAD_RAD else set()
    return keys | ({"KeyW"} if abs(angle) < NEARLY_RAD else set())


def main() -> None:
    """Take the pictures, and write the film."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=PICTURES / "teach.webp")
    options = parser.parse_args()
    scene = ("box_chase", "--seed", "1", "--time-scale", str(SLOWLY))
    with played(*scene, waits_for_key=True) as server, browser() as chromium:
        page = chromium.new_page(viewport={"width": WIDTH, "height": HEIGHT})
        page.set_default_timeout(LIMIT_MS)
        page.goto(server.url)
        ready(page)
        page.get_by_role("tab", name="Teach").click()
        tab = page.get_by_role("tabpanel", name="Teach")
        film = Film(page)
        for number in range(1, DRIVES + 1):
            before = len(film.frames)
            page.keyboard.press("Escape")
            drive(page, server, film.take)
            print(f"drive {number}: {len(film.frames) - before} pictures", flush=True)
            expect(tab.get_by_role("checkbox")).to_have_count(number, timeout=LIMIT_MS)
            film.take(3)
            film.shorten(before, FRAMES_A_DRIVE)
            page.keyboard.press("KeyN")
            page.wait_for_timeout(500)
        tab.get_by_role("button", name="Learn from").click()
        before = len(film.frames)
        curve = tab.get_by_role("img", name="The error")
        result = tab.get_by_role("status").filter(has_text="It acts like you in")
        while not result.is_visible():
            film.take()
            if curve.is_visible():
                curve.scroll_into_view_if_needed()
        film.shorten(before, FRAMES_OF_LEARNING)
        result.scroll_into_view_if_needed()
        film.take(FRAMES_OF_RESULT)
        for _ in range(STARTS):
            page.keyboard.press("KeyN")
            before = len(film.frames)
            watch(server, film.take)
            film.shorten(before, FRAMES_A_DRIVE)
            film.take(3)
        film.save(options.out)
    print(options.out, f"{options.out.stat().st_size / 1e6:.2f} MB, {len(film.frames)} frames")


if __name__ == "__main__":
    main()
