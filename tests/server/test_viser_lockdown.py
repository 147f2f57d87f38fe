"""viser's own port, which a page may find too."""

from collections.abc import Iterator

import msgspec
import pytest
import viser
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

from ai4u_edu.server import shut_side_door
from ai4u_edu.server.viser_lockdown import KNOCK, KNOCK_HEADER
from tests.server.rooms import until


@pytest.fixture
def inner() -> Iterator[viser.ViserServer]:
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    shut_side_door(server)
    yield server
    server.stop()


def directly(server: viser.ViserServer, **headers: str) -> ClientConnection:
    return connect(
        f"ws://127.0.0.1:{server.get_port()}",
        subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
        additional_headers=headers,
        proxy=None,
    )


@pytest.mark.parametrize(
    "headers", [{}, {"Origin": "http://evil.example"}, {KNOCK_HEADER: "guess"}]
)
def test_who_comes_around_the_proxy_hears_nothing(
    inner: viser.ViserServer, headers: dict[str, str]
) -> None:
    inner.gui.add_text("Name", initial_value="secret")
    with directly(inner, **headers) as page:
        with pytest.raises(ConnectionClosed) as closed:
            page.recv(5)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1008
    until(lambda: not inner.get_clients())


def test_the_proxy_comes_in(inner: viser.ViserServer) -> None:
    with directly(inner, **{KNOCK_HEADER: KNOCK}) as proxy:
        assert proxy.recv(5)


def test_nobody_opens_a_tunnel(inner: viser.ViserServer, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    monkeypatch.setattr(inner, "request_share_url", lambda: asked.append("request"))
    field = inner.gui.add_text("Name", initial_value="before")
    with directly(inner, **{KNOCK_HEADER: KNOCK}) as proxy:
        proxy.recv(5)
        proxy.send(msgspec.msgpack.encode({"type": "ShareUrlRequest"}))
        update = {"type": "GuiUpdateMessage", "uuid": field._impl.uuid, "updates": {"value": "x"}}
        proxy.send(msgspec.msgpack.encode(update))
        until(lambda: field.value == "x")
    assert asked == []


def test_shutting_it_twice_is_no_harm(inner: viser.ViserServer) -> None:
    shut_side_door(inner)
    with directly(inner, **{KNOCK_HEADER: KNOCK}) as proxy:
        assert proxy.recv(5)
