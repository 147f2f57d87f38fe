"""A network that is gone for a minute: pages say so, and go on where they were."""

import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.test_class import agent_of, join
from tests.browser.whole import scene_picture
from tests.chromium import new_page
from tests.classroom.served_class import ServedClass, served_class
from tests.waiting import until
from tests.wifi import Wifi

pytestmark = [pytest.mark.browser, pytest.mark.nightly]
OUTAGE_S = 60
TOLD_MS = 30_000
LOST = "No connection to this world"


def drive(page: Page) -> None:
    """Drive until the world answers."""
    before = agent_of(page)["pose"]
    page.keyboard.down("KeyW")
    until(lambda: agent_of(page)["pose"] != before)
    page.keyboard.up("KeyW")


def status_of_the_room(school: ServedClass) -> object:
    return school.state()["rooms"][0]["status"]


@pytest.mark.parametrize("with_connections", [True, False])
def test_a_minute_without_wifi(chromium: Browser, tmp_path: Path, with_connections: bool) -> None:
    with served_class(tmp_path) as school, Wifi(school.url) as wifi:
        teacher, ada = new_page(chromium), new_page(chromium, draws=True)
        join(ada, replace(school, url=wifi.url))
        teacher.goto(f"{wifi.url}teacher?token={school.token}")
        drive(ada)
        room, began = ada.url, time.monotonic()
        ada.keyboard.down("KeyW")
        wifi.go()
        expect(ada.get_by_text(LOST)).to_be_visible(timeout=TOLD_MS)
        expect(teacher.get_by_text("The class can't be reached.")).to_be_visible(timeout=TOLD_MS)
        until(lambda: status_of_the_room(school) == "away")
        ada.keyboard.up("KeyW")
        time.sleep(OUTAGE_S - (time.monotonic() - began))  # the minute itself
        wifi.come_back(with_connections=with_connections)

        expect(ada.get_by_text(LOST)).to_be_hidden(timeout=TOLD_MS)
        expect(teacher.get_by_text("The class can't be reached.")).to_be_hidden(timeout=TOLD_MS)
        assert ada.url == room
        before = scene_picture(ada)
        drive(ada)
        until(lambda: not np.array_equal(scene_picture(ada), before))
        until(lambda: status_of_the_room(school) == "driving")
        for page in (ada, teacher):
            page.context.close()
