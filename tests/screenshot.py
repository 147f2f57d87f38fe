"""Takes the README's screenshot of the page: ``python -m tests.screenshot``."""

import argparse
from pathlib import Path

from playwright.sync_api import Page

from tests.chromium import browser
from tests.playing import played

PICTURES = Path(__file__).parent / "pictures"


TABS = ("Drive", "Build", "World", "Past")


def main() -> None:
    """Drive a little, and take a screenshot while W and D are held."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scene", default="sample_scene")
    parser.add_argument("--size", default="1280x800")
    parser.add_argument("--out", type=Path, default=PICTURES / "page.png")
    parser.add_argument("--dark", action="store_true")
    parser.add_argument("--tab", default="Drive", choices=TABS)
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    with played(options.scene, "--seed", "1") as server, browser() as chromium:
        page = chromium.new_page(
            viewport={"width": width, "height": height},
            color_scheme="dark" if options.dark else "light",
        )
        page.goto(server.url)
        page.wait_for_timeout(6000)
        page.keyboard.down("KeyW")
        page.wait_for_timeout(500)
        page.keyboard.down("KeyD")
        page.wait_for_timeout(300)
        if options.tab != "Drive":
            open_tab(page, options.tab)
        page.wait_for_timeout(700)
        options.out.parent.mkdir(exist_ok=True)
        page.screenshot(path=options.out)
    print(options.out)


def open_tab(page: Page, tab: str) -> None:
    """Open a tab, and choose its first entry; in Past, an earlier decision."""
    for code in ("KeyW", "KeyD"):
        page.keyboard.up(code)
    if tab == "Past":
        page.keyboard.press("KeyR")  # ends the episode, so that one is recorded
        page.wait_for_timeout(500)
    unfold = page.get_by_role("button", name="Open the panel")  # phones have it folded
    if unfold.count():
        unfold.click()
    page.get_by_role("tab", name=tab).click()
    page.locator(".ai4u-tabpanel:visible .ai4u-card-head").first.click()
    page.wait_for_timeout(2000)
    if tab == "Past":
        for _ in range(12):
            page.get_by_role("button", name="Step forward").click()
        page.wait_for_timeout(2000)


if __name__ == "__main__":
    main()
