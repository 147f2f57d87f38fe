"""Long play by a script: ``python -m tests.soak --minutes 30``.

Random keys, resets, two pages that come and go. It fails on any exception, in the server or in a
page, and when the server's memory grows by more than five per cent after the first fifth.
"""

import argparse
import random
import statistics
import sys
import time

import psutil
from playwright.sync_api import Browser, Page

from tests.playing import Played, browser, played

KEYS = ["KeyW", "KeyS", "KeyA", "KeyD", "Space", "KeyJ", "ArrowUp", "ArrowLeft"]
GROWTH = 1.05


class Player:
    """One page that comes, plays and goes."""

    def __init__(self, chromium: Browser, url: str, chance: random.Random) -> None:
        self._chromium, self._url, self._chance = chromium, url, chance
        self.page: Page | None = None
        self.errors: list[str] = []
        self.visits = 0

    def act(self) -> None:
        """Does something random for about half a second."""
        if self.page is None:
            self._come()
        elif self._chance.random() < 0.02:
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
        keys = self._chance.sample(KEYS, self._chance.randint(1, 3))
        for key in keys:
            page.keyboard.down(key)
        page.wait_for_timeout(self._chance.uniform(50, 600))
        for key in keys:
            page.keyboard.up(key)
        if self._chance.random() < 0.2:
            page.keyboard.press("KeyR")


def soak(minutes: float, scene: str, seed: int) -> list[str]:
    """Plays and looks; what went wrong, in sentences."""
    chance = random.Random(seed)
    memory: list[int] = []
    wrong: list[str] = []
    with played(scene) as server, browser() as chromium:
        players = [Player(chromium, server.url, chance) for _ in range(2)]
        process = psutil.Process(server.process.pid)
        began = time.monotonic()
        told = 0.0
        episodes = 0
        while (elapsed := time.monotonic() - began) < minutes * 60:
            chance.choice(players).act()
            memory.append(process.memory_info().rss)
            snapshot = server.snapshot()
            episodes = max(episodes, snapshot["episode"])
            if snapshot["error"]:
                wrong.append(f"the world stopped: {snapshot['error']}")
                break
            if elapsed - told > 60:
                told = elapsed
                print(f"{elapsed / 60:5.1f} min  {memory[-1] / 1e6:6.1f} MB", flush=True)
        wrong += _judge(server, players, memory)
        visits = sum(player.visits for player in players)
        print(f"{elapsed / 60:.1f} minutes, {episodes} episodes, {visits} visits of a page")
    return wrong


def _judge(server: Played, players: list[Player], memory: list[int]) -> list[str]:
    wrong = [f"a page raised: {error}" for player in players for error in player.errors]
    if any("Traceback" in line for line in server.told):
        wrong.append("the server raised:\n" + "".join(server.told))
    fifth = max(1, len(memory) // 5)
    before = statistics.median(memory[fifth : 2 * fifth])
    after = statistics.median(memory[-fifth:])
    print(f"memory {before / 1e6:.1f} -> {after / 1e6:.1f} MB ({after / before - 1:+.1%})")
    if after > before * GROWTH:
        wrong.append(f"memory grew by {after / before - 1:.1%}; expected at most 5%")
    return wrong


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--scene", default="box_chase")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    wrong = soak(options.minutes, options.scene, options.seed)
    print("\n".join(wrong) or "nothing went wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
