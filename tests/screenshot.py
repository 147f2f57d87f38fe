"""Takes the README's screenshot of the page: ``python -m tests.screenshot``."""

import argparse
import re
from pathlib import Path

from playwright.sync_api import Page

from tests.chromium import browser
from tests.playing import played

PICTURES = Path(__file__).parent / "pictures"


def main() -> None:
    """Drive a little, and take a screenshot while W and D are held."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scene", default="sample_scene")
    parser.add_argument("--size", default="1280x800")
    parser.add_argument("--out", type=Path, default=PICTURES / "page.png")
    parser.add_argument("--dark", action="store_true")
    parser.add_argument("--tab", default="Agent", help="Agent, Blocks, World or Past")
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    with played(options.scene, "--seed", "1") as server, browser() as chromium:
        page = chromium.new_page(
            viewport={"width": width, "height": height},
            color_scheme="dark" if options.dark else "light",
        )
        page.goto(server.url)
        page.wait_for_timeout(6000)
        for notice in page.locator(".mantine-Notification-closeButton").all():
            # viser warns about the missing graphics card; by script, as a banner may cover it
            notice.evaluate("button => button.click()")
        page.keyboard.down("KeyW")
        page.wait_for_timeout(500)
        page.keyboard.down("KeyD")
        page.wait_for_timeout(300)
        if options.tab != "Agent":
            open_tab(page, options.tab)
        page.wait_for_timeout(700)
        options.out.parent.mkdir(exist_ok=True)
        page.screenshot(path=options.out)
    print(options.out)


def open_tab(page: Page, tab: str) -> None:
    """Open one of the lower tabs, and choose its first entry; in Past, an earlier decision."""
    for code in ("KeyW", "KeyD"):
        page.keyboard.up(code)
    if tab == "Past":
        page.keyboard.press("KeyR")  # ends the episode, so that one is recorded
        page.wait_for_timeout(500)
    if page.viewport_size and page.viewport_size["width"] <= 576:
        open_mobile_panel(page, tab)
    else:
        page.get_by_role("tab", name=tab).click()
    page.wait_for_timeout(2000)
    page.locator(".mantine-Select-input:visible").last.click()
    # the first option is a prompt; in Past, the second one is the running episode
    page.get_by_role("option").nth(2 if tab == "Past" else 1).click()
    page.wait_for_timeout(2000)
    if tab == "Past":
        for _ in range(12):
            page.get_by_role("button", name="Step back").click()
        page.wait_for_timeout(2000)


def open_mobile_panel(page: Page, tab: str) -> None:
    """Expand the panel, which small screens have collapsed at the bottom, and open a tab."""
    page.locator('#root .mantine-Paper-root div[style*="pointer"]').first.click()
    page.wait_for_timeout(1000)
    page.get_by_text(re.compile("^Agent( ·|$)")).click()
    page.wait_for_timeout(1000)
    page.get_by_role("tab", name=tab).click()
    page.wait_for_timeout(500)
    page.get_by_role("tab", name=tab).evaluate("tab => tab.scrollIntoView()")


if __name__ == "__main__":
    main()
