"""The tab "Teach" of a served room, in a real page."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator

from ai4u_edu.teach import background
from tests.browser.plain_page import WITHOUT_VISER
from tests.chromium import new_page
from tests.page.panel.rooms import PanelRoom
from tests.teach.driving import teaching_room


@contextmanager
def teach_tab(
    chromium: Browser, folder: Path, *, scene: str = "box_chase"
) -> Iterator[tuple[Locator, PanelRoom]]:
    """Open the tab of a scene with a work folder; no script of the page may fail."""
    page, problems = new_page(chromium), list[str]()
    patch = pytest.MonkeyPatch()
    patch.setattr(background, "NICENESS", 0)  # else a busy machine gives the learners no time
    page.on("pageerror", lambda error: problems.append(str(error)))
    with teaching_room(folder, scene) as room:
        WITHOUT_VISER.serve(page, room.url)
        page.goto(room.url)
        page.get_by_role("tab", name="Teach").click()
        yield page.get_by_role("tabpanel", name="Teach"), room
        page.context.close()
    patch.undo()
    assert problems == []
