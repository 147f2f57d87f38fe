import asyncio
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest
import rich
from viser import _messages

from ai4u_edu.page.viewer.backend.local_server import LocalServer
from tests.waiting import LIMIT_S


@pytest.fixture
def server() -> Iterator[LocalServer]:
    server = LocalServer("AI4U Edu")
    yield server
    server.stop()


def test_it_listens_on_loopback_only(server: LocalServer) -> None:
    assert server.get_host() == "127.0.0.1"
    assert server.get_port() > 0


def test_it_says_nothing(capfd: pytest.CaptureFixture[str]) -> None:
    LocalServer("AI4U Edu").stop()
    rich.print("we may still print")
    assert capfd.readouterr().out == "we may still print\n"


def test_rich_prints_again_after_several_that_start_and_stop_at_once() -> None:
    with ThreadPoolExecutor(6) as pool:
        for _ in pool.map(lambda _: LocalServer("AI4U Edu").stop(), range(18)):
            pass
    assert not rich.get_console().quiet


def test_no_page_can_ask_for_a_public_address(
    server: LocalServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    tunnels: list[object] = []
    monkeypatch.setattr("viser._viser.ViserTunnel", lambda *args: tunnels.append(args))
    for message in (_messages.ShareUrlRequest(), _messages.ShareUrlDisconnect()):
        asked = server._websock_server._handle_incoming_message(0, message)  # type: ignore[arg-type]
        asyncio.run_coroutine_threadsafe(asked, server.get_event_loop()).result(LIMIT_S)
    server._thread_executor.shutdown(wait=True)
    assert tunnels == []
    assert server._share_tunnel is None
    assert server.request_share_url() is None


def test_the_handlers_that_it_disarms_are_still_those_of_viser(server: LocalServer) -> None:
    """If viser answers these messages in another way one day, the disarming must be looked at."""
    handlers = server._websock_server._incoming_handlers
    for kind, method in {
        _messages.ShareUrlRequest: "request_share_url",
        _messages.ShareUrlDisconnect: "disconnect_share_url",
    }.items():
        (handler,) = handlers[kind]
        assert method in handler.__code__.co_names
