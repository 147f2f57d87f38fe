"""Messages that no page of viser's sends: whatever they say, all pages are as they were."""

import gc
import logging
import math
from collections.abc import Iterator
from contextlib import contextmanager
from copy import copy
from typing import Any, NamedTuple

import msgspec
import pytest
import viser
from viser._gui_api import GuiApi
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.sync.connection import Connection
from websockets.typing import Subprotocol
from zstandard import ZstdDecompressor

from ai4u_edu.server import ServerThread, lock_viser_port, page_messages, proxy, room_app
from ai4u_edu.server.page_messages import MAX_PART_BYTES
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.blocks_tab import BlocksTab
from ai4u_edu.viewer.panel.controls import Controls
from ai4u_edu.viewer.panel.world_tab import WorldTab
from ai4u_edu.viewer.replay.replay_tab import ReplayTab
from tests.editing.harness import EditorHarness
from tests.viewer.pages import Page, part_of, seen, shown, tabs_of, until

ODD_VALUES: tuple[Any, ...] = (
    *(math.nan, math.inf, -math.inf, 1e20, -1e300, 2**53, 2**63, 2**64 - 1, -(2**63), 0.5),
    *("", "no such choice", "x" * 250_000, "\0", b"", b"bytes", None, True, False),
    *([], [1, 2], [[[[1]]]], {}, {"a": {"b": 1}}, [math.nan], msgspec.msgpack.Ext(1, b"x")),
)


class Room(NamedTuple):
    url: str
    viewer: Viewer
    harness: EditorHarness


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
        with ServerThread(
            room_app(harness.runner, viser_port=viewer.port, title="A room")
        ) as server:
            yield Room(server.url, viewer, harness)
    finally:
        viewer.stop()
        harness.runner.stop()


