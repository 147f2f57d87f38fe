"""Takes contact sheets of the page, to look at: ``python -m tests.page_sheet --out DIR``.

One sheet for each scene: all sizes, light above dark. One for each tab: all sizes, simple above
details.
"""

import argparse
import io
from collections.abc import Iterable
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser, Page

from tests.chromium import browser
from tests.playing import Played, played
from tests.screenshot import TABS

SIZES = ((1280, 720), (1920, 1080), (820, 1180), (844, 390), (390, 844))
SCENES = ("box_chase", "sumo", "soccer", "parking", "line_follow", "forage", "grid_world")
TOUCH_BELOW_PX = 1000
"""Windows that are narrower are touch screens."""
ROW_PX = 620
"""Height of a row of a sheet."""
GAP_PX = 12
SETTLE_MS = 1500
"""Time for the page to settle after a change; it draws a few frames a second here."""


def main() -> None:
    """Take the sheets of all scenes, then those of all tabs."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--scenes", nargs="*", default=list(SCENES))
    parser.add_argument("--tabs", nargs="*", default=list(TABS), choices=TABS)
    parser.add_argument("--tab-scene", default="box_chase", help="scene of the tabs' sheets")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    with browser() as chromium:
        for scene in options.scenes:
            with played(scene, "--seed", "1", waits_for_key=True) as server:
                rows = [_shots(chromium, server, scheme) for scheme in ("light", "dark")]
            _save(rows, options.out / f"{scene}.png")
        if options.tabs:
            with played(options.tab_scene, "--seed", "1") as server:
                for tab in options.tabs:
                    rows = [
                        _shots(chromium, server, "light", tab=tab, details=details)
                        for details in (False, True)
                    ]
                    _save(rows, options.out / f"tab_{tab.lower()}.png")


def _shots(
    chromium: Browser, server: Played, scheme: str, *, tab: str = "", details: bool = False
) -> list[Image.Image]:
    """Return pictures of the page in all sizes, of a tab if one is given."""
    shots = []
    for is_touch in (False, True):
        sizes = [size for size in SIZES if (size[0] < TOUCH_BELOW_PX) == is_touch]
        page = chromium.new_page(
            viewport={"width": sizes[0][0], "height": sizes[0][1]},
            color_scheme="dark" if scheme == "dark" else "light",
            has_touch=is_touch,
            is_mobile=is_touch,
        )
        page.goto(server.url)
        page.locator("html[data-ai4u-layout]").wait_for()
        page.locator("canvas[data-engine]").wait_for()
        page.wait_for_timeout(3 * SETTLE_MS)
        for width, height in sizes:
            page.set_viewport_size({"width": width, "height": height})
            page.wait_for_timeout(SETTLE_MS)
            if tab:
                _show_tab(page, tab, details=details)
            shots.append(_shot(page))
        page.context.close()
    return shots


def _show_tab(page: Page, tab: str, *, details: bool) -> None:
    """Open the panel and a tab, with its first card."""
    unfold = page.get_by_role("button", name="Open the panel")
    if unfold.count():
        unfold.click()
    page.get_by_role("button", name="Details" if details else "Simple", exact=True).click()
    page.get_by_role("tab", name=tab).click()
    page.wait_for_timeout(SETTLE_MS)
    folded = page.locator(".ai4u-tabpanel:visible .ai4u-card-head[aria-expanded=false]")
    opened = page.locator(".ai4u-tabpanel:visible .ai4u-card-head[aria-expanded=true]")
    if folded.count() and not opened.count():
        folded.first.click()
        page.wait_for_timeout(SETTLE_MS)


def _shot(page: Page) -> Image.Image:
    return Image.open(io.BytesIO(page.screenshot())).convert("RGB")


def _save(rows: Iterable[list[Image.Image]], path: Path) -> None:
    """Put rows of pictures onto one sheet, scaled down to one height where they are higher."""
    scaled = [[_scaled(each) for each in row] for row in rows]
    width = max(sum(each.width + GAP_PX for each in row) for row in scaled)
    sheet = Image.new("RGB", (width, len(scaled) * (ROW_PX + GAP_PX)), "#888")
    for number, row in enumerate(scaled):
        x = 0
        for each in row:
            sheet.paste(each, (x, number * (ROW_PX + GAP_PX)))
            x += each.width + GAP_PX
    sheet.save(path)
    print(path)


def _scaled(image: Image.Image) -> Image.Image:
    share = min(1.0, ROW_PX / image.height)
    return image.resize((round(image.width * share), round(image.height * share)))


if __name__ == "__main__":
    main()
