"""Bare clients of viser's socket: what all get is packed once, and nobody misses anything."""

import asyncio
import inspect
import re
from collections.abc import Iterator
from contextlib import ExitStack
from functools import partial
from threading import Event
from types import SimpleNamespace
from typing import Any

import msgspec
import pytest
import viser
from viser._messages import GuiUpdateMessage
from viser.infra import _infra
from viser.infra._messages import Message
from websockets.asyncio.server import ServerConnection
from websockets.sync.client import ClientConnection, connect
from websockets.sync.connection import Connection
from websockets.typing import Subprotocol
from zstandard import ZstdDecompressor

from ai4u_edu.base.log_limit import LogLimiter, log_limited
from ai4u_edu.page.viewer.backend import broadcast
from ai4u_edu.page.viewer.backend.broadcast import Broadcaster, LoopEvent
from ai4u_edu.page.viewer.backend.local_server import LocalServer
from tests.load.clients import CAMERA
from tests.page.server.rooms import served
from tests.waiting import LIMIT_S, until

PROXY_URLS: dict[int, str] = {}
"""Addresses that pages use in place of viser's own, by viser's port."""


@pytest.fixture(params=["to viser", "through the proxy"])
def server(request: pytest.FixtureRequest) -> Iterator[LocalServer]:
    server = LocalServer("AI4U Edu")
    with ExitStack() as stack:
        stack.callback(server.stop)
        if request.param == "through the proxy":
            room = stack.enter_context(served(viser_port=server.get_port()))
            PROXY_URLS[server.get_port()] = room.url
            stack.callback(PROXY_URLS.clear)
        yield server


@pytest.fixture
def packings(monkeypatch: pytest.MonkeyPatch) -> list[list[Message]]:
    """Record the messages of each packing."""
    made: list[list[Message]] = []
    pack = broadcast.pack

    def packed(messages: list[Message]) -> bytes:
        made.append(list(messages))
        return pack(messages)

    monkeypatch.setattr(broadcast, "pack", packed)
    return made


def client(server: viser.ViserServer) -> ClientConnection:
    port = server.get_port()
    url = PROXY_URLS.get(port) or f"http://127.0.0.1:{port}"
    return connect(
        url.rstrip("/").replace("http", "ws", 1),
        subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
        compression=None,
        max_size=None,
        max_queue=1,
        proxy=None,
        open_timeout=LIMIT_S,
        ping_interval=None,  # a page that does not read answers no ping
        # real time: the queue is full, so the answer to the close is not seen; it is not waited for
        close_timeout=0.2,
    )


def told(frame: object) -> list[dict[str, Any]]:
    """The messages in a frame."""
    assert isinstance(frame, bytes)
    size = int.from_bytes(frame[8:16], "little")
    inside = ZstdDecompressor().decompress(frame[16 : 16 + size])
    messages: list[dict[str, Any]] = msgspec.msgpack.decode(inside)["messages"]
    return messages


def frame_with(page: Connection, text: str) -> bytes:
    """The first frame in which a text is."""
    while True:
        frame = page.recv(LIMIT_S)
        assert isinstance(frame, bytes)
        if text in str(told(frame)):
            return frame


def marks(messages: list[dict[str, Any]]) -> list[str]:
    """Return the text in angle brackets of each message that has one."""
    found = (re.search(r"<(\w+)>", str(message)) for message in messages)
    return [each[1] for each in found if each]


def settled(server: LocalServer, pages: int) -> Broadcaster:
    """Return the server's broadcaster as soon as `pages` pages are up to date."""
    out: Broadcaster = server._websock_server._broadcast_buffer._ai4u_edu_broadcaster  # type: ignore[attr-defined]
    until(lambda: len(out._pages) == pages)
    until(lambda: not any(waiting(page) for page in out._pages.values()))
    buffer = out._buffer  # a message of another page's arrival may be on its way
    until(lambda: set(buffer.generator_cursors.values()) <= {buffer.message_counter - 1})
    return out


def has_sent(server: LocalServer) -> None:
    """Wake the sender, and wait until it has had its turn."""
    loop = server.get_event_loop()
    buffer = server._websock_server.get_message_buffer()

    async def turn() -> None:
        buffer.message_event.set()
        # the loop's timers are called in their order, and the sender's pause is shorter
        await asyncio.sleep(3 * broadcast.SEND_PERIOD_S)  # real time: by the same loop's clock

    asyncio.run_coroutine_threadsafe(turn(), loop).result(LIMIT_S)


def waiting(page: ServerConnection) -> int:
    """Return the number of bytes that wait for a page."""
    return page.transport.get_write_buffer_size()


