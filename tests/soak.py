"""Long play by machines: ``python -m tests.soak --minutes 60``.

Random keys, resets, two pages that come and go, a script that drives and reconnects. It fails on
any exception, in the server or in a page, and when the server's memory still grows after the first
fifth: by more than five per cent, or, in a run of half an hour or more, by more than 5 MB an hour.
"""

import argparse
import json
import random
import statistics
import sys
import threading
import time
from collections.abc import Sequence
from contextlib import ExitStack, suppress

import psutil
from playwright.sync_api import Browser, Page
from websockets.sync.client import ClientConnection
from websockets.sync.client import connect as open_socket
from websockets.typing import Origin

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.remote import RemoteError, connect
from tests.attacks.panel import Panel
from tests.chromium import browser
from tests.playing import Played, played

KEYS = ["KeyW", "KeyS", "KeyA", "KeyD", "Space", "KeyJ", "ArrowUp", "ArrowLeft"]
GROWTH = 1.05
GROWTH_MB_PER_H = 5.0
SLOPE_AFTER_MIN = 30.0
"""Shorter runs (minutes) are too noisy for a growth per hour."""


class Player:
    """One page that comes, plays and goes."""

    def __init__(self, chromium: Browser, url: str, rng: random.Random) -> None:
        self._chromium, self._url, self._rng = chromium, url, rng
        self.page: Page | None = None
        self.errors: list[str] = []
        self.visits = 0

    def act(self) -> None:
        """Does something random for about half a second."""
        if self.page is None:
            self._come()
        elif self._rng.random() < 0.02:
            self.page.context.close()
            self.page = None
        else:
            self._press(self.page)

    def _come(self) -> None:
        self.page = self._chromium.new_page(viewport={"width": 900, "height": 600})
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.goto(self._url)
        self.visits += 1

    def _press(self, page: Page) -> None:
        keys = self._rng.sample(KEYS, self._rng.randint(1, 3))
        for key in keys:
            page.keyboard.down(key)
        page.wait_for_timeout(self._rng.uniform(50, 600))
        for key in keys:
            page.keyboard.up(key)
        if self._rng.random() < 0.2:
            page.keyboard.press("KeyR")


class LightPlayer:
    """A page without a browser: the sockets of one, which come, play and go."""

    def __init__(self, url: str, rng: random.Random) -> None:
        self._url, self._rng = url, rng
        self._page: tuple[Panel, ClientConnection] | None = None
        self.errors: list[str] = []
        self.visits = 0

    def act(self) -> None:
        """Do something random for about half a second."""
        if self._page is None:
            origin = Origin(self._url.rstrip("/"))
            url = self._url.replace("http", "ws", 1) + "ws/input"
            self._page = Panel(self._url), open_socket(url, origin=origin, proxy=None)
            self.visits += 1
            return
        panel, keys = self._page
        if self._rng.random() < 0.02 or not panel.is_open:
            panel.close()
            keys.close()
            self._page = None
            return
        held = self._rng.sample(KEYS, self._rng.randint(1, 3))
        for _ in range(5):  # a page says again what it holds
            keys.send(json.dumps({"type": "keys", "held": held}))
            self._read(keys, until=time.monotonic() + 0.1)
        keys.send(json.dumps({"type": "keys", "held": []}))
        if self._rng.random() < 0.2:
            keys.send(json.dumps({"type": "do", "id": 0, "command": "reset"}))

    def _read(self, keys: ClientConnection, until: float) -> None:
        """Read what the server says, as a page does: who reads nothing gets no pings either."""
        with suppress(TimeoutError):
            while True:
                keys.recv(max(0.0, until - time.monotonic()))


class Script:
    """A remote script that drives for some seconds, leaves, and connects again."""

    def __init__(self, url: str, rng: random.Random) -> None:
        self._url, self._rng = url, rng
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self.connections = 0

    def __enter__(self) -> "Script":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._thread.join(10)

    def _run(self) -> None:
        while not self._over.wait(self._rng.uniform(0.5, 5.0)):
            try:
                self._drive(self._rng.uniform(0.5, 5.0))
            except RemoteError:  # refused while a page drives
                continue

    def _drive(self, seconds: float) -> None:
        with connect(self._url, agent="0") as robot:
            self.connections += 1
            robot.reset()
            end = time.monotonic() + seconds
            while time.monotonic() < end and not self._over.is_set():
                try:
                    robot.act(move=[1, self._rng.uniform(-1, 1), 0, 0])
                    robot.sense()
                except RemoteError:
                    raise
                except AI4UError:  # the episode is over
                    robot.reset()


def soak(minutes: float, scene: str, seed: int, *, light: bool) -> list[str]:
    """Plays and looks; what went wrong, in sentences."""
    rng = random.Random(seed)
    memory: list[tuple[float, int]] = []  # (seconds, bytes)
    wrong: list[str] = []
    players: list[Player | LightPlayer]
    with ExitStack() as ending:
        server = ending.enter_context(played(scene, "--no-autosave"))
        script = ending.enter_context(Script(server.url, random.Random(seed + 1)))
        if light:
            players = [LightPlayer(server.url, rng) for _ in range(2)]
        else:
            chromium = ending.enter_context(browser())
            players = [Player(chromium, server.url, rng) for _ in range(2)]
        process = psutil.Process(server.process.pid)
        began = time.monotonic()
        told = 0.0
        episodes = 0
        while (elapsed := time.monotonic() - began) < minutes * 60:
            rng.choice(players).act()
            memory.append((elapsed, process.memory_info().rss))
            snapshot = server.snapshot()
            episodes = max(episodes, snapshot["episode"])
            if snapshot["error"]:
                wrong.append(f"the world stopped: {snapshot['error']}")
                break
            if elapsed - told > 60:
                told = elapsed
                print(f"{elapsed / 60:5.1f} min  {memory[-1][1] / 1e6:6.1f} MB", flush=True)
        wrong += _judge(server, players, memory)
        visits = sum(player.visits for player in players)
        print(
            f"{elapsed / 60:.1f} minutes, {episodes} episodes, {visits} visits of a page, "
            f"{script.connections} connections of a script"
        )
    return wrong


def _judge(
    server: Played, players: Sequence[Player | LightPlayer], memory: list[tuple[float, int]]
) -> list[str]:
    wrong = [f"a page raised: {error}" for player in players for error in player.errors]
    if any("Traceback" in line for line in server.told):
        wrong.append("the server raised:\n" + "".join(server.told))
    later = memory[len(memory) // 5 :]
    quarter = max(1, len(later) // 4)
    before = statistics.median(size for _, size in later[:quarter])
    after = statistics.median(size for _, size in later[-quarter:])
    slope = statistics.linear_regression(*zip(*later, strict=True)).slope * 3600 / 1e6
    print(
        f"memory {before / 1e6:.1f} -> {after / 1e6:.1f} MB ({after / before - 1:+.1%}), "
        f"{slope:+.1f} MB/h"
    )
    if after > before * GROWTH:
        wrong.append(f"memory grew by {after / before - 1:.1%}; expected at most 5%")
    if memory[-1][0] > SLOPE_AFTER_MIN * 60 and slope > GROWTH_MB_PER_H:
        wrong.append(f"memory grew by {slope:.1f} MB/h; expected at most {GROWTH_MB_PER_H:g}")
    return wrong


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--scene", default="box_chase")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--light", action="store_true", help="pages without a browser, which take no processor"
    )
    options = parser.parse_args()
    wrong = soak(options.minutes, options.scene, options.seed, light=options.light)
    print("\n".join(wrong) or "nothing went wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
