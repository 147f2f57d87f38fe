"""Chromium without a window or a graphics card."""

import contextlib
import json
import os
from collections import defaultdict, deque
from collections.abc import Callable, Iterator
from typing import Any
from urllib.parse import urljoin

from playwright.sync_api import Browser, BrowserContext, Page, expect, sync_playwright

from tests import evidence, setup_browser
from tests.waiting import LIMIT_MS, until

DISABLED = [
    # newer ones guard this machine against foreign pages; here it is we who have to
    "LocalNetworkAccessChecks",
    "LocalNetworkAccessChecksWebSockets",
    # an address bar's menu, made in two processes for each context, which took most of its time
    "WebUIOmniboxPopup",
    "WebUIOmniboxAimPopup",
]
"""Features of Chromium that tests do without."""
FLAGS = [
    "--no-sandbox",
    # viser draws with WebGL; there may be no graphics card here
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    # With a software graphics card, Chromium would also paint and compose its pages there, which
    # takes two to three times the work of what it does without a card.
    "--disable-gpu-compositing",
    "--disable-gpu-rasterization",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    f"--disable-features={','.join(DISABLED)}",
]

CONSOLE_LINES = 200
SCREENSHOT_MS = 30_000

DRAW_NOTHING = """
for (const kind of [self.WebGLRenderingContext, self.WebGL2RenderingContext]) {
    for (const name of Object.getOwnPropertyNames(kind?.prototype ?? {})) {
        const draws = /^(draw(Arrays|Elements|Range)|clear$|blit)/.test(name);
        if (draws) kind.prototype[name] = () => {};
    }
}
"""
"""Page script that turns WebGL's drawing calls into no-ops; all of viser's code still runs.
Without a graphics card, drawing takes most of a page's time."""


WAIT_FOR_SERVER = f"""
addEventListener("DOMContentLoaded", async () => {{
    const addresses = [...document.scripts].map((each) => each.type === "module" && each.src);
    const folder = /^.*[/]web(-[^/]*)?[/]/.exec(addresses.find(Boolean))?.[0];
    if (!folder) return;
    const {{ limits }} = await import(folder + "shared/limits.js");
    limits.silenceMs = limits.openMs = {LIMIT_MS};
}});
"""
"""Page script with which a page takes no connection for lost, however busy this machine is."""


@contextlib.contextmanager
def browser() -> Iterator[Browser]:
    """Headless Chromium."""
    path = os.environ.get("AI4U_CHROMIUM") or setup_browser.on_path()
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield chromium
        chromium.close()


expect.set_options(timeout=LIMIT_MS)


def new_page(
    chromium: Browser,
    width: int = 1280,
    height: int = 800,
    *,
    draws: bool = False,
    gives_up: bool = False,
    **options: Any,
) -> Page:
    """Return a page in a context of its own, which the caller closes.

    Args:
        draws: WebGL draws the world; only for tests that look at the picture.
        gives_up: a silent connection is lost after the page's own time limit.
        options: more of ``Browser.new_context``.
    """
    context = chromium.new_context(viewport={"width": width, "height": height}, **options)
    context.set_default_timeout(LIMIT_MS)
    if not gives_up:
        context.add_init_script(WAIT_FOR_SERVER)
    if not draws:
        context.add_init_script(DRAW_NOTHING)
    context.on("page", _watch)
    return context.new_page()


def _watch(page: Page) -> None:
    _PageWitness(page)  # its page's handlers keep it


class _PageWitness:
    """Picture and console of a page, for a test that fails while it is open."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self._console: deque[str] = deque(maxlen=CONSOLE_LINES)
        page.on("console", lambda line: self._console.append(f"{line.type}: {line.text}"))
        page.on("pageerror", lambda error: self._console.append(f"error: {error}"))
        page.on("requestfailed", lambda request: self._console.append(f"failed: {request.url}"))
        evidence.register(self)

    def testify(self) -> dict[str, str | bytes]:
        console = "\n".join([self._page.url, *self._console])
        if self._page.is_closed():
            return {"page.txt": f"(closed) {console}"}
        picture = self._page.screenshot(timeout=SCREENSHOT_MS)
        return {"page.txt": console, "page.png": picture}


def until_on(page: Page, condition: Callable[[], object]) -> None:
    """Wait for a condition to become true while Playwright handles a page's events."""
    # real time: between two looks at the condition
    until(condition, lambda seconds: page.wait_for_timeout(1000 * seconds))


_Kind = tuple[Browser, str]
"""Browser of contexts, and their options."""
_idle: defaultdict[_Kind, list[BrowserContext]] = defaultdict(list)
_kinds: dict[BrowserContext, _Kind] = {}


def quick_page(
    chromium: Browser, width: int = 1280, height: int = 800, *, draws: bool = False, **options: Any
) -> Page:
    """Return a page in a context that has our files already; :func:`close_page` closes it.

    To ask for some sixty files takes most of a page's time. Nothing else is left of the pages that
    were in the context before: tests that change the context itself, as those with a clock do,
    take :func:`new_page`.
    """
    kind = chromium, json.dumps(options | {"draws": draws})
    if _idle[kind]:
        page = _idle[kind].pop().new_page()
        page.set_viewport_size({"width": width, "height": height})
    else:
        page = new_page(chromium, width, height, draws=draws, **options)
        _kinds[page.context] = kind
    return page


def close_page(page: Page) -> None:
    """Close a page and forget what it stored, or close its context if nobody else gets that."""
    context = page.context
    if context not in _kinds or page.is_closed():
        context.close()
        return
    origin = urljoin(page.url, "/").rstrip("/")
    if origin.startswith("http"):
        for each in context.pages:  # what comes late is not stored for the next test
            each.evaluate("Storage.prototype.setItem = () => {}")
        session = context.new_cdp_session(page)
        what = {"origin": origin, "storageTypes": "local_storage,indexeddb"}
        session.send("Storage.clearDataForOrigin", what)
    for each in context.pages:
        each.close()
    context.clear_cookies()
    _idle[_kinds[context]].append(context)
