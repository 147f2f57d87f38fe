"""A served scene in a process of its own, and a browser to look at it; for scripts."""

import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from playwright.sync_api import Browser, Page, sync_playwright
from websockets.sync.client import connect
from websockets.typing import Origin

FLAGS = [
    "--no-sandbox",
    # viser draws with WebGL; there may be no graphics card here
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    # Debian's has a graphics card paint all text and buttons, even one that is software: twice the
    # work of what a browser without a card does by itself
    "--disable-gpu-rasterization",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    # newer ones guard this machine against foreign pages; here it is we who have to
    "--disable-features=LocalNetworkAccessChecks,LocalNetworkAccessChecksWebSockets",
]

DRAW_NOTHING = """
for (const kind of [self.WebGLRenderingContext, self.WebGL2RenderingContext]) {
    for (const name of Object.getOwnPropertyNames(kind?.prototype ?? {})) {
        const draws = /^(draw(Arrays|Elements|Range)|clear$|blit)/.test(name);
        if (draws) kind.prototype[name] = () => {};
    }
}
"""
"""For a page whose picture of the world nobody looks at: viser's code runs, WebGL draws nothing.
Without a graphics card, to draw takes most of a page's time."""


@dataclass
class Played:
    """A running ``ai4u-edu play``."""

    process: subprocess.Popen[str]
    url: str
    told: list[str] = field(default_factory=list)
    """Every line that it wrote."""

    def snapshot(self) -> dict[str, Any]:
        """What ``/api/snapshot`` answers."""
        return self._get("api/snapshot")

    def health(self) -> dict[str, Any]:
        """What ``/healthz`` answers, whatever its status."""
        return self._get("healthz")

    def restart(self, seed: int) -> None:
        """Begin a new episode of the scene, and let the world run."""
        episode = self.snapshot()["episode"]
        url = self.url.replace("http", "ws", 1) + "ws/input"
        with connect(url, origin=Origin(self.url.rstrip("/")), proxy=None) as page:
            page.send(json.dumps({"type": "command", "name": "resume"}))
            page.send(json.dumps({"type": "command", "name": "reset", "seed": seed}))
            deadline = time.monotonic() + 20
            while (now := self.snapshot())["episode"] == episode or now["paused"]:
                assert time.monotonic() < deadline, f"no new episode: {now}"
                time.sleep(0.02)

    def _get(self, path: str) -> dict[str, Any]:
        try:
            answer = urllib.request.urlopen(f"{self.url}{path}", timeout=5)  # noqa: S310  # our own
        except urllib.error.HTTPError as error:
            answer = error
        with answer:
            found: dict[str, Any] = json.load(answer)
            return found


@contextlib.contextmanager
def played(*args: str) -> Iterator[Played]:
    """Serves a scene: ``played("box_chase", "--seed", "1")``."""
    command = [sys.executable, "-m", "ai4u_edu", "play", *args, "--port", "0", "--no-open"]
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1
    )
    told: list[str] = []

    def listen() -> None:
        with process:  # closes its output, and waits for its end
            told.extend(process.stdout or ())  # line by line, as they come

    listener = threading.Thread(target=listen)
    listener.start()
    try:
        yield Played(process, _url(process, told), told)
    finally:
        process.terminate()
        listener.join(10)


def _url(process: subprocess.Popen[str], told: list[str]) -> str:
    deadline = time.monotonic() + 90
    while time.monotonic() < deadline and process.poll() is None:
        found = re.search(r"http://\S+", "".join(told))
        if found:
            return found[0].rstrip("/") + "/"
        time.sleep(0.05)
    raise RuntimeError("the scene was not served: " + "".join(told))


@contextlib.contextmanager
def browser() -> Iterator[Browser]:
    """Headless Chromium."""
    path = os.environ.get("AI4U_CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield chromium
        chromium.close()


def new_page(
    chromium: Browser, width: int = 1280, height: int = 800, *, draws: bool = False, **options: Any
) -> Page:
    """Return a page in a context of its own, which the caller closes.

    Args:
        draws: WebGL draws the world; only for tests that look at the picture.
        options: more of ``Browser.new_context``.
    """
    context = chromium.new_context(viewport={"width": width, "height": height}, **options)
    if not draws:
        context.add_init_script(DRAW_NOTHING)
    return context.new_page()
