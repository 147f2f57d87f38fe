"""Echo WebSocket of the page that checks a device; anybody in the network may open it."""

import contextlib

from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

MAX_ECHOES = 20
MAX_ECHO_CHARS = 100


async def echo(socket: WebSocket) -> None:
    """Send each text back, up to a number of them; close on anything else."""
    await socket.accept()
    with contextlib.suppress(WebSocketDisconnect, KeyError):  # the latter for bytes
        for _ in range(MAX_ECHOES):
            text = await socket.receive_text()
            if len(text) > MAX_ECHO_CHARS:
                break
            await socket.send_text(text)
    if socket.client_state is WebSocketState.CONNECTED:
        await socket.close()
