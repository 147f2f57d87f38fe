"""Takes film strips of the page, to look at: ``python -m tests.film_sheet``.

A strip shows one thing in time: the opening, a win, a fall, a network that is watched, a program,
building, and the map with twelve missions. Each is taken on a desk, a tablet and a phone, light
above dark. ``--scenes ants call`` takes those of scenes instead, which a program or a network
drives, with the panel folded away. World and page are real.

``--films missions --missions think-3 think-7 --sizes phone --schemes dark`` takes two missions on a
phone in the dark.
"""

import argparse
import io
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.missions.mission import library_missions
from tests.browser.served_viser import ready
from tests.chromium import browser
from tests.playing import Played, played
from tests.waiting import LIMIT_MS, until

FOLDER = Path(__file__).parents[1] / "build" / "films"
SIZES = {"desk": (1366, 768), "tablet": (820, 1180), "phone": (390, 844)}
SCHEMES = ("light", "dark")
ROW_PX = 560
"""Height of a picture in a strip."""
GAP_PX = 10
NEAR_SEED, FAR_SEED = "3", "1"
"""Seeds of box_chase with the box near the robot, and far from it."""
TURN_S = 0.4
"""World time (s) to turn to the left until the near box is ahead."""
TIME_SCALE = "0.4"
"""Slow enough for a machine that draws without a graphics card."""
MISSIONS = (
    *("drive-1", "drive-7", "sense-1", "sense-5", "think-1", "think-7"),
    *("code-9", "code-18", "build-1", "build-13", "teach-1", "teach-4"),
)
"""Two of each island up to Teach."""
Film = Callable[[Page], Iterable[bytes]]
SOLUTIONS = Path(__file__).parent / "program" / "solutions"
SCENES = {
    "ants": ("ant=AntController", "2"),
    "call": ("blue=zoo", "0.5"),
    "draw_figure": ("zoo", "0.3"),
    "printed_track": ("zoo", "1"),
    "endless_line": ("zoo", "1"),
    "endless_maze": ("zoo", "1"),
    "endless_rescue": (f"{SOLUTIONS / 'endless_rescue.py'}:Rescuer", "1"),
}
"""Driver and speed of time in the films of scenes."""
SCENE_MOMENTS = 8


