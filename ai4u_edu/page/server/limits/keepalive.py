"""Messages that tell a page that its connection is still there.

A network that is gone closes no connection, and a page's scripts don't see a WebSocket's pings. A
page that has heard nothing for some periods takes the connection for lost and opens another one.
"""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager, suppress

from starlette.websockets import WebSocketDisconnect

KEEPALIVE = '{"type":"keepalive"}'
KEEPALIVE_S = 2.0
"""Period of the messages; pages wait four times as long."""


@asynccontextmanager
async def keepalives(send: Callable[[str], Awaitable[None]]) -> AsyncIterator[None]:
    """Context in which a page gets a message in each period, until it has left.

    Args:
        send: sends a text to the page.
    """
    sending = asyncio.create_task(_send_keepalives(send))
    try:
        yield
    finally:
        sending.cancel()
        await asyncio.wait([sending])


async def _send_keepalives(send: Callable[[str], Awaitable[None]]) -> None:
    with suppress(WebSocketDisconnect):
        while True:
            await send(KEEPALIVE)
            await asyncio.sleep(KEEPALIVE_S)
