"""``python3 -m tests``: every check of the project, from a fresh clone with a bare Python.

``--fast`` takes a minute and needs neither a browser nor torch; ``--nightly`` adds repetitions and
long runs. ``--only mypy`` runs one tool, and ``--only web`` those of the page's scripts, which need
Node.js; ``--seed 7`` draws the order of the tests. Other arguments go to pytest, which then runs
alone: ``python3 -m tests -k cycle``. Standard library only, in a syntax that Python 3.8 reads.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from ai4u_edu import bootstrap
from tests import setup_browser, setup_web
from tests.remote import ai4u_venv

TESTS = Path(__file__).resolve().parent
ROOT = TESTS.parent
RESULTS = Path("build") / "test-results"
"""Folder in the checkout with the results of the last run."""
ALONE = "pytest.mark.alone"
LINT_IMPORTS = "from importlinter.cli import lint_imports_command as run; run()"
# Through `python -m`, since scripts in .venv/bin don't survive a move of the checkout.
STATIC_CHECKS = {
    "ruff format": ["-m", "ruff", "format", "--check", "."],
    "ruff check": ["-m", "ruff", "check", "."],
    "mypy": ["-m", "mypy"],
    "imports": ["-c", LINT_IMPORTS],
}
GB_EACH = 2.0
"""Memory (GB) for each process that runs tests; it takes 1.2 GB with what it starts."""
MAX_WORKERS = 16
LONG_RUNS = {
    "fuzz": ["-m", "tests.fuzz"],
    "hammer": ["-m", "tests.attacks.hammer", "--seconds", "300"],
    "class hammer": ["-m", "tests.attacks.class_hammer", "--seconds", "5400"],
    "soak": ["-m", "tests.soak", "--minutes", "30"],
}
WEB = "web"
NO_TESTS_COLLECTED = 5


def workers(cores: int, memory_gb: float) -> int:
    """Return how many processes run tests at a time.

    Tests wait for pages, servers and a world's time for half of theirs.

    Args:
        cores: of the processor, which these processes may use.
        memory_gb: of this machine.
    """
    wanted = max(min(2 * cores, 8), cores)
    return int(max(1, min(wanted, MAX_WORKERS, memory_gb / GB_EACH)))


def machine() -> tuple[int, float]:
    """Return the cores that this process may use, and the memory (GB) of this machine."""
    cores, memory_gb = os.cpu_count() or 2, float("inf")
    if hasattr(os, "sched_getaffinity"):
        cores = len(os.sched_getaffinity(0))
    if hasattr(os, "sysconf"):
        memory_gb = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9
    return cores, memory_gb


def main() -> int:
    """Run the checks, all of them even if one fails; return the exit code."""
    parser = argparse.ArgumentParser(prog="python3 -m tests", allow_abbrev=False)
    tools = sorted({*(name.split()[0] for name in STATIC_CHECKS), "pytest", WEB})
    parser.add_argument("--only", choices=tools, help="run this one alone")
    tier = parser.add_mutually_exclusive_group()
    tier.add_argument("--fast", action="store_true", help="no browser, no torch, nothing slow")
    tier.add_argument("--nightly", action="store_true", help="also repetitions and long runs")
    parser.add_argument("--seed", type=int, help="draw the order of files and tests")
    options, for_pytest = parser.parse_known_args()
    only = options.only or ("pytest" if for_pytest else "")
    if for_pytest and only != "pytest":
        parser.error(f"{only} takes no arguments here, and got: {' '.join(for_pytest)}")

    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        # a shell's background job ignores Ctrl-C, and so would all that the tests start
        signal.signal(signal.SIGINT, signal.default_int_handler)
    # else each program that a test starts compiles the package again
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    if only == WEB:
        try:
            web = setup_web.ensure(ROOT)
        except setup_web.WebToolsError as error:
            sys.exit(str(error))
        return report([failed for name in web for failed in run_quietly(name, web[name])])
    python, missing, web = set_up(options, only)
    static = {
        name: [python, *arguments]
        for name, arguments in STATIC_CHECKS.items()
        if only in ("", name.split()[0]) and not (options.fast and name == "mypy" and not only)
    }
    static.update(web)
    with ThreadPoolExecutor(2) as pool:
        checks = [pool.submit(run_quietly, name, static[name]) for name in static]
        failed = (
            []
            if only not in ("", "pytest")
            else run_tests(python, missing, options, only, for_pytest)
        )
    return report([name for check in checks for name in check.result()] + failed)


def set_up(options: argparse.Namespace, only: str) -> tuple[str, list[str], dict[str, list[str]]]:
    """Get all that the checks need.

    Returns:
        The Python to run them with, what is missing, and the checks of ``web/``, none of them where
        there is no Node.js: it is no package of Python, and a fresh machine may lack it.
    """
    wants_all = not options.fast and only in ("", "pytest")
    with ThreadPoolExecutor(2) as pool:  # one downloads while the other unpacks
        web = pool.submit(get_web_tools) if not options.fast and not only else None
        ai4u = pool.submit(get_ai4u, options.nightly) if wants_all else None
        debians = pool.submit(setup_browser.install_debians) if wants_all else None
        try:
            python = bootstrap.ensure(ROOT, ["test" if options.fast else "dev"])
        except bootstrap.InstallError as error:
            sys.exit(str(error))
        missing = get_browser(python, debians.result()) if debians else []
        missing += ai4u.result() if ai4u else []
        return str(python), missing, web.result() if web else {}


def run_tests(
    python: str, missing: list[str], options: argparse.Namespace, only: str, for_pytest: list[str]
) -> list[str]:
    """Run the tests of a tier, or those that were chosen; return the names of what failed."""
    failed = list(missing)
    tier_options = ["--fast"] * options.fast + ["--nightly"] * options.nightly
    if options.seed is not None:
        tier_options += ["--seed", str(options.seed)]
    pytest = [python, "-m", "pytest", *tier_options]
    if for_pytest:  # a few tests, chosen by hand
        return run_in_turn("pytest", [*pytest, *for_pytest])
    without_browser = " and not browser" if "browser" in failed else ""
    # in place of one that was ended xdist starts another one, and with --dist=loadfile it then
    # waits for ever
    parallel = ["-n", str(workers(*machine())), "--max-worker-restart=0"]
    commands = {"pytest": [*pytest, "-m", "not alone" + without_browser, *parallel]}
    if not options.fast:
        # only these files are read then
        alone = [
            str(path) for path in sorted(TESTS.rglob("test_*.py")) if ALONE in path.read_text()
        ]
        commands["pytest alone"] = [*pytest, "-m", "alone" + without_browser, *alone]
    if options.nightly and not only:
        commands.update({name: [python, *arguments] for name, arguments in LONG_RUNS.items()})
    shutil.rmtree(ROOT / RESULTS, ignore_errors=True)
    for name, command in commands.items():
        if "pytest" in name:
            command.append(f"--junitxml={RESULTS / name.replace(' ', '-')}.xml")
        failed += run_in_turn(name, command)
    return failed


def get_browser(python: Path, tried: list[str]) -> list[str]:
    """Get Chromium for the tests, after what was tried; return its name if it wasn't to be had."""
    try:
        os.environ["AI4U_CHROMIUM"] = setup_browser.ensure(python, tried)
    except setup_browser.BrowserError as error:
        print(f"\n{error}\nGoing on without the tests that need a browser.", flush=True)
        return ["browser"]
    return []


