"""viser's own port, which a page may find too."""

from collections.abc import Iterator

import pytest
import viser
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection
from websockets.typing import Subprotocol

from ai4u_edu.page.server import lock_viser_port
from ai4u_edu.page.server.viser_lockdown import PROXY_SECRET, PROXY_SECRET_HEADER
from tests.page.server.rooms import open_socket
from tests.waiting import LIMIT_S, until


@pytest.fixture
def inner() -> Iterator[viser.ViserServer]:
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    lock_viser_port(server)
    yield server
    server.stop()


def directly(server: viser.ViserServer, **headers: str) -> ClientConnection:
    return open_socket(
        f"ws://127.0.0.1:{server.get_port()}",
        subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
        additional_headers=headers,
    )


@pytest.mark.parametrize(
    "headers", [{}, {"Origin": "http://evil.example"}, {PROXY_SECRET_HEADER: "guess"}]
)
def test_direct_connection_to_viser_is_closed(
    inner: viser.ViserServer, headers: dict[str, str]
) -> None:
    inner.gui.add_text("Name", initial_value="secret")
    with directly(inner, **headers) as page:
        with pytest.raises(ConnectionClosed) as closed:
            page.recv(LIMIT_S)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1008
    until(lambda: not inner.get_clients())


def test_the_proxy_comes_in(inner: viser.ViserServer) -> None:
    with directly(inner, **{PROXY_SECRET_HEADER: PROXY_SECRET}) as proxy:
        assert proxy.recv(LIMIT_S)


def test_locking_it_twice_is_no_harm(inner: viser.ViserServer) -> None:
    lock_viser_port(inner)
    with directly(inner, **{PROXY_SECRET_HEADER: PROXY_SECRET}) as proxy:
        assert proxy.recv(LIMIT_S)
