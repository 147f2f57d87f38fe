"""What belongs to no test alone: who needs the machine to itself; the table at the log's end."""

from pathlib import Path

import pytest

TESTS = Path(__file__).parent
ALONE = {"browser", "load", "remote", "server", "training", "viewer", "workshop"}
ALONE_TOO = {"test_live.py", "test_runner.py", "test_slow_ticks.py"}
"""Tests of these folders and files keep real time, listen at ports, or look at a page."""
LOG = "components"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        inside = TESTS in item.path.parents
        first = item.path.relative_to(TESTS).parts[0] if inside else ""
        quiet = first in ALONE or item.path.name in ALONE_TOO
        if quiet or item.get_closest_marker("browser"):
            item.add_marker(pytest.mark.alone)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    for report in terminalreporter.stats.get("passed", ()):
        for name, told in report.user_properties:  # they come over from another process too
            if name == LOG:
                terminalreporter.section("components")
                terminalreporter.write_line(told)