def get_ai4u(trains: bool) -> list[str]:
    """Get AI4U's own package for the tests; return its name if it could not be had."""
    try:
        ai4u_venv.ensure(Path(sys.executable), trains=trains)
    except ai4u_venv.VenvError as error:
        print(f"\n{error}\nGoing on without the tests that need it.", flush=True)
        return ["AI4U's package"]
    return []


def get_web_tools() -> dict[str, list[str]]:
    """Get the checks of ``web/`` by name; none, with a note, if they can't be had here."""
    try:
        return setup_web.ensure(ROOT)
    except setup_web.WebToolsError as error:
        print(f"\n{error}\nGoing on without the checks of web/.", flush=True)
        return {}


def run_quietly(name: str, command: list[str]) -> list[str]:
    """Run one check, and print its output at its end; return its name if it failed."""
    start = time.monotonic()  # real time: for the report alone
    done = subprocess.run(
        command,
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        check=False,
    )
    end = outcome(name, done.returncode, start)
    print(f"\n--- {name}\n{done.stdout}{end}", flush=True)
    return [name] if done.returncode else []


def run_in_turn(name: str, command: list[str]) -> list[str]:
    """Run one check, its output as it comes; return its name if it failed."""
    print(f"\n--- {name}", flush=True)
    start = time.monotonic()  # real time: for the report alone
    code = subprocess.call(command, cwd=ROOT)
    if name == "pytest alone" and code == NO_TESTS_COLLECTED:
        code = 0
    print(outcome(name, code, start), flush=True)
    return [name] if code else []


def outcome(name: str, code: int, start: float) -> str:
    """Return the line that ends a check."""
    # real time: for the report alone
    return f"--- {name}: {'FAILED' if code else 'ok'} in {time.monotonic() - start:.1f} s"


def report(failed: list[str]) -> int:
    """Print what failed, and return the exit code."""
    if failed:
        print(f"\nNot in order: {', '.join(failed)}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
