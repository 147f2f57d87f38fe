"""A network that is gone for a minute: pages say so, and go on where they were."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS
from tests.browser.test_class import agent_of, join
from tests.browser.whole import scene_picture
from tests.chromium import new_page
from tests.classroom.served_class import ServedClass, served_class
from tests.waiting import until
from tests.wifi import Wifi

pytestmark = [pytest.mark.browser, pytest.mark.nightly]
OUTAGE_S = 60
LOST = "No connection to this world"


@contextmanager
def driving(page: Page) -> Iterator[None]:
    """Hold a key, and wait until the world answers."""
    before = agent_of(page)["pose"]
    page.keyboard.down("KeyW")
    until(lambda: agent_of(page)["pose"] != before)
    yield
    page.keyboard.up("KeyW")


def status_of_the_room(school: ServedClass) -> object:
    return school.state()["rooms"][0]["status"]


@pytest.mark.parametrize("with_connections", [True, False])
def test_a_minute_without_wifi(chromium: Browser, tmp_path: Path, with_connections: bool) -> None:
    pings = {"timeouts.ping": DEFAULT_TIMEOUTS.ping}  # by them the class learns of the outage
    with served_class(tmp_path, replaced=pings) as school, Wifi(school.url) as wifi:
        teacher = new_page(chromium, gives_up=True)
        ada = new_page(chromium, draws=True, gives_up=True)
        join(ada, replace(school, url=wifi.url))
        teacher.goto(f"{wifi.url}teacher?token={school.token}")
        room = ada.url
        with driving(ada):
            # real time: the minute itself; all that has to happen in it is waited for
            ends_at = time.monotonic() + OUTAGE_S
            wifi.go()
            expect(ada.get_by_text(LOST)).to_be_visible()
            expect(teacher.get_by_text("The class can't be reached.")).to_be_visible()
            until(lambda: status_of_the_room(school) == "away")
        # real time: what is left of the minute
        time.sleep(max(0.0, ends_at - time.monotonic()))
        wifi.come_back(with_connections=with_connections)

        expect(ada.get_by_text(LOST)).to_be_hidden()
        expect(teacher.get_by_text("The class can't be reached.")).to_be_hidden()
        assert ada.url == room
        before = scene_picture(ada)
        with driving(ada):
            until(lambda: status_of_the_room(school) == "driving")
        until(lambda: not np.array_equal(scene_picture(ada), before))
        for page in (ada, teacher):
            page.context.close()
