"""A real Chromium, and a room that it looks at."""

from collections.abc import Iterator

import pytest
import viser
from playwright.sync_api import Browser

from ai4u_edu import CircleShape, ControlRequestor, RBMoveActuator, WASDRBMoveController, World
from ai4u_edu.page.server import lock_viser_port
from tests.browser.served_viser import PLAIN, SPEED, TURN, ServedViser
from tests.builders import small_sim
from tests.chromium import browser
from tests.page.server.rooms import SharedServer, served

pytestmark = pytest.mark.browser


@pytest.fixture(scope="package")
def chromium() -> Iterator[Browser]:
    with browser() as chromium:
        yield chromium


@pytest.fixture(scope="package")
def shared_server() -> Iterator[SharedServer]:
    with SharedServer() as server:
        yield server


@pytest.fixture
def inner() -> Iterator[viser.ViserServer]:
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    lock_viser_port(server)
    server.gui.configure_theme(show_logo=False, show_share_button=False)
    server.scene.add_grid("/grid")
    yield server
    server.stop()


@pytest.fixture
def sim() -> ControlRequestor:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    return small_sim(
        world=world,
        controller=WASDRBMoveController(),
        actuators=[RBMoveActuator(move_amount=SPEED, turn_amount=TURN, jump_power=4)],
        skip_frame=4,
    )


@pytest.fixture
def waits_for_key() -> bool:
    """Return True for a world that waits on its first frame; modules may override it."""
    return False


@pytest.fixture
def site(
    chromium: Browser,
    shared_server: SharedServer,
    inner: viser.ViserServer,
    sim: ControlRequestor,
    waits_for_key: bool,
) -> Iterator[ServedViser]:
    clicks: list[str] = []
    name = inner.gui.add_text("Name", initial_value="")
    button = inner.gui.add_button("Press me")
    button.on_click(lambda _: clicks.append("click"))
    with served(
        sim,
        viser_port=inner.get_port(),
        wait_for_key=waits_for_key,
        server=shared_server,
        wrap=PLAIN.app,
    ) as room:
        site = ServedViser(room, inner, name, clicks, chromium)
        yield site
        site.close(*site.pages)
    assert site.complaints == []
