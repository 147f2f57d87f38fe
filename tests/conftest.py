"""What belongs to no test alone: the table of components, at the end of the log."""

import pytest

LOG = pytest.StashKey[str]()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if LOG in terminalreporter.config.stash:
        terminalreporter.section("components")
        terminalreporter.write_line(terminalreporter.config.stash[LOG])
