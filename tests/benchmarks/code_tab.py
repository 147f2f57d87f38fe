"""Speed of programs in the page: ``python -m tests.benchmarks.code_tab``.

- From Run to the first decision: cold, in a browser just started, with the tab "Code" just opened;
  and warm, again in the same page.
- Decisions a second in real time, of a robot that decides at each of 60 ticks.
- Test of ten starts of box_chase, with the program of the docs.

World, page and Python are real. The page draws nothing unless ``--draw`` is given, since most
machines that run this have no graphics card, which students' have.
"""

import argparse
import os
import statistics
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import Page

from ai4u_edu.scenes.scene import LIBRARY
from tests.browser.code_editor import WithEditor
from tests.browser.served_viser import ready
from tests.chromium import DRAW_NOTHING, browser
from tests.code_sheet import programs_in_docs
from tests.playing import Played, played

SEED = "5"
SECONDS = 10.0
TIMEOUT_MS = 180_000
TURN = 'def decide(percept):\n    return {"move": [0, 0.3, 0, 0]}\n'
PRESS = """
([name, pattern]) => new Promise((done) => {
  const began = performance.now();
  const state = document.querySelector(".ai4u-code-state");
  const look = () => {
    if (!new RegExp(pattern).test(state.textContent)) return;
    watch.disconnect();
    done((performance.now() - began) / 1000);
  };
  const watch = new MutationObserver(look);
  watch.observe(state, { subtree: true, childList: true, characterData: true });
  const buttons = [...document.querySelectorAll(".ai4u-code-buttons button")];
  buttons.find((each) => each.textContent === name).click();
})
"""
"""Presses a button, and returns the seconds until the line below tells of something."""


class Tab(WithEditor):
    """The tab "Code" of a page."""

    def __init__(self, page: Page) -> None:
        self.page = page

    def until(self, button: str, pattern: str) -> float:
        """Press a button; return the seconds until the tab's line fits a pattern."""
        found: float = self.page.evaluate(PRESS, [button, pattern])
        return found

    def wait_until_ready(self) -> None:
        """Wait until Python is loaded."""
        self.page.locator(".ai4u-code-state").filter(has_text="Ready").wait_for()

    @property
    def decision(self) -> int:
        text = self.page.locator(".ai4u-code-count").inner_text()
        return int(text.split()[-1])


@contextmanager
def opened(url: str, *, draws: bool) -> Iterator[Tab]:
    """Open the page in a browser just started."""
    with browser() as chromium:
        page = chromium.new_page(viewport={"width": 1280, "height": 900})
        page.set_default_timeout(TIMEOUT_MS)
        if not draws:
            page.add_init_script(DRAW_NOTHING)
        page.goto(url)
        ready(page)
        page.get_by_role("tab", name="Code").click()
        page.locator(".cm-line").filter(has_text="def decide").wait_for()
        yield Tab(page)


def starts(url: str, *, draws: bool) -> tuple[float, float]:
    """Return the seconds from Run to the first decision, cold and warm."""
    with opened(url, draws=draws) as tab:
        cold = tab.until("Run", r"decision \d")
        tab.until("Stop", "Stopped")
        warm = []
        for _ in range(5):
            warm.append(tab.until("Run", r"decision \d"))
            tab.until("Stop", "Stopped")
        return cold, min(warm)


def ten_starts(url: str, *, draws: bool) -> float:
    """Return the seconds that Test takes, with Python loaded."""
    with opened(url, draws=draws) as tab:
        tab.write(programs_in_docs()[0])
        tab.wait_until_ready()
        return tab.until("Test", r"of 10 reached the goal")


def rate(server: Played, *, draws: bool) -> float:
    """Return the decisions a second in real time."""
    server.restart(int(SEED))  # else the episode of the round before may end
    with opened(server.url, draws=draws) as tab:
        tab.write(TURN)
        tab.until("Run", r"decision \d\d\d")
        first = tab.decision
        began = tab.page.evaluate("performance.now()")
        tab.page.wait_for_timeout(1000 * SECONDS)
        last, now = tab.decision, tab.page.evaluate("performance.now()")
        return 1000 * (last - first) / float(now - began)


def every_tick(folder: Path) -> Path:
    """Write box_chase with a robot that decides at each tick; return the file."""
    text = (LIBRARY / "box_chase.yaml").read_text(encoding="utf-8")
    file = folder / "every_tick.yaml"
    brain = "      - type: LocalBrain\n"
    file.write_text(text.replace(brain, f"{brain}        skip_frame: 0\n"), encoding="utf-8")
    return file


def main() -> None:
    """Run the benchmark and print its table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=5)
    parser.add_argument("--draw", action="store_true", help="let the page draw its world")
    options = parser.parse_args()
    draws = options.draw
    with (
        tempfile.TemporaryDirectory() as folder,
        played("box_chase", "--seed", SEED) as server,
        played(str(every_tick(Path(folder))), "--seed", SEED) as fast,
    ):
        found = [
            (
                *starts(server.url, draws=draws),
                ten_starts(server.url, draws=draws),
                rate(fast, draws=draws),
            )
            for _ in range(options.times)
        ]
    cold, warm, tests, rates = zip(*found, strict=True)
    print(f"load average {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores")
    print("| | best | median |\n|---|---|---|")
    for name, values in (
        ("Run to first decision, cold (s)", cold),
        ("warm (s)", warm),
        ("Test (s)", tests),
    ):
        print(f"| {name} | {min(values):.2f} | {statistics.median(values):.2f} |")
    print(f"| decisions a second, of 60 | {max(rates):.1f} | {statistics.median(rates):.1f} |")


if __name__ == "__main__":
    main()
