"""A room that keeps its drives and networks in a folder of the test's own."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from ai4u_edu.teach import background
from tests.page.panel.rooms import PanelRoom
from tests.teach.driving import teaching_room


@pytest.fixture(autouse=True)
def _usual_priority(monkeypatch: pytest.MonkeyPatch) -> None:
    """Have processes that learn run as tests do: with the lowest priority they may get no time."""
    monkeypatch.setattr(background, "NICENESS", 0)


@pytest.fixture
def room(tmp_path: Path) -> Iterator[PanelRoom]:
    with teaching_room(tmp_path) as served:
        yield served
