"""viser behind our port: a real one, and stand-ins that misbehave."""

import asyncio
import errno
import socket
import threading
import time
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from typing import Any

import msgspec
import pytest
import viser
from viser.infra._messages import wire_field_names
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection
from websockets.typing import Subprotocol
from zstandard import ZstdDecompressor

from ai4u_edu.page.server import page_messages, proxy
from tests.load.clients import CAMERA
from tests.page.server.rooms import PATIENT, UPGRADE, Room, open_socket, raw_request, served
from tests.waiting import LIMIT_S, until

PROTOCOL = Subprotocol(f"viser-v{viser.__version__}")


def client(room: Room, protocol: str = PROTOCOL) -> ClientConnection:
    return open_socket(
        room.url.rstrip("/"),
        subprotocols=[Subprotocol(protocol)],
        compression=None,
        max_size=None,
    )


@pytest.fixture
def inner() -> Iterator[viser.ViserServer]:
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


@pytest.fixture
def room(inner: viser.ViserServer) -> Iterator[Room]:
    with served(viser_port=inner.get_port()) as room:
        yield room


def told(frame: object) -> list[dict[str, object]]:
    """The messages in a frame of viser's."""
    assert isinstance(frame, bytes)
    size = int.from_bytes(frame[8:16], "little")
    inside = ZstdDecompressor().decompress(frame[16 : 16 + size])
    messages: list[dict[str, object]] = msgspec.msgpack.decode(inside)["messages"]
    return messages


def test_visers_frames_come_through_and_go_back(room: Room, inner: viser.ViserServer) -> None:
    field = inner.gui.add_text("Name", initial_value="before")
    with client(room) as page:
        assert page.subprotocol == PROTOCOL
        uuid = None
        while uuid is None:
            for message in told(page.recv(LIMIT_S)):
                if message["type"] == "GuiTextMessage":
                    uuid = message["uuid"]
        update = {"type": "GuiUpdateMessage", "uuid": uuid, "updates": {"value": "after"}}
        page.send(msgspec.msgpack.encode(update))
        until(lambda: field.value == "after")
        inner.gui.add_markdown("from below")
        while not any("from below" in str(message) for message in told(page.recv(LIMIT_S))):
            pass


def test_another_version_is_told_why_it_is_sent_away(room: Room) -> None:
    with client(room, "viser-v0.0.1") as page:
        assert page.subprotocol == "viser-v0.0.1"
        with pytest.raises(ConnectionClosed) as closed:
            page.recv(LIMIT_S)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1002
        assert "Version mismatch" in closed.value.rcvd.reason


def test_a_page_that_goes_is_gone_for_viser_too(room: Room, inner: viser.ViserServer) -> None:
    with client(room) as page:
        page.recv(LIMIT_S)
        until(lambda: inner._websock_server._live_connections)
    until(lambda: not inner._websock_server._live_connections)


