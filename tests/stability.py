"""``python -m tests.stability``: repeats a tier of the tests, idle or beside other work.

It clones the last commit into a folder of its own, where the first run sets up an environment from
nothing, goes on in the background, and appends a line for each run to a log, with the traceback of
each failed test. Changes that are not committed are not in the clone.
"""

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from xml.etree import ElementTree

from tests.__main__ import RESULTS, ROOT

LOG = ROOT / "build" / "stability.log"
MAX_RUN_S = 4 * 3600.0
"""Time (s) after which a run is ended, and counts as one that hangs."""
TRACEBACK_LINES = 40
LATE = Path("tests") / "late"
"""Folder whose ``sitecustomize.py`` lets threads wake late."""
LOOP = "import os; parent = os.getppid()\nwhile os.getppid() == parent: pass"
"""Program that keeps a core busy until its parent ends."""


@dataclass
class Run:
    """Result of one run of the tests."""

    code: int
    seconds: float
    passed: int
    failures: dict[str, str]
    """Traceback of each failed test by the test's id."""
    end: str
    """Last line of the output, which names the checks that failed."""

    def lines(self) -> Iterator[str]:
        """Return the lines for the log."""
        state = "green" if self.code == 0 else "RED"
        failed = f", {len(self.failures)} failed" if self.failures else ""
        yield f"{state}: {self.passed} passed{failed} in {self.seconds:.0f} s"
        if self.code:
            yield f"    {self.end}"
        for test, traceback in self.failures.items():
            yield f"  FAILED {test}"
            yield from (f"    {line}" for line in traceback.splitlines()[-TRACEBACK_LINES:])


def main() -> int:
    """Start the runs in the background, or make them; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.stability")
    parser.add_argument("--runs", type=int, default=1, help="number of runs")
    parser.add_argument("--load", type=int, default=0, help="endless loops beside the tests")
    parser.add_argument(
        "--seed", type=int, help="draw the order of files and tests, a new one a run"
    )
    parser.add_argument("--fast", action="store_true", help="the tier --fast")
    parser.add_argument("--late", action="store_true", help="threads wake late")
    parser.add_argument("--log", type=Path, default=LOG, help="file to append to")
    parser.add_argument("--foreground", action="store_true", help="stay until the last run ends")
    options = parser.parse_args()
    if options.foreground:
        return repeat(options)
    arguments = [sys.executable, "-m", "tests.stability", *sys.argv[1:], "--foreground"]
    process = subprocess.Popen(
        arguments,
        cwd=ROOT,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    print(f"Runs in the background. Follow: tail -f {options.log}. End: kill {process.pid}")
    return 0


def repeat(options: argparse.Namespace) -> int:
    """Make all runs; return 0 if all were green."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that folder and loops go
    options.log.parent.mkdir(parents=True, exist_ok=True)
    is_green = True
    with clone() as (folder, commit), endless_loops(options.load):
        for number in range(options.runs):
            command = [sys.executable, "-m", "tests", *["--fast"] * options.fast]
            order = "in order"
            if options.seed is not None:
                command += ["--seed", str(options.seed + number)]
                order = f"seed {options.seed + number}"
            tier = "fast" if options.fast else "default"
            late = ", late threads" if options.late else ""
            now = datetime.now(UTC).strftime("%Y-%m-%d %H:%M")
            run = run_once(command, folder, options.log.parent, late=options.late)
            first, *others = run.lines()
            head = f"{now} {commit} {tier}, load {options.load}{late}, {order}, run {number + 1}"
            around = f"load average {os.getloadavg()[1]:.0f}"  # of five minutes, of all programs
            with options.log.open("a", encoding="utf-8") as log:
                log.write("\n".join([f"{head}: {first}, {around}", *others, ""]))
            is_green = is_green and run.code == 0
    return 0 if is_green else 1


def run_once(command: list[str], folder: Path, kept_in: Path, *, late: bool) -> Run:
    """Run the tests in a clone; keep the results of a red run in a folder beside the log."""
    shutil.rmtree(folder / RESULTS, ignore_errors=True)
    output, began = folder / "output.txt", time.monotonic()
    with output.open("w", encoding="utf-8") as file:
        process = subprocess.Popen(
            command,
            cwd=folder,
            env={**os.environ, "PYTHONPATH": str(folder / LATE)} if late else None,
            stdin=subprocess.DEVNULL,
            stdout=file,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            code = process.wait(MAX_RUN_S)
        except BaseException as error:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            if not isinstance(error, subprocess.TimeoutExpired):
                raise
            code = -1
    seconds = time.monotonic() - began
    passed, failures = read_results(folder / RESULTS)
    said = output.read_text(encoding="utf-8", errors="replace").rstrip().splitlines()
    if code:
        kept = kept_in / f"stability-{datetime.now(UTC):%m%d-%H%M%S}"
        shutil.copytree(folder / RESULTS, kept, dirs_exist_ok=True)
        shutil.copy(output, kept)
    end = f"ended after {seconds:.0f} s, for it hung" if code == -1 else (said or ["no output"])[-1]
    return Run(code, seconds, passed, failures, end)


def read_results(folder: Path) -> tuple[int, dict[str, str]]:
    """Return the number of tests that passed, and the traceback of each that failed, by its id."""
    passed, failures = 0, {}
    for path in sorted(folder.glob("*.xml")):
        for case in ElementTree.parse(path).iter("testcase"):  # noqa: S314 - pytest's own
            bad = [each for each in case if each.tag in ("failure", "error")]
            if bad:
                test = f"{case.get('classname')}::{case.get('name')}"
                failures[test] = "\n".join(each.text or each.get("message") or "" for each in bad)
            elif case.find("skipped") is None:
                passed += 1
    return passed, failures


@contextmanager
def clone() -> Iterator[tuple[Path, str]]:
    """Make a clone of the last commit, without an environment; give its folder and the commit."""
    git = ["git", "-C", str(ROOT)]
    commit = subprocess.check_output([*git, "rev-parse", "--short", "HEAD"], text=True).strip()
    with tempfile.TemporaryDirectory(prefix="ai4u-edu-stability-") as name:
        folder = Path(name) / "clone"
        subprocess.run(["git", "clone", "--quiet", str(ROOT), str(folder)], check=True)
        yield folder, commit


@contextmanager
def endless_loops(count: int) -> Iterator[None]:
    """Keep cores busy."""
    loops = [subprocess.Popen([sys.executable, "-c", LOOP]) for _ in range(count)]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


if __name__ == "__main__":
    sys.exit(main())
