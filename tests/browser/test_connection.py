"""The page finds its room under any path, comes back after a loss, and talks to nobody else."""

from collections.abc import Iterator

import pytest
import viser
from playwright.sync_api import Browser, Page, expect
from starlette.applications import Starlette

from ai4u_edu import ControlRequestor
from ai4u_edu.blocks.keyboard import Keyboard
from ai4u_edu.page.server import RoomMount, ServerThread, room_app
from ai4u_edu.runtime.runner import Runner
from tests.browser.kept_port import kept_port
from tests.browser.panel_page import panel_room
from tests.browser.served_viser import (
    PLAIN,
    ServedViser,
    connected,
    driver_status,
    ready,
    recorded_holds,
)
from tests.chromium import new_page, until_on
from tests.page.server.rooms import PATIENT, Clock, Room, served
from tests.waiting import LIMIT_S, until
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
        expect(driver_status(page)).to_have_text("You're driving")
        until(lambda: room.held == ["KeyW"])
        page.keyboard.up("KeyW")
        page.get_by_role("textbox").first.fill("hello")
        until(lambda: name.value == "hello")
        page.context.close()


def test_a_page_comes_back_after_the_server_did(
    chromium: Browser, inner: viser.ViserServer, sim: ControlRequestor
) -> None:
    for agent in sim.agents:
        agent.keyboard = Keyboard(clock=Clock())  # keys are released, and not forgotten
    runner = Runner(sim)
    runner.start()
    room = Room(runner, "")
    app = room_app(runner, viser_port=inner.get_port(), title="A room", timeouts=PATIENT)
    page = new_page(chromium)
    with kept_port() as port:
        with ServerThread(app, port=port, timeouts=PATIENT) as server:
            page.goto(server.url)
            ready(page)
            page.keyboard.down("KeyW")
            until(lambda: room.held == ["KeyW"])
        expect(driver_status(page)).to_have_text("Connecting …")
        until(lambda: room.held == [])
        with ServerThread(app, port=port, timeouts=PATIENT), recorded_holds(room) as holds:
            expect(driver_status(page)).to_have_text("Press a key to drive")
            page.keyboard.down("KeyA")
            until(lambda: "KeyA" in room.held)
            assert holds[0] == ["KeyA"], "a key that was lost has to be pressed again"
            page.keyboard.up("KeyW")
            page.keyboard.down("KeyW")
            until(lambda: room.held == ["KeyA", "KeyW"])
            page.context.close()
    runner.stop(LIMIT_S)


@pytest.mark.parametrize("with_connections", [True, False])
def test_a_page_notices_that_its_network_is_gone_and_comes_back(
    chromium: Browser, sim: ControlRequestor, with_connections: bool
) -> None:
    """Nothing is closed: as without Wi-Fi."""
    key_clock = Clock()
    with served(sim, key_clock=key_clock) as room, Wifi(room.url) as wifi:
        page = new_page(chromium, gives_up=True)
        keepalives: list[str | bytes] = []

        def note(frame: str | bytes) -> None:
            if "keepalive" in str(frame):
                keepalives.append(frame)

        page.on("websocket", lambda socket: socket.on("framereceived", note))
        PLAIN.serve(page, wifi.url)
        page.clock.install()
        page.goto(wifi.url)
        connected(page)
        page.keyboard.down("KeyW")
        until(lambda: room.held == ["KeyW"])
        until_on(page, lambda: keepalives)  # only then the page misses them
        wifi.go()

        def is_forgotten() -> bool:
            key_clock.now += 1
            return room.held == []

        until(is_forgotten)
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
        until(lambda: room.held == ["KeyW"])
        page.context.close()


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
    said: list[str] = []
    session = page.context.new_cdp_session(page)
    session.on("Log.entryAdded", lambda event: said.append(event["entry"]["text"]))
    session.send("Log.enable")  # viser connects in a worker, whose errors are told there alone
    address = f"ws://127.0.0.1:{other.get_port()}"
    page.goto(f"{site.room.url}?websocket={address}")
    ready(page)
    if guarded:
        until_on(page, lambda: any(address in text and "has been blocked" in text for text in said))
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


def panel_is_there(page: Page) -> None:
    """Wait until a page has all of its files; the last ones are those of the panel."""
    connected(page)
    expect(page.get_by_role("tab", name="Past")).to_be_attached()


def test_a_page_that_is_loaded_again_asks_for_none_of_our_files(chromium: Browser) -> None:
    with panel_room() as room:
        page = new_page(chromium)
        page.goto(room.url)
        panel_is_there(page)
        assert min(sizes := page.evaluate(SENT)) > 0
        page.reload()
        panel_is_there(page)
        assert page.evaluate(SENT) == [0] * len(sizes)
        page.context.close()