@pytest.mark.parametrize("kind", ["ShareUrlRequest", "ShareUrlDisconnect"])
def test_no_page_can_open_a_tunnel(
    room: Room, inner: viser.ViserServer, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[str] = []
    monkeypatch.setattr(inner, "request_share_url", lambda: asked.append("request"))
    monkeypatch.setattr(inner, "disconnect_share_url", lambda: asked.append("disconnect"))
    field = inner.gui.add_text("Name", initial_value="before")
    with client(room) as page:
        page.recv(LIMIT_S)
        page.send(msgspec.msgpack.encode({"type": kind}))
        update = {"type": "GuiUpdateMessage", "uuid": field._impl.uuid, "updates": {"value": "x"}}
        page.send(msgspec.msgpack.encode(update))
        until(lambda: field.value == "x")
    assert asked == []


def test_text_is_not_visers_language(room: Room) -> None:
    with client(room) as page:
        page.recv(LIMIT_S)
        page.send("hello")
        with pytest.raises(ConnectionClosed):  # noqa: PT012 - frames may come before
            while True:
                page.recv(LIMIT_S)


Behaviour = Callable[[ServerConnection], Awaitable[None]]


@contextmanager
def stand_in(behave: Behaviour) -> Iterator[int]:
    """Something in viser's place that behaves as told; its port."""
    ports: list[int] = []
    ready = threading.Event()
    loop = asyncio.new_event_loop()
    loop.set_exception_handler(tell_unless_cut_off)
    end = asyncio.Event()

    async def run() -> None:
        async with serve(behave, "127.0.0.1", 0, compression=None, max_size=None) as server:
            ports.append(next(iter(server.sockets)).getsockname()[1])
            ready.set()
            await end.wait()

    thread = threading.Thread(target=lambda: loop.run_until_complete(run()))
    thread.start()
    ready.wait()
    try:
        yield ports[0]
    finally:
        loop.call_soon_threadsafe(end.set)
        thread.join()
        loop.close()


def tell_unless_cut_off(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """Tell of an error, but not of a stream's end that is sent after the other side was cut off.

    asyncio does not catch it where the end had to wait for a full buffer.
    """
    error = context.get("exception")
    if not isinstance(error, OSError) or error.errno != errno.ENOTCONN:
        loop.default_exception_handler(context)


def typed(size: int) -> dict[str, object]:
    """Return a message with a text of that many characters."""
    return {"type": "GuiUpdateMessage", "uuid": "1", "updates": {"value": "x" * size}}


def test_large_frames_come_through_whole_in_both_directions() -> None:
    async def echo(connection: ServerConnection) -> None:
        async for frame in connection:
            await connection.send(frame)
            await connection.send(bytes(40 * len(frame)))

    with stand_in(echo) as port, served(viser_port=port) as room, client(room) as page:
        for size in (0, 1, 125, 126, 65536, 200_000):
            page.send(msgspec.msgpack.encode(typed(size)))
            frame = page.recv(LIMIT_S)
            assert isinstance(frame, bytes)
            assert msgspec.msgpack.decode(frame) == typed(size)
            assert page.recv(LIMIT_S) == bytes(40 * len(frame))


def test_proxy_forwards_only_validated_messages() -> None:
    heard: list[bytes] = []

    async def listen(connection: ServerConnection) -> None:
        async for frame in connection:
            assert isinstance(frame, bytes)
            heard.append(frame)

    update = {"type": "GuiUpdateMessage", "uuid": "1", "updates": {"value": 1}}
    first_kind = msgspec.msgpack.encode(update)
    with stand_in(listen) as port, served(viser_port=port) as room, client(room) as page:
        # which of two types it is would be up to the reader
        page.send(b"\x84" + first_kind[1:] + b"\xa4type\xafShareUrlRequest")
        page.send(msgspec.msgpack.encode(update | {"owner": ""}))
        page.send(msgspec.msgpack.encode(dict(reversed(update.items()))))
        until(lambda: heard)
    (frame,) = heard
    assert msgspec.msgpack.decode(frame) == update


def test_the_fields_are_those_of_visers_own_messages() -> None:
    theirs = viser._messages.Message._subclass_from_type_string()
    for kind in page_messages.KINDS:
        fields = wire_field_names(theirs[kind.__name__])  # type: ignore[arg-type]  # lru_cache
        assert kind.__struct_fields__ == fields, "look whether server/page_messages.py still fits"


@pytest.mark.parametrize("kind", page_messages.KINDS)
def test_validated_messages_are_readable_by_viser(kind: type[msgspec.Struct]) -> None:
    texts = {"phase": "start", "button": "left", "modifier": None, "instance_index": None}
    numbers = {"wxyz": [1.5] * 4, "screen_pos": [1, 2]}
    values: dict[str, object] = {"updates": {"value": "x"}, "content": b"x"} | texts | numbers
    for name in kind.__struct_fields__:
        if "screen" in name:
            values.setdefault(name, [0.5, 1])
        elif name in ("position", "look_at") or name.endswith(("direction", "origin", "position")):
            values.setdefault(name, [0, 1.5, -2])
        elif name in ("fov", "near", "far") or name.startswith(("image", "part", "size")):
            values.setdefault(name, 7)
        else:
            values.setdefault(name, "name")
    said = {"type": kind.__name__, **{name: values[name] for name in kind.__struct_fields__}}
    checked = page_messages.checked(msgspec.msgpack.encode(said))
    message = viser._messages.Message.deserialize(checked)
    assert type(message).__name__ == kind.__name__
    assert all(hasattr(message, name) for name in kind.__struct_fields__)


@pytest.mark.parametrize("number", [float("nan"), float("inf"), -1e300, 2**64 - 1, "1", None, [1]])
@pytest.mark.parametrize("name", ["fov", "near", "image_width", "image_height"])
def test_a_camera_is_finite(name: str, number: object) -> None:
    camera = msgspec.msgpack.decode(CAMERA)
    assert page_messages.checked(CAMERA)
    with pytest.raises(ValueError, match=name):
        page_messages.checked(msgspec.msgpack.encode(camera | {name: number}))
    for vector in ("position", "look_at", "up_direction", "wxyz"):
        spoilt = [number, *camera[vector][1:]]
        with pytest.raises(ValueError, match=vector):
            page_messages.checked(msgspec.msgpack.encode(camera | {vector: spoilt}))


@pytest.mark.parametrize(
    "said",
    [
        "ai4u_edu_agent=" + "a" * 8000,
        "ai4u_edu_agent=\xff\xfe; ai4u_edu_dark=\xff",
        'ai4u_edu_agent="red\\015\\012Origin: x"; ai4u_edu_dark="\\000"',
        "; ; =;==;ai4u_edu_agent;ai4u_edu_dark",
        "ai4u_edu_agent=%00%0d%0a%ff",
    ],
)
def test_a_page_with_odd_cookies_is_a_page(
    room: Room, said: str, caplog: pytest.LogCaptureFixture
) -> None:
    with raw_request(
        room.url, "Host: localhost", f"Sec-WebSocket-Protocol: {PROTOCOL}", f"Cookie: {said}",
        *UPGRADE,
    ) as page:  # fmt: skip
        answer = b""
        while not answer.partition(b"\r\n\r\n")[2]:  # until viser talks
            part = page.recv(4096)
            assert part, answer
            answer += part
        assert answer.startswith(b"HTTP/1.1 101 ")
    assert caplog.records == []


def test_odd_subprotocols_are_left_out(room: Room, caplog: pytest.LogCaptureFixture) -> None:
    offered = ", ".join(["x" * 100, "\xe9", "a b", *["many"] * 50, PROTOCOL])
    with raw_request(
        room.url, "Host: localhost", f"Sec-WebSocket-Protocol: {offered}", *UPGRADE
    ) as page:
        assert page.recv(4096).startswith(b"HTTP/1.1 ")
    assert caplog.records == []


def test_viser_closing_closes_the_page_with_its_words() -> None:
    async def dismiss(connection: ServerConnection) -> None:
        await connection.close(1000, "enough for today")

    with stand_in(dismiss) as port, served(viser_port=port) as room, client(room) as page:
        with pytest.raises(ConnectionClosed) as closed:
            page.recv(LIMIT_S)
        assert closed.value.rcvd is not None
        assert (closed.value.rcvd.code, closed.value.rcvd.reason) == (1000, "enough for today")


def test_frames_keep_their_order_whether_the_page_is_slow_or_not() -> None:
    """Frames queued for a slow page are not overtaken by later ones."""
    frames = [str(number).encode() * (1 + number * 977 % 20_011) for number in range(600)]

    async def pour(connection: ServerConnection) -> None:
        for number, frame in enumerate(frames):
            whole = number % 7
            await connection.send(frame if whole else [frame[:1], frame[1:]])  # in two pieces
        await connection.wait_closed()

    with stand_in(pour) as port, served(viser_port=port) as room, client(room) as page:
        for number, frame in enumerate(frames):
            if number % 100 == 0:
                time.sleep(0.1)  # real time: a slow page; one that is slower still gets the same
            assert page.recv(LIMIT_S) == frame


def test_a_viser_that_breaks_off_closes_the_page() -> None:
    async def break_off(connection: ServerConnection) -> None:
        connection.transport.abort()

    with stand_in(break_off) as port, served(viser_port=port) as room, client(room) as page:
        with pytest.raises(ConnectionClosed) as closed:
            page.recv(LIMIT_S)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1001


def test_no_viser_is_no_connection() -> None:
    with served() as room, pytest.raises(InvalidStatus):
        client(room)


@pytest.mark.slow
def test_a_slow_page_slows_its_stream_down_and_nothing_piles_up(
    caplog: pytest.LogCaptureFixture,
) -> None:
    chunk, sent = b"\x00" * 100_000, list[int]()

    async def pour(connection: ServerConnection) -> None:
        number = len(sent)
        sent.append(0)
        with suppress(ConnectionClosed):
            while True:
                await connection.send(chunk)
                sent[number] += len(chunk)

    # a server that waited for the slow page at its end would say in its log that this took too long
    timeouts = replace(PATIENT, shutdown=LIMIT_S)
    with stand_in(pour) as port, served(viser_port=port, timeouts=timeouts) as room:
        slow = raw_request(room.url, "Host: localhost", *UPGRADE)
        until(lambda: sent)
        unchanged = 0
        while unchanged < 5:
            before = sent[0]
            with raw_request(room.url, "Host: localhost", *UPGRADE) as quick:
                # so all who pass frames on had their turn
                for _ in range(len(chunk) // 1000):
                    assert quick.recv(1000)
            unchanged = unchanged + 1 if sent[0] == before else 0
            assert sent[0] < 20_000_000, "what lies in the buffers of the system, and no more"
    slow.close()
    assert caplog.records == []


@pytest.mark.slow
def test_a_page_that_floods_viser_is_slowed_down(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(proxy, "MAX_MESSAGES_PER_S", 10)
    heard = 0

    async def listen(connection: ServerConnection) -> None:
        nonlocal heard
        async for _ in connection:
            heard += 1

    update = msgspec.msgpack.encode(
        {"type": "GuiUpdateMessage", "uuid": "1", "updates": {"value": 1}}
    )

    def flood(page: ClientConnection) -> None:
        with suppress(ConnectionClosed, OSError):
            while True:
                page.send(update)

    with stand_in(listen) as port, served(viser_port=port) as room, client(room) as page:
        began = time.monotonic()  # real time: it lasts longer on a busy machine
        thread = threading.Thread(target=flood, args=(page,))
        thread.start()
        until(lambda: heard >= 20)  # ten at once, and ten a second
        # real time: a lower bound, from before the first one was sent
        assert time.monotonic() - began > 0.85
        page.socket.shutdown(socket.SHUT_RDWR)
        thread.join()
