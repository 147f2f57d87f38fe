"""A page with the panel, whose socket is fake; viser is left out."""

import contextlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from playwright.sync_api import Browser, Locator, Page
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Mount, Route
from starlette.types import ASGIApp, Receive, Scope, Send

from ai4u_edu import CircleShape, RBMoveActuator, WASDRBMoveController, World
from tests.browser.fake_panel import FakePanel
from tests.browser.plain_page import ASKED, ROOT, PlainPage
from tests.browser.served_viser import connected
from tests.builders import small_sim
from tests.chromium import close_page, quick_page, until_on
from tests.page.server.rooms import Room, served

CANVAS = PlainPage(
    f"""{ROOT}
<div data-dock-root style="position: relative; width: 100%; height: 100%">
<div style="position: absolute"><canvas style="width: 100%; height: 100%"></canvas></div></div>
"""
)


@dataclass
class PanelPage:
    """A page with the panel.

    Attributes:
        problems: errors of the page's scripts.
    """

    page: Page
    panel: FakePanel
    problems: list[str]
    url: str

    def button(self, name: str) -> Locator:
        """Return a button of the panel."""
        return self.page.locator(".ai4u-panel").get_by_role("button", name=name, exact=True)

    def tab(self, name: str) -> Locator:
        return self.page.get_by_role("tab", name=name)

    def reset(self) -> None:
        """Load the page again with the parts of the file and nothing remembered."""
        self.panel.reset()
        # the page may be about to store something
        self.page.evaluate("Storage.prototype.setItem = () => {}; localStorage.clear()")
        self.page.goto(self.url)
        self.wait()

    def wait(self) -> None:
        """Wait until the panel is connected."""
        connected(self.page)
        self.until(lambda: self.panel.received)

    def until(self, condition: Callable[[], object]) -> None:
        """Wait for a condition while the fake socket works, which Playwright's loop serves."""
        until_on(self.page, condition)


@contextlib.contextmanager
def panel_room() -> Iterator[Room]:
    """Serve a room with a robot that keys drive."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    sim = small_sim(
        world=world,
        controller=WASDRBMoveController(),
        actuators=[RBMoveActuator(move_amount=5, turn_amount=2, jump_power=4)],
    )
    with served(sim, panel=_no_panel, wrap=_with_scene) as room:
        yield room


def _with_scene(app: ASGIApp) -> ASGIApp:
    """Return a room's app with an answer of its own about the scene."""

    async def scene(_: Request) -> Response:
        return JSONResponse({"is_changed": False, "is_autosaved": False})

    return CANVAS.app(Starlette(routes=[Route("/api/scene", scene), Mount("/", app)]))


async def _no_panel(scope: Scope, receive: Receive, send: Send) -> None:
    """Stand for the panel's socket, which the browser replaces by a fake."""


@contextlib.contextmanager
def panel_page(
    chromium: Browser,
    room: Room,
    *,
    query: str = "",
    width: int = 1280,
    height: int = 720,
    **options: Any,
) -> Iterator[PanelPage]:
    """Open a page with the panel.

    Args:
        options: more of ``Browser.new_context``.
    """
    page = quick_page(chromium, width, height, extra_http_headers=ASKED, **options)
    opened = PanelPage(page, FakePanel(), [], room.url + query)
    page.on("pageerror", lambda error: opened.problems.append(error.stack or str(error)))
    opened.panel.attach(page)
    page.goto(opened.url)
    opened.wait()
    yield opened
    close_page(page)
    assert opened.problems == [], opened.problems
