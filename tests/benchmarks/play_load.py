"""Share of a core that a played scene uses: ``python -m tests.benchmarks.play_load``.

One agent, 60 ticks a second, the page open in headless Chromium with A held. The processor time is
that of the serving process (world, viewer and server together), not the browser's.
"""

import argparse
import time

import psutil

from tests.chromium import browser
from tests.playing import played


def main() -> None:
    """Run the benchmark and print its table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--scene", default="box_chase")
    options = parser.parse_args()
    with played(options.scene) as server, browser() as chromium:
        process = psutil.Process(server.process.pid)
        for pages in (0, 1):
            if pages:
                page = chromium.new_page(viewport={"width": 1280, "height": 800})
                page.goto(server.url)
                page.wait_for_timeout(5000)
                page.keyboard.down("KeyA")  # the robot turns in place, and so never falls
            time.sleep(2)
            before, tick = process.cpu_times(), server.snapshot()["tick"]
            began = time.perf_counter()
            time.sleep(options.seconds)
            took = time.perf_counter() - began
            after, ticks = process.cpu_times(), server.snapshot()["tick"] - tick
            used = after.user + after.system - before.user - before.system
            print(f"{pages} pages: {used / took:.0%} of a core, {ticks / took:.1f} ticks a second")


if __name__ == "__main__":
    main()
