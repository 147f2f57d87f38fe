"""Programs whose time limits count lines, so that no slow machine reaches them."""

from itertools import count
from types import SimpleNamespace

import pytest

LOOK_S = 1e-4
"""Time that passes with each look at the clock; programs look at it every few lines."""


@pytest.fixture(autouse=True)
def counted_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the clock of programs go on by looks at it alone."""
    looks = count(1)
    clock = SimpleNamespace(monotonic=lambda: LOOK_S * next(looks))
    monkeypatch.setattr("ai4u_edu.program.tracing.time", clock)