def test_it_fits_the_viser_that_is_there(server: LocalServer) -> None:
    assert viser.__version__ == broadcast.VISER_VERSION, "check viewer/backend/broadcast.py"
    assert broadcast.install_broadcaster(server)
    ours, theirs = (inspect.signature(f) for f in (broadcast._produce, broadcast._visers_producer))
    assert list(ours.parameters) == list(theirs.parameters)
    assert "_message_producer" in inspect.getsource(_infra.WebsockServer)


def test_with_another_viser_all_goes_visers_way(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(broadcast, "VISER_VERSION", "0.0.0")
    server = LocalServer("AI4U Edu")
    try:
        with client(server) as page:
            server.gui.add_markdown("hello")
            frame_with(page, "hello")
    finally:
        server.stop()


def test_a_server_that_is_not_ours_goes_visers_way(packings: list[list[Message]]) -> None:
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        server.gui.add_markdown("hello")
        with client(server) as page:
            frame_with(page, "hello")
        assert packings == []
    finally:
        server.stop()


def test_pages_that_are_up_to_date_share_one_packing(
    server: LocalServer, packings: list[list[Message]]
) -> None:
    pages = [client(server) for _ in range(5)]
    settled(server, 5)
    with server.atomic():  # it makes two messages, and the sender may come in between
        server.gui.add_markdown("hello")
    frames = {frame_with(page, "hello") for page in pages}
    assert len(frames) == 1
    assert sum("hello" in str(messages) for messages in packings) == 1
    for page in pages:
        page.close()


def test_late_page_gets_kept_messages_then_the_mark_then_news(
    server: LocalServer,
) -> None:
    text = server.gui.add_markdown("first")
    for number in range(1000):
        text.content = f"old {number}"
    with client(server) as page:
        settled(server, 1)
        text.content = "new"
        seen: list[dict[str, Any]] = []
        while "new" not in str(seen[-1:]):
            seen += told(page.recv(LIMIT_S))
    kinds = [message["type"] for message in seen]
    mark = kinds.index("ReplayDoneMessage")
    assert kinds.count("ReplayDoneMessage") == 1
    assert "old 999" in str(seen[:mark])
    assert "old 998" not in str(seen)
    assert "new" in str(seen[mark:])


def test_atomic_messages_arrive_in_one_frame(server: LocalServer) -> None:
    with client(server) as page:
        settled(server, 1)
        with server.atomic():
            for number in range(300):
                server.scene.add_frame(f"/frame {number}")
                if number == 150:
                    has_sent(server)
        names = [
            message.get("name")
            for message in told(frame_with(page, "/frame 0"))
            if message["type"] == "FrameMessage"
        ]
        assert names == [f"/frame {number}" for number in range(300)]


def test_gui_update_of_one_page_reaches_the_others(server: LocalServer) -> None:
    field = server.gui.add_text("Name", initial_value="before")
    with client(server) as writer, client(server) as reader:
        settled(server, 2)
        update = {
            "type": "GuiUpdateMessage",
            "uuid": field._impl.uuid,
            "updates": {"value": "mine"},
        }
        writer.send(msgspec.msgpack.encode(update))
        frame_with(reader, "mine")
        server.gui.add_markdown("later")
        heard: list[dict[str, Any]] = []
        while "later" not in str(heard[-1:]):
            heard += told(writer.recv(LIMIT_S))
        assert "mine" not in str(heard)


@pytest.mark.slow
@pytest.mark.parametrize(
    "server",
    ["through the proxy", pytest.param("to viser", marks=pytest.mark.nightly)],
    indirect=True,
)
def test_a_page_that_does_not_read_gets_the_newest_when_it_does(server: LocalServer) -> None:
    slow, quick = client(server), client(server)
    out = settled(server, 2)
    text = server.gui.add_markdown("")
    # more than the sockets and the client's queue take
    for number in range(60):
        text.content = f"{number} " + "".join(f"{number * each:x}" for each in range(100_000))
        frame_with(quick, f"{number} ")
    # one frame of it, and not sixty
    assert 0 < max(waiting(page) for page in out._pages.values()) < 2_000_000
    text.content = "the last"
    seen: list[str] = []
    while not seen or "the last" not in seen[-1]:
        seen += [str(message) for message in told(slow.recv(LIMIT_S))]
    assert len(seen) < 55
    for page in (slow, quick):
        page.close()


def test_one_page_s_own_things_come_in_their_order_and_all(server: LocalServer) -> None:
    with client(server) as page:
        settled(server, 1)
        page.send(CAMERA)
        until(server.get_clients)
        (own,) = server.get_clients().values()
        seen: list[str] = []
        for number in range(300):
            own.gui.add_markdown(f"<{number}>")
            # some come one by one, and others while the sender is at work
            while number % 50 == 0 and str(number) not in seen:
                seen += marks(told(page.recv(LIMIT_S)))
        while "299" not in seen:
            seen += marks(told(page.recv(LIMIT_S)))
        assert not own._websock_connection.get_message_buffer().message_from_id
    assert list(dict.fromkeys(seen)) == [str(number) for number in range(300)]


class Unpackable:
    """Nothing that msgpack knows."""


@pytest.mark.parametrize("value", [10**20, -(2**70), Unpackable(), [[{"a": 2**64}]]])
def test_a_message_that_can_not_be_packed_is_left_out(
    server: LocalServer,
    value: object,
    caplog: pytest.LogCaptureFixture,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    limiter = LogLimiter(clock=lambda: 0.0)
    monkeypatch.setattr(broadcast, "log_limited", partial(log_limited, limiter=limiter))
    with client(server) as page:
        settled(server, 1)
        server.gui.add_markdown("<before>")
        server._websock_server.queue_message(GuiUpdateMessage("no widget", {"value": value}))
        server.gui.add_markdown("<after>")
        frame_with(page, "<after>")
        with client(server) as late:  # the message is still kept for later pages
            seen: list[dict[str, Any]] = []
            while "ReplayDoneMessage" not in str(seen):
                seen += told(late.recv(LIMIT_S))
            assert {"before", "after"} <= set(marks(seen))
            assert "no widget" not in str(seen)
            server.gui.add_markdown("<last>")
            frame_with(page, "<last>")
            frame_with(late, "<last>")
    lines = [each for each in caplog.records if each.name == broadcast.__name__]
    assert len(lines) == 1, "they are limited"
    assert not any(each.exc_info for each in caplog.records)


def test_a_page_keeps_what_can_be_packed_of_its_own(server: LocalServer) -> None:
    with client(server) as page:
        settled(server, 1)
        page.send(CAMERA)
        until(server.get_clients)
        (own,) = server.get_clients().values()
        own.gui.add_number("Number", 10**20)
        own.gui.add_markdown("<after>")
        frame_with(page, "<after>")
        server.gui.add_markdown("<for all>".replace(" ", "_"))
        frame_with(page, "<for_all>")


def test_send_errors_do_not_end_the_broadcast(
    server: LocalServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    has_failed = Event()

    def fail(*_: object) -> None:
        has_failed.set()
        raise RuntimeError("no memory")

    with client(server) as page, client(server) as other:
        out = settled(server, 2)
        with monkeypatch.context() as patched:
            patched.setattr(broadcast, "_encode", fail)
            server.gui.add_markdown("<first>")
            server.flush()
            assert has_failed.wait(LIMIT_S)
        server.gui.add_markdown("<last>")
        frame_with(page, "<last>")
        frame_with(other, "<last>")
        assert out._sending is not None
        assert not out._sending.done()


def test_the_event_is_set_in_its_own_thread_only() -> None:
    async def main() -> None:
        event = LoopEvent()
        waits = asyncio.create_task(event.wait())
        await asyncio.sleep(0)
        await asyncio.to_thread(event.set)
        assert not waits.done()
        event.set()
        await asyncio.wait_for(waits, LIMIT_S)

    asyncio.run(main())


@pytest.mark.parametrize("turns", range(5))
def test_a_sender_that_is_woken_and_cancelled_at_once_ends(turns: int) -> None:
    async def main() -> None:
        buffer: Any = SimpleNamespace(
            message_event=asyncio.Event(), flush_event=asyncio.Event(),
            message_counter=0, generator_cursors={}, atomic_counter=1,
        )  # fmt: skip
        buffer.message_event.set()
        sending = asyncio.create_task(Broadcaster(buffer)._send())
        await asyncio.sleep(0)
        buffer.flush_event.set()
        for _ in range(turns):  # of the loop, until the event has woken it
            await asyncio.sleep(0)
        sending.cancel()
        for _ in range(10):
            await asyncio.sleep(0)
        assert sending.cancelled()

    asyncio.run(main())


@pytest.mark.slow
def test_nothing_is_left_of_pages_that_are_gone(server: LocalServer) -> None:
    with client(server), client(server):
        out = settled(server, 2)
    settled(server, 0)
    until(lambda: not out._buffer.generator_cursors)
    assert out._sending is None
    with client(server) as page:
        settled(server, 1)
        server.gui.add_markdown("again")
        frame_with(page, "again")
