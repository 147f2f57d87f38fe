"""Keys that are held until a test releases them."""

import math

import pytest

from ai4u_edu.blocks.keyboard import Keyboard


@pytest.fixture(autouse=True)
def held_keys(monkeypatch: pytest.MonkeyPatch) -> None:
    """Forget no key between two steps of a world, however long a busy machine takes for one."""
    monkeypatch.setattr(Keyboard, "timeout_s", math.inf)
