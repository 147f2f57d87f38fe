"""A room that keeps its drives and networks in a folder of the test's own."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.page.panel.rooms import PanelRoom
from tests.teach.driving import teaching_room


@pytest.fixture
def room(tmp_path: Path) -> Iterator[PanelRoom]:
    with teaching_room(tmp_path) as served:
        yield served
