"""A scene that a page saves is there at the next start, without any option."""

from pathlib import Path

import pytest

from tests.page.panel.rooms import PanelPage
from tests.playing import played

pytestmark = pytest.mark.slow


def test_a_saved_scene_is_there_at_the_next_start(tmp_path: Path) -> None:
    with played("maze", state=tmp_path) as server, PanelPage(f"{server.url}ws/panel") as page:
        page.show("0", "world")
        part = page.part("world")
        assert part["can_save"]
        assert part["is_autosaved"]
        page.done("save_scene", name="Mine")
    with played("maze", state=tmp_path) as server, PanelPage(f"{server.url}ws/panel") as page:
        saved = [each["name"] for each in page.done("scenes")["items"] if each["is_saved"]]
        assert saved == ["Mine"]
        page.done("open_scene", name="Mine", is_saved=True)


def test_a_world_that_is_to_leave_nothing_saves_nothing(tmp_path: Path) -> None:
    served = played("maze", "--no-autosave", state=tmp_path)
    with served as server, PanelPage(f"{server.url}ws/panel") as page:
        page.show("0", "world")
        part = page.part("world")
        assert not part["can_save"]
        assert not part["is_autosaved"]
    assert list(tmp_path.iterdir()) == []
