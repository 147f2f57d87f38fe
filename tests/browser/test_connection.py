"""The page finds its room under any path, comes back after a loss, and talks to nobody else."""

import time
from collections.abc import Iterator

import pytest
import viser
from playwright.sync_api import Browser, expect
from starlette.applications import Starlette

from ai4u_edu import ControlRequestor
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server import RoomMount, ServerThread, room_app
from tests.browser.panel_page import panel_room
from tests.browser.served_viser import PLAIN, ServedViser, connected, driver_status, ready
from tests.chromium import new_page
from tests.server.rooms import Room, free_port, served
from tests.waiting import until
from tests.wifi import Wifi

SENT = """performance.getEntriesByType("resource")
    .filter((each) => each.name.includes("/web")).map((each) => each.transferSize)"""
"""Script that returns how much of each of our files came over the network (bytes)."""
pytestmark = pytest.mark.browser


@pytest.mark.parametrize("end", [pytest.param("/", marks=pytest.mark.nightly), "", "/?agent=0"])
def test_a_room_under_a_path(
    chromium: Browser, inner: viser.ViserServer, sim: ControlRequestor, end: str
) -> None:
    name = inner.gui.add_text("Name", initial_value="")
    with served(
        sim,
        viser_port=inner.get_port(),
        wrap=lambda app: Starlette(routes=[RoomMount("/user/ann/room", app)]),
    ) as room:
        page = new_page(chromium)
        page.goto(f"{room.url}user/ann/room{end}")
        ready(page)
        page.keyboard.down("KeyW")
        expect(driver_status(page)).to_have_text("You drive")
        until(lambda: room.held == ["KeyW"])
        page.keyboard.up("KeyW")
        page.get_by_role("textbox").first.fill("hello")
        until(lambda: name.value == "hello")
        page.context.close()


def test_a_page_comes_back_after_the_server_did(
    chromium: Browser, inner: viser.ViserServer, sim: ControlRequestor
) -> None:
    runner = Runner(sim)
    runner.start()
    room = Room(runner, "")
    port = free_port()
    app = room_app(runner, viser_port=inner.get_port(), title="A room")
    page = new_page(chromium)
    with ServerThread(app, port=port) as server:
        page.goto(server.url)
        ready(page)
        page.keyboard.down("KeyW")
        until(lambda: room.held == ["KeyW"])
    expect(driver_status(page)).to_have_text("Connecting …")
    until(lambda: room.held == [])
    with ServerThread(app, port=port):
        expect(driver_status(page)).to_have_text("Press a key to drive")
        time.sleep(0.3)
        assert room.held == [], "a key that was lost has to be pressed anew"
        page.keyboard.up("KeyW")
        page.keyboard.down("KeyW")
        until(lambda: room.held == ["KeyW"])
        page.context.close()
    runner.stop()


@pytest.mark.parametrize("with_connections", [True, False])
def test_a_page_notices_that_its_network_is_gone_and_comes_back(
    site: ServedViser, with_connections: bool
) -> None:
    """Nothing is closed: as without Wi-Fi."""
    with Wifi(site.room.url) as wifi:
        page = new_page(site.chromium)
        site.pages.append(page)
        PLAIN.serve(page, wifi.url)
        page.clock.install()
        page.goto(wifi.url)
        connected(page)
        page.keyboard.down("KeyW")
        until(lambda: site.room.held == ["KeyW"])
        page.wait_for_timeout(100)  # for the first keepalive
        wifi.go()
        until(lambda: site.room.held == [])
        page.clock.fast_forward(9000)
        expect(driver_status(page)).to_have_text("Connecting …")
        page.clock.fast_forward(4000)
        lost = page.get_by_role("alert").filter(has_text="No connection to this world")
        expect(lost).to_be_visible()
        wifi.come_back(with_connections=with_connections)
        page.clock.fast_forward(5000)
        expect(driver_status(page)).to_have_text("Press a key to drive")
        expect(lost).to_be_hidden()
        page.keyboard.up("KeyW")
        page.keyboard.down("KeyW")
        until(lambda: site.room.held == ["KeyW"])


@pytest.fixture
def other() -> Iterator[viser.ViserServer]:
    """A viser that nobody guards."""
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


@pytest.mark.parametrize("guarded", [True, pytest.param(False, marks=pytest.mark.nightly)])
def test_a_link_cannot_send_the_page_to_another_viser(
    site: ServedViser, other: viser.ViserServer, guarded: bool
) -> None:
    page = new_page(site.chromium, bypass_csp=not guarded)
    page.goto(f"{site.room.url}?websocket=ws://127.0.0.1:{other.get_port()}")
    ready(page)
    if guarded:
        page.wait_for_timeout(1000)
        assert other.get_clients() == {}
    else:
        until(other.get_clients)
    page.context.close()


def test_a_foreign_page_neither_drives_nor_reads(
    site: ServedViser, other: viser.ViserServer
) -> None:
    page = new_page(site.chromium)
    page.route("http://evil.example/", lambda route: route.fulfill(body="<p>evil</p>"))
    page.goto("http://evil.example/")
    listen = """([url, protocols]) => new Promise((done) => {
        const socket = new WebSocket(url, protocols);
        socket.onmessage = () => done("heard");
        socket.onclose = () => done("refused");
    })"""
    version = [f"viser-v{viser.__version__}"]
    address = site.room.url.replace("http", "ws", 1)
    inner = f"ws://127.0.0.1:{site.inner.get_port()}"
    for url, protocols in [(address, version), (address + "ws/input", []), (inner, version)]:
        assert page.evaluate(listen, [url, protocols]) == "refused"
    unguarded = f"ws://127.0.0.1:{other.get_port()}"
    assert page.evaluate(listen, [unguarded, version]) == "heard", "the browser forbids nothing"
    read = "url => fetch(url).then(() => 'read', () => 'refused')"
    assert page.evaluate(read, site.room.url + "api/snapshot") == "refused"
    page.context.close()


def test_a_page_that_is_loaded_again_asks_for_none_of_our_files(chromium: Browser) -> None:
    with panel_room() as room:
        page = new_page(chromium)
        page.goto(room.url)
        connected(page)
        assert min(sizes := page.evaluate(SENT)) > 0
        page.reload()
        connected(page)
        assert page.evaluate(SENT) == [0] * len(sizes)
        page.context.close()
