"""Time to load a page: ``python -m tests.benchmarks.page_load``.

It is measured from the first request to the agent's sensors in the panel, in a browser just started
(nothing cached, nothing compiled), as at the beginning of a lesson. The processor time
of the browser's processes is printed too; other load on the machine changes it less.
``--against CHECKOUT`` loads the page of another checkout in turn with this one's;
``--language pt-BR`` loads it in another language in turn with English.
"""

import argparse
import os
import statistics
import time
from contextlib import ExitStack
from pathlib import Path
from typing import NamedTuple

import psutil

from tests.chromium import browser
from tests.playing import played

ROOT = Path(__file__).resolve().parents[2]
COUNT = """() => {
    const find = WebGL2RenderingContext.prototype, link = find.linkProgram;
    window.linked = 0;
    find.linkProgram = function (...args) { window.linked++; return link.apply(this, args); };
}"""


class Load(NamedTuple):
    """Time until a fresh browser showed the sensors."""

    seconds: float
    processor: float
    programs: int
    """Number of WebGL programs that the page compiled."""


def used() -> float:
    """Return the processor time (s) of the browser's processes."""
    spent = 0.0
    for child in psutil.Process().children(recursive=True):
        if "chrom" in child.name():
            times = child.cpu_times()
            spent += times.user + times.system
    return spent


def load(url: str, language: str = "en-US") -> Load:
    """Load a page once, in a browser with a language."""
    with browser() as chromium:
        page = chromium.new_page(viewport={"width": 1280, "height": 800}, locale=language)
        page.add_init_script(f"({COUNT})()")
        began, before = time.perf_counter(), used()
        page.goto(url, wait_until="commit")
        page.locator(".ai4u-sensor").first.wait_for(state="attached", timeout=60_000)
        took, spent = time.perf_counter() - began, used() - before
        return Load(took, spent, int(page.evaluate("linked")))


def main() -> None:
    """Run the benchmark and print its table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scene", default="box_chase")
    parser.add_argument("--times", type=int, default=9)
    against = parser.add_mutually_exclusive_group()
    against.add_argument("--against", type=Path, metavar="CHECKOUT")
    against.add_argument("--language", help="such as pt-BR")
    options = parser.parse_args()
    folders = [ROOT] if options.against is None else [options.against.resolve(), ROOT]
    with ExitStack() as stack:
        urls = []
        for folder in folders:
            os.environ["PYTHONPATH"] = str(folder)
            os.chdir(folder)
            urls.append(stack.enter_context(played(options.scene)).url)
        pages = [(folder.name, url, "en-US") for folder, url in zip(folders, urls, strict=True)]
        if options.language:
            pages.append((options.language, urls[0], options.language))
        found = [[load(url, language) for _, url, language in pages] for _ in range(options.times)]
    for (name, *_), loads in zip(pages, zip(*found, strict=True), strict=True):
        times = sorted(each.seconds for each in loads)
        middle = statistics.median(each.processor for each in loads)
        print(
            f"{name}: median {statistics.median(times):.2f} s, fastest {times[0]:.2f} s, "
            f"{middle:.2f} s of a processor, {loads[-1].programs} programs"
        )
    if len(pages) == 2:
        for name in ("seconds", "processor"):
            ratios = [getattr(new, name) / getattr(old, name) for old, new in found]
            print(f"{name}, median of the pairs' ratios: {statistics.median(ratios):.2f}")


if __name__ == "__main__":
    main()
