"""A room with a viser, and pages that look at it."""

import contextlib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

import viser
from playwright.sync_api import Browser, Locator, Page

from ai4u_edu.blocks.keyboard import CENTERED, Stick
from tests.browser.plain_page import ASKED, ROOT, PlainPage
from tests.chromium import close_page, quick_page
from tests.page.server.rooms import Room
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
        **options: Any,
    ) -> Page:
        """Open a page in a window of its own; it may ask nobody but the room for anything.

        Without viser it has our scripts and styles, a text box, a button and an empty canvas.

        Args:
            options: more of ``Browser.new_context``.
        """
        options |= {"has_touch": touch, "extra_http_headers": {} if has_viser else ASKED}
        page = quick_page(self.chromium, width, height, draws=draws, **options)
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


FRAMES = """(count) => new Promise((done) => {
    const frame = () => (count -= 1) < 0 ? done() : requestAnimationFrame(frame);
    frame();
})"""


def frames(page: Page, count: int = 2) -> None:
    """Wait until a page has drawn some frames, however long that takes."""
    page.evaluate(FRAMES, count)


RECORD_TEXTS = """(selector) => {
    const seen = ((window.seenTexts ??= {})[selector] = []);
    const look = () => {
        for (const { textContent } of document.querySelectorAll(selector)) {
            if (!seen.includes(textContent)) seen.push(textContent);
        }
    };
    new MutationObserver(look).observe(document.body,
        { childList: true, subtree: true, characterData: true });
}"""


def record_texts(page: Page, selector: str) -> Callable[[], list[str]]:
    """Record what elements say from now on; return a function that returns it.

    A text that is there for some seconds only would be gone before a busy test looks.
    """
    page.evaluate(RECORD_TEXTS, selector)
    return lambda: list(page.evaluate("(selector) => seenTexts[selector]", selector))


@contextlib.contextmanager
def recorded_holds(room: Room) -> Iterator[list[list[str]]]:
    """Record the keys of each message that holds or releases some, in their order.

    A page sends its messages in order. So a message that came after others shows that the others
    were handled, and what they asked for.
    """
    keyboard = room.sim.agents[0].keyboard
    holds: list[list[str]] = []
    hold = keyboard.hold

    def record(codes: Iterable[str], stick: Stick = CENTERED) -> None:
        codes = list(codes)
        hold(codes, stick)
        holds.append(sorted(codes))

    keyboard.hold = record  # type: ignore[method-assign]
    try:
        yield holds
    finally:
        keyboard.hold = hold  # type: ignore[method-assign]


def connected(page: Page) -> None:
    """Waits until a page is connected and shows its keys."""
    page.locator(".ai4u-dock .ai4u-driver", has_not_text="Connecting").wait_for()
    page.locator(".ai4u-keycap").first.wait_for()


def ready(page: Page) -> None:
    """Waits until a page is connected, shows its keys, and has drawn itself with them."""
    connected(page)
    frames(page)


def viser_heard(site: ServedViser, page: Page) -> None:
    """Wait until viser's server has handled all that the page's viser sent before."""
    text = site.name.value + "."
    page.get_by_role("textbox").first.fill(text)
    until(lambda: site.name.value == text)


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
