"""A room with a viser, and pages that look at it."""

from collections.abc import Callable
from dataclasses import dataclass, field

import viser
from playwright.sync_api import Browser, Locator, Page

from tests.browser.plain_page import ASKED, ROOT, PlainPage
from tests.chromium import close_page, quick_page
from tests.server.rooms import Room
from tests.waiting import until

SPEED, TURN = 5.0, 2.0
"""Speeds that W and D ask for in these tests (m/s, rad/s)."""

PLAIN = PlainPage(
    f"""{ROOT}
<canvas style="position: fixed; inset: 0; z-index: -1"></canvas>
<label>Name <input></label>
<button onclick="this.dataset.clicks = 1 + Number(this.dataset.clicks ?? 0)">Press me</button>
"""
)


@dataclass
class ServedViser:
    """A room with a viser, and pages that look at it."""

    room: Room
    inner: viser.ViserServer
    name: viser.GuiInputHandle[str]
    clicks: list[str]
    chromium: Browser
    pages: list[Page] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)

    def page(
        self,
        query: str = "",
        *,
        has_viser: bool = False,
        draws: bool = False,
        width: int = 800,
        height: int = 600,
        touch: bool = False,
        prepare: Callable[[Page], object] = lambda page: None,
        wait: bool = True,
    ) -> Page:
        """Open a page in a window of its own; it may ask nobody but the room for anything.

        Without viser it has our scripts and styles, a text box, a button and an empty canvas.
        """
        headers = {} if has_viser else ASKED
        page = quick_page(
            self.chromium, width, height, draws=draws, has_touch=touch, extra_http_headers=headers
        )
        self.pages.append(page)
        page.on("pageerror", lambda error: self.complaints.append(f"error: {error}"))
        page.on("request", lambda request: self._check(request.url))
        page.on("websocket", lambda socket: self._check(socket.url))
        prepare(page)
        page.goto(self.room.url + query)
        if wait:
            page.get_by_text("Name", exact=True).wait_for(state="attached")
            (ready if has_viser else connected)(page)
        return page

    def close(self, *pages: Page) -> None:
        """Close some pages."""
        for page in pages:
            self.pages.remove(page)
            close_page(page)

    def pose(self) -> tuple[float, float, float, int]:
        """The robot's x, y and heading, and the tick at which it had them."""
        latest = self.room.runner.latest
        robot = latest.bodies[0]
        return robot.x, robot.y, robot.heading, latest.tick

    def camera(self) -> tuple[float, ...]:
        """Return position and orientation of the only page's camera."""
        until(lambda: len(self.inner.get_clients()) == 1)
        (client,) = self.inner.get_clients().values()
        return (*client.camera.position.tolist(), *client.camera.wxyz.tolist())

    def _check(self, url: str) -> None:
        if not url.startswith((*self._places(), "blob:", "data:")):
            self.complaints.append(f"asked elsewhere: {url}")

    def _places(self) -> tuple[str, str]:
        place = self.room.url.rstrip("/")
        return place, place.replace("http", "ws", 1)


CALM = """() => new Promise((done) => {
    let calm = 0, last = performance.now();
    const frame = (now) => {
        calm = now - last < 50 ? calm + 1 : 0;
        last = now;
        if (calm < 10) requestAnimationFrame(frame);
        else done();
    };
    requestAnimationFrame(frame);
})"""


def connected(page: Page) -> None:
    """Waits until a page is connected and shows its keys."""
    page.locator(".ai4u-dock .ai4u-driver", has_not_text="Connecting").wait_for()
    page.locator(".ai4u-keycap").first.wait_for()


def ready(page: Page) -> None:
    """Waits until a page is connected, shows its keys, and has done its first, heavy drawing."""
    connected(page)
    page.evaluate(CALM)


def hide_panel(page: Page) -> None:
    """Hide viser's own panel, as on pages that have ours."""
    page.evaluate("document.documentElement.dataset.ai4uPanel = 'folded'")


def driver_status(page: Page) -> Locator:
    """Return the element in which a page says who drives."""
    return page.locator(".ai4u-dock .ai4u-driver [role=status]")


def centre(thing: Locator) -> tuple[float, float]:
    """Return the middle of an element on its page."""
    box = thing.bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
