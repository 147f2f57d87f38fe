"""Two connected WebSockets: a browser's, and a server's behind us."""

import asyncio
from collections.abc import Callable, Coroutine
from contextlib import suppress
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect
from websockets.asyncio.client import ClientConnection
from websockets.exceptions import ConnectionClosed

GOING_AWAY = 1001
_STANDARD_CODES = (1000, GOING_AWAY, 1002, 1003, 1008, 1009, 1013)
_PRIVATE_CODES = range(3000, 5000)


async def pump_sockets(
    page: WebSocket,
    there: ClientConnection,
    upward: Coroutine[Any, Any, None],
    refusal: Callable[[], tuple[int, str] | None] = lambda: None,
) -> None:
    """Pass a server's messages on to a page until one side closes, while ``upward`` does the rest.

    Each direction waits until the other side has taken a message: so a slow page gets backpressure,
    and nothing queues up here.

    Args:
        page: the browser's socket, which is accepted here.
        there: the server's.
        upward: passes the page's messages on to the server.
        refusal: returns code and reason of the page's close if they are not the server's.
    """
    task = asyncio.create_task(upward)
    try:
        with suppress(WebSocketDisconnect):
            await page.accept(there.subprotocol)
            await _pass_down(there, page)
            code = sendable_code(there.close_code, GOING_AWAY)
            await page.close(*(refusal() or (code, there.close_reason)))
    finally:
        task.cancel()
        there.transport.abort()  # a close would wait behind frames that nobody reads
        with suppress(asyncio.CancelledError):
            await task


async def _pass_down(there: ClientConnection, page: WebSocket) -> None:
    with suppress(ConnectionClosed):
        while True:
            message = await there.recv()
            if isinstance(message, str):
                await page.send_text(message)
            else:
                await page.send_bytes(message)


def sendable_code(code: int | None, other: int) -> int:
    """Return a close's code if it may be sent, else another one.

    >>> sendable_code(1008, 1001), sendable_code(1006, 1001), sendable_code(None, 1000)
    (1008, 1001, 1000)
    """
    if code is not None and (code in _STANDARD_CODES or code in _PRIVATE_CODES):
        return code
    return other
