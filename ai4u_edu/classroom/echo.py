"""Echo WebSocket of the page that checks a device; anybody in the network may open it."""

import contextlib

from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from ai4u_edu.page.server.limits.attempts import client_address
from ai4u_edu.page.server.limits.concurrency_limit import ConcurrencyLimit

MAX_ECHOES = 20
MAX_ECHO_CHARS = 100


class Echo:
    """ASGI app that sends each text back, up to a number of them, and closes on anything else.

    Args:
        strangers: limit of the sockets that anybody may open, by address.
    """

    def __init__(self, strangers: ConcurrencyLimit) -> None:
        self._strangers = strangers

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one socket."""
        await self._strangers.serve(client_address(scope), _echo, scope, receive, send)


async def _echo(scope: Scope, receive: Receive, send: Send) -> None:
    socket = WebSocket(scope, receive, send)
    await socket.accept()
    with contextlib.suppress(WebSocketDisconnect, KeyError):  # the latter for bytes
        for _ in range(MAX_ECHOES):
            text = await socket.receive_text()
            if len(text) > MAX_ECHO_CHARS:
                break
            await socket.send_text(text)
    if socket.client_state is WebSocketState.CONNECTED:
        await socket.close()
