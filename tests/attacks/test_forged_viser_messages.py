"""Messages that no page of viser's sends: whatever they say, all pages are as they were."""

import gc
import logging
import time
from collections.abc import Iterator
from contextlib import contextmanager
from copy import copy
from typing import Any, NamedTuple

import msgspec
import pytest
import viser
from websockets.exceptions import ConnectionClosed
from websockets.sync.connection import Connection
from websockets.typing import Subprotocol
from zstandard import ZstdDecompressor

from ai4u_edu.page.server import ServerThread, lock_viser_port, proxy, room_app
from ai4u_edu.page.server.proxy import MAX_UPWARD_BYTES
from ai4u_edu.page.viewer import Viewer
from tests.page.editing.harness import EditorHarness
from tests.page.server.rooms import PATIENT, log_intervals, open_socket
from tests.page.viewer.pages import Page, shown
from tests.waiting import LIMIT_S, until


class Room(NamedTuple):
    url: str
    viewer: Viewer
    harness: EditorHarness
    began: float
    """Time (s, of time.monotonic) at which it did."""


@pytest.fixture
def room(monkeypatch: pytest.MonkeyPatch) -> Iterator[Room]:
    """A world that stands still, and all that a room has."""
    monkeypatch.setattr(
        proxy, "MAX_MESSAGES_PER_S", 1e9
    )  # these tests are not to take as long as a page would
    harness = EditorHarness(record=True)
    harness.runner.pause()
    harness.runner.start()
    viewer = Viewer(harness.runner, editor=harness.editor)
    lock_viser_port(viewer.server)
    try:
        app = room_app(harness.runner, viser_port=viewer.port, title="A room", timeouts=PATIENT)
        with ServerThread(app, timeouts=PATIENT) as server:
            # real time: for the number of lines that a log may have
            yield Room(server.url, viewer, harness, time.monotonic())
    finally:
        viewer.stop()
        harness.runner.stop(LIMIT_S)


@contextmanager
def connected(room: Room) -> Iterator[Connection]:
    with open_socket(
        room.url,
        origin=room.url.rstrip("/"),
        subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
        max_size=None,
        compression=None,
    ) as connection:
        yield connection


@contextmanager
def page(room: Room) -> Iterator[Page]:
    """A page as the browser opens it, of which everything is there."""
    before = len(room.viewer.server.get_clients())
    with connected(room) as connection:
        here = Page(connection)
        here.report_camera()
        until(lambda: len(room.viewer.server.get_clients()) == before + 1)
        room.viewer.viewer_clients.refresh()
        shown(room.viewer)
        yield here


def caught_up(room: Room, here: Page, place: float) -> None:
    """Wait until all that a page has said was heard."""
    (client,) = room.viewer.server.get_clients().values()
    here.report_camera(position=(place, 0.0, 3.0))
    until(lambda: client.camera.position[0] == place)


def state_of(room: Room) -> dict[int, Any]:
    """Return what a page that is opened later is told."""
    web = room.viewer.server._websock_server
    return {number: copy(each) for number, each in web._broadcast_buffer.message_from_id.items()}


@pytest.fixture(autouse=True)
def nothing_said_before(
    caplog: pytest.LogCaptureFixture, capfd: pytest.CaptureFixture[str]
) -> None:
    """Let what other tests have left tell of its end now, and not in this test's log."""
    gc.collect()
    caplog.clear()
    capfd.readouterr()


def unharmed(
    room: Room, caplog: pytest.LogCaptureFixture, capfd: pytest.CaptureFixture[str]
) -> None:
    gc.collect()  # a task whose exception nobody has asked for tells of it when it goes
    # this test's own client is surprised when it is cut off
    records = [each for each in caplog.records if each.name != "websockets.client"]
    assert [each.getMessage() for each in records if each.exc_info] == []
    assert {each.name for each in records if each.levelno >= logging.WARNING} <= {
        "ai4u_edu.page.server.proxy",
    }
    assert len(records) < 20 * log_intervals(room.began)
    assert "Traceback" not in "".join(capfd.readouterr())


def in_order(room: Room) -> None:
    """A page that comes later gets all there is."""
    with connected(room) as late:
        kinds: set[Any] = set()
        while "ReplayDoneMessage" not in kinds:
            kinds |= {message["type"] for message in told(late.recv(LIMIT_S))}
        assert "BatchedMeshesMessage" in kinds


def told(frame: Any) -> list[dict[str, Any]]:
    size = int.from_bytes(frame[8:16], "little")
    inside = ZstdDecompressor().decompress(frame[16 : 16 + size])
    messages: list[dict[str, Any]] = msgspec.msgpack.decode(inside)["messages"]
    return messages


def test_no_other_message_of_visers_has_an_effect(
    room: Room, caplog: pytest.LogCaptureFixture, capfd: pytest.CaptureFixture[str]
) -> None:
    """Every type of message that viser knows, with fields that fit it."""
    with page(room) as here:
        caught_up(room, here, 1.0)
        before = state_of(room)
        for kind in viser._messages.Message.get_subclasses():
            here.say(kind.__name__)
            here.say(kind.__name__, uuid="none", name="/bodies0", owner="", key="a", value="b")
        for name in ("value", "update_cb", "__class__"):
            here.say("GuiUpdateMessage", uuid="none", updates={name: []})
            here.say("GuiUpdateMessage", uuid="none", updates={name: 1})
        here.say("GuiFormDirtyMessage", uuid="none")
        here.say("GuiFormSubmitMessage", uuid="none")
        upload(here)
        caught_up(room, here, 2.0)
        assert state_of(room) == before
        for client in room.viewer.server.get_clients().values():
            assert not client.gui._current_file_upload_states
        in_order(room)
    unharmed(room, caplog, capfd)


def upload(here: Page) -> None:
    """Send a file that nobody has asked for."""
    here.say(
        "FileTransferStartUpload",
        source_component_uuid="none",
        transfer_uuid="t",
        filename="f",
        mime_type="",
        part_count=1,
        size_bytes=7,
    )
    here.say(
        "FileTransferPart",
        source_component_uuid="none",
        transfer_uuid="t",
        part_index=0,
        content=b"content",
    )


@pytest.mark.parametrize(
    ("frame", "code"),
    [
        (b"", 1003),
        (b"\xc1", 1003),
        (b"\x81\xa4type\xa2\xff\xfe", 1003),
        (b"\x81\xa1a" + b"\x91" * 100_000 + b"\x01", 1003),
        ("text", 1003),
        (b"\x00" * 2 * MAX_UPWARD_BYTES, 1009),
        (b"\x00" * 60_000_000, 1009),
    ],
)
def test_what_is_no_message_ends_that_connection_alone(
    room: Room,
    caplog: pytest.LogCaptureFixture,
    capfd: pytest.CaptureFixture[str],
    frame: bytes | str,
    code: int,
) -> None:
    with page(room):
        with connected(room) as here:
            with pytest.raises(ConnectionClosed) as closed:  # noqa: PT012 - what comes first varies
                here.send(frame)
                while True:
                    here.recv(LIMIT_S)
            if len(frame) < 10_000_000:  # of a larger one not even all is read
                assert closed.value.rcvd is not None
                assert closed.value.rcvd.code == code
        in_order(room)
    unharmed(room, caplog, capfd)