def main() -> None:
    """Take the strips."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=FOLDER)
    parser.add_argument("--films", nargs="*", default=list(FILMS), choices=FILMS)
    parser.add_argument("--scenes", nargs="*", default=[], choices=SCENES)
    parser.add_argument("--seconds", type=float, default=56, help="of world time, for --scenes")
    parser.add_argument("--sizes", nargs="*", default=list(SIZES), choices=SIZES)
    parser.add_argument("--schemes", nargs="*", default=list(SCHEMES), choices=SCHEMES)
    parser.add_argument("--missions", nargs="*", default=list(MISSIONS), help="of that film")
    options = parser.parse_args()
    missions: tuple[Film, str] = partial(_missions, names=options.missions), FAR_SEED
    films = {**FILMS, "missions": missions}
    options.out.mkdir(parents=True, exist_ok=True)
    with browser() as chromium:
        for name in options.scenes:
            _save([_scene(chromium, name, options.seconds)], options.out / f"{name}.png")
        for name in [] if options.scenes else options.films:
            film, seed = films[name]
            for size in options.sizes:
                rows = [_take(chromium, film, seed, size, scheme) for scheme in options.schemes]
                _save(rows, options.out / f"{name}_{size}.png")


def _take(chromium: Browser, film: Film, seed: str, size: str, scheme: str) -> list[Image.Image]:
    """Return the pictures of a film; its world is its own, as it remembers drives."""
    width, height = SIZES[size]
    viewport: Any = {"width": width, "height": height}
    is_touch = size != "desk"
    context = chromium.new_context(
        viewport=viewport,
        color_scheme="dark" if scheme == "dark" else "light",
        has_touch=is_touch,
        is_mobile=is_touch,
    )
    context.set_default_timeout(LIMIT_MS)
    arguments = "--seed", seed, "--time-scale", TIME_SCALE
    with played("box_chase", *arguments, waits_for_key=True) as server:
        context.set_default_timeout(LIMIT_MS)
        page = context.new_page()
        page.goto(server.url)
        ready(page)
        pictures = [Image.open(io.BytesIO(each)).convert("RGB") for each in film(page)]
        context.close()
    return pictures


def _scene(chromium: Browser, name: str, seconds: float) -> list[Image.Image]:
    """Return pictures of a scene at equal distances of its time, until an episode is over."""
    driver, speed = SCENES[name]
    viewport: Any = {"width": 960, "height": 720}
    context = chromium.new_context(viewport=viewport)
    arguments = name, "--brain", driver, "--seed", NEAR_SEED, "--time-scale", speed
    with played(*arguments, waits_for_key=False) as server:
        context.set_default_timeout(LIMIT_MS)
        page = context.new_page()
        page.goto(server.url)
        ready(page)
        server.restart(int(NEAR_SEED))
        pictures = []
        for number in range(SCENE_MOMENTS):
            until(partial(_is_due, server, number * seconds / (SCENE_MOMENTS - 1)))
            pictures.append(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))
            if server.snapshot()["agents"][0]["terminated"]:
                break
        context.close()
    return pictures


def _is_due(server: Played, time: float) -> bool:
    """Return True once a world has that time (s), or its first agent has reached its goal."""
    snapshot = server.snapshot()
    return bool(snapshot["time"] >= time or snapshot["agents"][0]["terminated"])


def _unfold(page: Page) -> None:
    unfold = page.get_by_role("button", name="Open the panel")
    if unfold.count():
        unfold.click()


def _opening(page: Page) -> Iterable[bytes]:
    for _ in range(3):
        yield page.screenshot()
        page.wait_for_timeout(400)
    _unfold(page)
    page.wait_for_timeout(500)
    yield page.screenshot()


def _win(page: Page) -> Iterable[bytes]:
    page.keyboard.down("KeyA")
    page.wait_for_timeout(1000 * TURN_S / float(TIME_SCALE))
    page.keyboard.up("KeyA")
    page.keyboard.down("KeyW")
    page.locator(".ai4u-banner[data-kind=goal]").wait_for()
    page.keyboard.up("KeyW")
    yield page.screenshot()
    page.wait_for_timeout(600)
    yield page.screenshot()
    _unfold(page)
    page.get_by_role("tab", name="Past").click()
    page.wait_for_timeout(1500)
    yield page.screenshot()


def _fall(page: Page) -> Iterable[bytes]:
    page.keyboard.down("KeyS")
    page.locator(".ai4u-banner[data-kind=over]").wait_for()
    page.keyboard.up("KeyS")
    yield page.screenshot()
    page.wait_for_timeout(500)
    yield page.screenshot()
    page.wait_for_timeout(1500)
    yield page.screenshot()


def _watch(page: Page) -> Iterable[bytes]:
    _unfold(page)
    page.get_by_role("button", name="Watch it think").click()
    page.locator(".ai4u-banner[data-kind=thought]").wait_for()
    page.wait_for_timeout(1500)
    yield page.screenshot()
    page.locator(".ai4u-banner").get_by_role("button", name="Beat it!").wait_for()
    yield page.screenshot()
    page.locator(".ai4u-banner").get_by_role("button", name="Beat it!").click()
    page.locator(".ai4u-banner", has_text="slowed").wait_for()
    page.wait_for_timeout(1500)
    yield page.screenshot()


def _code(page: Page) -> Iterable[bytes]:
    _unfold(page)
    page.get_by_role("tab", name="Code").click()
    run = page.get_by_role("button", name="Run", exact=True)
    expect(run).to_be_enabled()
    page.wait_for_timeout(1500)
    yield page.screenshot()
    run.click()
    page.wait_for_timeout(4000)
    yield page.screenshot()


def _build(page: Page) -> Iterable[bytes]:
    _unfold(page)
    for tab in ("Build", "World"):
        page.get_by_role("tab", name=tab).click()
        page.wait_for_timeout(2500)
        yield page.screenshot()


def _missions(page: Page, names: Sequence[str] = MISSIONS) -> Iterable[bytes]:
    world = page.url
    page.goto(f"{world}start#missions")
    page.locator(".ai4u-island[open]").wait_for()
    yield page.screenshot()
    for name in names:
        kept = f'{{"mission": "{name}", "step": 0}}'
        page.evaluate("kept => (localStorage['ai4u-mission-'] = kept)", kept)
        page.request.post(f"{world}api/scene", data={"name": library_missions().get(name).scene})
        page.goto(world)
        ready(page)
        page.locator(".ai4u-mission-say").wait_for()
        page.wait_for_timeout(800)
        yield page.screenshot()


FILMS: dict[str, tuple[Film, str]] = {
    "opening": (_opening, FAR_SEED),
    "win": (_win, NEAR_SEED),
    "fall": (_fall, FAR_SEED),
    "watch": (_watch, FAR_SEED),
    "code": (_code, FAR_SEED),
    "build": (_build, FAR_SEED),
    "missions": (_missions, FAR_SEED),
}
"""The films by name, with the seed of their world."""


def _save(rows: list[list[Image.Image]], path: Path) -> None:
    """Put the rows of pictures onto one sheet."""
    scaled = [[_scaled(picture) for picture in row] for row in rows]
    width = max(sum(picture.width + GAP_PX for picture in row) for row in scaled)
    sheet = Image.new("RGB", (width, len(scaled) * (ROW_PX + GAP_PX)), "#888")
    for number, row in enumerate(scaled):
        x = 0
        for picture in row:
            sheet.paste(picture, (x, number * (ROW_PX + GAP_PX)))
            x += picture.width + GAP_PX
    sheet.save(path)
    print(path)


def _scaled(picture: Image.Image) -> Image.Image:
    share = ROW_PX / picture.height
    return picture.resize((round(picture.width * share), ROW_PX))


if __name__ == "__main__":
    main()