@pytest.fixture(params=["the proxy and the viewer", "the viewer alone"])
def checks(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of both checks does without the other, as far as it goes."""
    if request.param == "the viewer alone":
        monkeypatch.setattr(page_messages, "checked", lambda frame: frame)


@contextmanager
def connected(room: Room) -> Iterator[Connection]:
    with connect(
        room.url.replace("http", "ws", 1),
        origin=room.url.rstrip("/"),  # type: ignore[arg-type]  # a NewType of str
        subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
        max_size=None,
        compression=None,
        proxy=None,
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


def all_open(room: Room, here: Page) -> None:
    """Open every form of a page."""
    viewer = room.viewer
    (blocks,), (world,) = tabs_of(viewer, BlocksTab), tabs_of(viewer, WorldTab)
    here.change(blocks.block, "1 BearingSensor")
    here.press(blocks.settings.button)
    here.press(world.settings.button)
    here.change(world.body_list, "wall")
    here.change(world.drag_enabled, True)
    seen(viewer, lambda: blocks.form and world.form and blocks.settings.form)
    seen(viewer, lambda: world.settings.form and world.handles.node)


def caught_up(room: Room, here: Page, place: float) -> None:
    """Wait until all that a page has said was heard."""
    (client,) = room.viewer.server.get_clients().values()
    here.report_camera(position=(place, 0.0, 3.0))
    until(lambda: client.camera.position[0] == place)


def guis(room: Room) -> list[GuiApi]:
    return [room.viewer.server.gui, *(c.gui for c in room.viewer.server.get_clients().values())]


def widgets(room: Room) -> dict[str, Any]:
    return {
        uuid: each for gui in guis(room) for uuid, each in gui._gui_input_handle_from_uuid.items()
    }


def state_of(room: Room) -> dict[str, tuple[Any, Any]]:
    """All attributes of all widgets, and what a page that is opened later is told."""
    web = room.viewer.server._websock_server
    told = {str(n): (None, copy(m)) for n, m in web._broadcast_buffer.message_from_id.items()}
    kept = {
        uuid: (copy(vars(each._impl)), copy(vars(each._impl.props)))
        for uuid, each in widgets(room).items()
    }
    return told | kept


def unharmed(caplog: pytest.LogCaptureFixture, capfd: pytest.CaptureFixture[str]) -> None:
    gc.collect()  # a task whose exception nobody has asked for tells of it when it goes
    # this test's own client is surprised when it is cut off
    records = [each for each in caplog.records if each.name != "websockets.client"]
    assert [each.getMessage() for each in records if each.exc_info] == []
    assert {each.name for each in records if each.levelno >= logging.WARNING} <= {
        "ai4u_edu.server.proxy",
        "ai4u_edu.viewer.backend.incoming",
    }
    assert len(records) < 20
    assert "Traceback" not in "".join(capfd.readouterr())


def in_order(room: Room, other: Page) -> None:
    """All that a page can do for everybody works from another one, and it shows."""
    controls, runner = part_of(room.viewer, Controls), room.harness.runner
    seen(room.viewer, lambda: "Resume" in controls.time_buttons.options)
    other.change(controls.time_buttons, "Resume")
    until(lambda: not runner.latest.paused)
    seen(room.viewer, lambda: "Pause" in controls.time_buttons.options)
    other.change(controls.time_buttons, "Pause")
    until(lambda: runner.latest.paused)
    with connected(room) as late:
        kinds: set[Any] = set()
        while "ReplayDoneMessage" not in kinds:
            kinds |= {message["type"] for message in told(late.recv(5))}
        assert {"GuiButtonGroupMessage", "GuiNumberMessage", "BatchedMeshesMessage"} <= kinds


def told(frame: Any) -> list[dict[str, Any]]:
    size = int.from_bytes(frame[8:16], "little")
    inside = ZstdDecompressor().decompress(frame[16 : 16 + size])
    messages: list[dict[str, Any]] = msgspec.msgpack.decode(inside)["messages"]
    return messages


def attributes_of(widget: Any) -> set[str]:
    state = widget._impl
    return {*vars(state), *vars(state.props), "options", "removed", "__class__", "no_such_thing"}


def fits(widget: Any, value: Any) -> bool:
    """Return True if a person could give a widget that value."""
    kind, known = type(widget).__name__, type(widget.value)
    if kind == "GuiButtonHandle":
        return value is True
    return (known is bool and isinstance(value, bool)) or (
        kind == "GuiTextHandle" and isinstance(value, str) and len(value) < 1000
    )


@pytest.mark.usefixtures("checks")
def test_no_attribute_of_a_widget_can_be_set(
    room: Room, caplog: pytest.LogCaptureFixture, capfd: pytest.CaptureFixture[str]
) -> None:
    with page(room) as here:
        all_open(room, here)
        caught_up(room, here, 1.0)
        before, there = state_of(room), widgets(room)
        assert len(there) > 40
        for uuid, widget in there.items():
            for name in sorted(attributes_of(widget) - {"value"}):
                here.say("GuiUpdateMessage", uuid=uuid, updates={name: []})
                here.say("GuiUpdateMessage", uuid=uuid, updates={name: 1})
            both = {"value": widget.value, "update_cb": []} if widget.value != b"" else {}
            if isinstance(widget.value, bool | int | float | str):
                here.say("GuiUpdateMessage", uuid=uuid, updates=both)
            here.say("GuiUpdateMessage", uuid=uuid, updates={})
        caught_up(room, here, 2.0)
        assert state_of(room) == before
        with page(room) as other:
            in_order(room, other)
    unharmed(caplog, capfd)


@pytest.mark.usefixtures("checks")
def test_no_widget_takes_a_value_that_is_not_of_its_kind(
    room: Room, caplog: pytest.LogCaptureFixture, capfd: pytest.CaptureFixture[str]
) -> None:
    with page(room) as here:
        all_open(room, here)
        caught_up(room, here, 1.0)
        before, there = state_of(room), widgets(room)
        for value in ODD_VALUES:
            for uuid, widget in there.items():
                if not fits(widget, value):
                    here.say("GuiUpdateMessage", uuid=uuid, updates={"value": value})
            here.say("GuiUpdateMessage", uuid="no such widget", updates={"value": value})
        caught_up(room, here, 2.0)
        assert state_of(room) == before
        with page(room) as other:
            in_order(room, other)
    unharmed(caplog, capfd)


def test_a_number_is_within_the_bounds_of_its_widget(room: Room) -> None:
    with page(room) as here:
        (past,), seed = tabs_of(room.viewer, ReplayTab), part_of(room.viewer, Controls).seed
        for widget, odd in ((seed, (-1, 2**53, 1e20, 1.5)), (past.step, (0, 77, 1.5, -1e9))):
            was = widget.value
            for value in odd:
                here.change(widget, value)
            caught_up(room, here, 1.0 + was)
            assert widget.value == was
        here.change(seed, float(2**53 - 1))
        until(lambda: seed.value == 2**53 - 1)
        assert type(seed.value) is int


def test_no_other_message_of_visers_has_an_effect(
    room: Room, caplog: pytest.LogCaptureFixture, capfd: pytest.CaptureFixture[str]
) -> None:
    """Every type of message that viser knows, about every widget, with fields that fit it."""
    with page(room) as here:
        all_open(room, here)
        caught_up(room, here, 1.0)
        before, there = state_of(room), widgets(room)
        for kind in viser._messages.Message.get_subclasses():
            if kind.__name__ != "CommandTriggerMessage":  # is let through, and does nothing here
                here.say(kind.__name__)
                here.say(kind.__name__, uuid="none", name="/bodies0", owner="", key="a", value="b")
        for uuid in [*there, "none"]:
            here.say("GuiButtonHoldMessage", uuid=uuid, frequency=10.0)
            here.say("GuiFormDirtyMessage", uuid=uuid)
            here.say("GuiFormSubmitMessage", uuid=uuid)
            upload(here, uuid, b"" if "Upload" in type(there.get(uuid)).__name__ else b"content")
        caught_up(room, here, 2.0)
        assert state_of(room) == before
        for gui in guis(room):
            assert not gui._current_file_upload_states
        with page(room) as other:
            in_order(room, other)
    unharmed(caplog, capfd)


def upload(here: Page, uuid: str, content: bytes) -> None:
    """Send a file; an empty one says that it is larger."""
    here.say(
        "FileTransferStartUpload",
        source_component_uuid=uuid,
        transfer_uuid="t" + uuid[:30],
        filename="f",
        mime_type="",
        part_count=len(content[:1]),
        size_bytes=max(len(content), 1),
    )
    here.say(
        "FileTransferPart",
        source_component_uuid=uuid,
        transfer_uuid="t" + uuid[:30],
        part_index=0,
        content=content,
    )


@pytest.mark.parametrize(
    ("frame", "code"),
    [
        (b"", 1003),
        (b"\xc1", 1003),
        (b"\x81\xa4type\xa2\xff\xfe", 1003),
        (b"\x81\xa1a" + b"\x91" * 100_000 + b"\x01", 1003),
        ("text", 1003),
        (b"\x00" * 2 * MAX_PART_BYTES, 1009),
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
    with page(room) as other:
        with connected(room) as here:
            with pytest.raises(ConnectionClosed) as closed:  # noqa: PT012 - what comes first varies
                here.send(frame)
                while True:
                    here.recv(5)
            if len(frame) < 10_000_000:  # of a larger one not even all is read
                assert closed.value.rcvd is not None
                assert closed.value.rcvd.code == code
        in_order(room, other)
    unharmed(caplog, capfd)
