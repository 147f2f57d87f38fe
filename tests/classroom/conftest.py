"""Processes of a class that learn run at the usual priority, also in a test's own process."""

import pytest


@pytest.fixture(autouse=True)
def _usual_priority(monkeypatch: pytest.MonkeyPatch) -> None:
    """Give them no low priority: on a busy machine they would get no time at all."""
    monkeypatch.setattr("ai4u_edu.teach.background.NICENESS", 0)
