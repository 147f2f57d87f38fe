"""Tiers of the suite (``--fast``, ``--nightly``), the order of files, and the report at the end."""

import functools
import gc
import os
import random
import ssl
import subprocess
import sys
from collections.abc import Generator, Iterator
from pathlib import Path

import pytest
from hypothesis import settings

TESTS = Path(__file__).parent
ROOT = TESTS.parent
LONG_FOLDERS = ("browser", "attacks", "training", "remote", "lessons", "load")
"""Their files take longest and are started first, so that no core is idle at the end."""
BROWSERS_END_AT = 0.8
"""Part of the test files after which none with a browser begins, since they take long."""
NOT_FAST = ("attacks", "benchmarks", "browser", "docs_site", "envs", "fuzz", "lessons", "load",
            "remote", "training", "chromium.py", "screenshot.py", "soak.py")  # fmt: skip
"""Paths that ``--fast`` does not import: they train, serve, or need Chromium, torch or Sphinx."""
NOT_FAST_MARKERS = {"alone", "browser", "slow"}
COMPONENT_TABLE = "components"
COLLECTIONS_BEFORE_OLDEST = 50
LEFT_OUT = pytest.StashKey[int]()
COMPILE_RAYS = ROOT / ".ci" / "compile_rays.py"
"""Makes the compiled part of a checkout; the tests of a wheel are run without it."""

# Small networks gain nothing from threads, which wait actively: several tests at once would slow
# each other down. Programs that tests start inherit it.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(name, "1")

# A busy machine makes an example slow, and no test asserts a time.
settings.register_profile("project", deadline=None)
settings.load_profile("project")


@pytest.fixture(scope="session", autouse=True)
def _one_tls_context() -> Iterator[None]:
    """Let all of httpx's clients share what no test uses: each would read all certificates anew.

    That takes 22 ms, and a test that waits for an answer asks often.
    """
    with pytest.MonkeyPatch.context() as monkeypatch:
        shared = functools.cache(ssl.create_default_context)
        monkeypatch.setattr(ssl, "create_default_context", shared)
        yield


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("tiers of this project")
    group.addoption("--fast", action="store_true", help="no browser, no torch, nothing slow")
    group.addoption("--nightly", action="store_true", help="also the tests marked `nightly`")
    group.addoption("--seed", type=int, help="draw the order of files and of tests within them")


def pytest_report_header(config: pytest.Config) -> list[str]:
    seed = config.option.seed
    return [] if seed is None else [f"order of files and tests: drawn with --seed {seed}"]


def pytest_configure(config: pytest.Config) -> None:
    config.stash[LEFT_OUT] = 0
    if config.option.fast:
        folders = [ROOT / each / name for each in ("ai4u_edu", "tests") for name in NOT_FAST]
        config.option.ignore = [*(config.option.ignore or ()), *map(str, folders)]
    if not hasattr(config, "workerinput"):
        compile_rays()


def compile_rays() -> None:
    """Compile what the checkout lacks, where there is a compiler; an editable installation does it.

    A change of the source makes another library, and other worktrees have their own.
    """
    folder = ROOT / "ai4u_edu" / "world" / "native"
    newest = max((path.stat().st_mtime for path in folder.glob("rays-*")), default=0.0)
    if COMPILE_RAYS.exists() and newest < (folder / "rays.c").stat().st_mtime:
        subprocess.run([sys.executable, COMPILE_RAYS], capture_output=True, check=False)


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Collect tests without Python's garbage collector, which then leaves them alone.

    It would look at all of these objects again and again: a third of the collection's
    time, and some of the tests' own. All that is left to it after that are the tests' objects,
    which a full collection now and then is enough for.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.set_threshold(*gc.get_threshold()[:2], COLLECTIONS_BEFORE_OLDEST)
        gc.enable()


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    is_chosen_by_hand = any("::" in argument for argument in config.args)
    left_out = [] if is_chosen_by_hand else [each for each in items if _is_left_out(each, config)]
    if left_out:
        config.stash[LEFT_OUT] = len(left_out)
        config.hook.pytest_deselected(items=left_out)
    kept = set(items).difference(left_out)
    items[:] = _in_turn([each for each in items if each in kept], config.option.seed)


def _is_left_out(item: pytest.Item, config: pytest.Config) -> bool:
    markers = {each.name for each in item.iter_markers()}
    if config.option.fast and markers & NOT_FAST_MARKERS:
        return True
    return "nightly" in markers and not config.option.nightly


def _in_turn(items: list[pytest.Item], seed: int | None) -> list[pytest.Item]:
    """Return the tests in the order to run them, those of a file together."""
    turns = _turns(items)
    if seed is not None:
        draw = random.Random(seed)
        files = sorted(turns)
        turns = dict(zip(files, draw.sample(range(len(files)), len(files)), strict=True))
        draw.shuffle(items)
    return sorted(items, key=lambda each: turns[each.path])


def _turns(items: list[pytest.Item]) -> dict[Path, float]:
    """Return the place of each file: long ones first, those with a browser evenly among the others.

    Drawing takes more than one core, so that two browsers at once would wait for each other, while
    other tests wait for a world's time and leave a core idle.
    """
    files = sorted({item.path for item in items}, key=_turn)
    with_browser = {item.path for item in items if item.get_closest_marker("browser")}
    others = [each for each in files if each not in with_browser]
    count = sum(each.is_relative_to(TESTS) for each in others)
    distance = BROWSERS_END_AT * count / max(len(with_browser), 1)
    browsers = [each for each in files if each in with_browser]
    places = {each: float(place) for place, each in enumerate(others)}
    return places | {each: distance * place for place, each in enumerate(browsers)}


def _turn(path: Path) -> tuple[int, Path]:
    folder = _folder(path)
    place = LONG_FOLDERS.index(folder) if folder in LONG_FOLDERS else len(LONG_FOLDERS)
    return place if path.is_relative_to(TESTS) else len(LONG_FOLDERS) + 1, path


def _folder(path: Path) -> str:
    """Return the package of ai4u_edu that a file belongs to or tests; empty if there is none."""
    parts = path.relative_to(ROOT).parts if ROOT in path.parents else ()
    return parts[1] if len(parts) > 1 else ""


# -- the report; with xdist, workers collect and the process that reports does not --------------


def pytest_sessionfinish(session: pytest.Session) -> None:
    output = getattr(session.config, "workeroutput", None)
    if output is not None:
        output["left_out"] = session.config.stash[LEFT_OUT]


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: object) -> None:
    config: pytest.Config = node.config  # type: ignore[attr-defined]
    config.stash[LEFT_OUT] = getattr(node, "workeroutput", {}).get("left_out", 0)


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    for report in terminalreporter.stats.get("passed", ()):
        for name, table in report.user_properties:  # they come over from another process too
            if name == COMPONENT_TABLE:
                terminalreporter.section(COMPONENT_TABLE)
                terminalreporter.write_line(table)
    rerun = sorted({each.nodeid for each in terminalreporter.stats.get("rerun", ())})
    if rerun:
        terminalreporter.section("defects to mend: tests that passed only when run again")
        for nodeid in rerun:
            terminalreporter.write_line(nodeid)
    left_out = config.stash[LEFT_OUT]
    if left_out:
        tier = "--fast" if config.option.fast else "tests marked `nightly`"
        terminalreporter.write_line(f"{left_out} tests left out ({tier}).")
