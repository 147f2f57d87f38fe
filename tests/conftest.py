"""Options of the suite, what all tests share, and the report at the end; see tests/tiers.py."""

import functools
import gc
import os
import ssl
import subprocess
import sys
from collections.abc import Generator, Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from tests import evidence
from tests.tiers import LEFT_OUT, Tier

TESTS = Path(__file__).parent
ROOT = TESTS.parent
FAST_EXTRAS = {"test"}
"""Extras of pyproject.toml whose packages `--fast` may import."""
COMPONENT_TABLE = "components"
COLLECTIONS_BEFORE_OLDEST = 50
COMPILE_RAYS = ROOT / ".ci" / "compile_rays.py"
"""Makes the compiled part of a checkout; the tests of a wheel are run without it."""

# Small networks gain nothing from threads, which wait actively: several tests at once would slow
# each other down. Programs that tests start inherit it.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(name, "1")

# Tests read English, whatever the language of this machine is.
for name in ("AI4U_LANG", "LANGUAGE", "LC_ALL", "LC_MESSAGES"):
    os.environ.pop(name, None)
os.environ["LANG"] = "C.UTF-8"

# A busy machine makes an example slow, and no test asserts a time.
too_slow = [HealthCheck.too_slow]
settings.register_profile("project", deadline=None, suppress_health_check=too_slow)
settings.load_profile("project")


@pytest.fixture(scope="session", autouse=True)
def _one_tls_context() -> Iterator[None]:
    """Let all of httpx's clients share what no test uses: each would read all certificates again.

    That takes 22 ms, and a test that waits for an answer asks often.
    """
    with pytest.MonkeyPatch.context() as monkeypatch:
        shared = functools.cache(ssl.create_default_context)
        monkeypatch.setattr(ssl, "create_default_context", shared)
        yield


@pytest.fixture(autouse=True)
def _own_blocks_end_with_their_test() -> Iterator[None]:
    """Forget blocks that a test has loaded, with their files.

    A process that a later test starts is told to load them, from files that may be others by then.
    """
    yield
    from ai4u_edu.blocks import Block
    from ai4u_edu.blocks.loading import PREFIX

    types = Block.types.items()
    Block.types = {name: cls for name, cls in types if not cls.__module__.startswith(PREFIX)}


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("tiers of this project")
    group.addoption("--fast", action="store_true", help="no browser, no torch, nothing slow")
    group.addoption("--nightly", action="store_true", help="also the tests marked `nightly`")
    group.addoption("--seed", type=int, help="draw the order of files and of tests within them")
    group.addoption(
        "--unmarked", type=Path, help="file for sentences that nobody marked for translation"
    )
    group.addoption(
        "--results", type=Path, default=evidence.RESULTS, help="folder for files of failed tests"
    )


def pytest_report_header(config: pytest.Config) -> list[str]:
    seed = config.option.seed
    return [] if seed is None else [f"order of files and tests: drawn with --seed {seed}"]


def pytest_configure(config: pytest.Config) -> None:
    config.pluginmanager.register(Tier(config), "tier")
    if config.option.unmarked:
        from tests.unmarked import Unmarked

        config.pluginmanager.register(Unmarked(config.option.unmarked), "unmarked")
    if config.option.fast:
        from tests.only_extras import OnlyExtras  # an installed wheel is tested without packaging

        OnlyExtras(FAST_EXTRAS).install()
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


def pytest_runtest_logstart(nodeid: str) -> None:
    evidence.begun.append(nodeid)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item,
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Keep files of a failed test while its fixtures are still there."""
    report = yield
    if report.failed:
        evidence.keep(report, item.config.option.results)
    return report


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
    left_out = config.stash[LEFT_OUT]
    if left_out:
        tier = "--fast" if config.option.fast else "tests marked `nightly`"
        terminalreporter.write_line(f"{left_out} tests left out ({tier}), and whole files.")
