"""Messages that tell a page that its connection is still there.

A network that is gone closes no connection, and a page's scripts don't see a WebSocket's pings. A
page that has heard nothing for some periods takes the connection for lost and opens another one.
"""

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import suppress

from starlette.websockets import WebSocketDisconnect

KEEPALIVE = '{"type":"keepalive"}'
KEEPALIVE_S = 2.0
"""Period of the messages; pages wait four times as long."""


async def send_keepalives(send: Callable[[str], Awaitable[None]]) -> None:
    """Send a message in each period, until cancelled or until the page has left.

    Args:
        send: sends a text to the page.
    """
    with suppress(WebSocketDisconnect):
        while True:
            await send(KEEPALIVE)
            await asyncio.sleep(KEEPALIVE_S)
