"""What belongs to no test alone: who needs the machine to itself; the table at the log's end."""

from pathlib import Path

import pytest

TESTS = Path(__file__).parent
ALONE = {"attacks", "browser", "load"}
"""Tests of these folders look at a page, and draw it without a graphics card; or are many."""
REAL_TIME = ALONE | {"remote", "server", "training", "viewer", "editing", "runtime"}
REAL_TIME_TOO = {"test_live.py"}
"""Tests of these folders and files keep real time or listen at ports: what a machine's bad moment
failed gets another chance, and the log names it. All others must pass at once."""
LOG = "components"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        inside = TESTS in item.path.parents
        first = item.path.relative_to(TESTS).parts[0] if inside else ""
        looks = item.get_closest_marker("browser") is not None
        if first in ALONE or looks:
            item.add_marker(pytest.mark.alone)
        if first in REAL_TIME or item.path.name in REAL_TIME_TOO or looks:
            item.add_marker(pytest.mark.flaky(reruns=2))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    for report in terminalreporter.stats.get("passed", ()):
        for name, told in report.user_properties:  # they come over from another process too
            if name == LOG:
                terminalreporter.section("components")
                terminalreporter.write_line(told)
