"""The messages of a page's WebSocket: limited in rate and size, and read one by one."""

from collections.abc import AsyncIterator, Awaitable, Callable
from typing import NamedTuple, TypeVar

from starlette.websockets import WebSocket, WebSocketState

from ai4u_edu.base.errors import text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.rate_limit import RateLimit
from ai4u_edu.page.server.limits.socket_close import close_reason

M = TypeVar("M")
MAX_MISTAKES = 5
"""Malformed messages in a row after which the connection is closed."""


class ReceiveLimits(NamedTuple):
    """Limits of one page's connection."""

    messages_per_s: int
    message_bytes: int
    binary_bytes: int = 0
    """Size of a binary message; 0 for the size of any other one."""


async def receive_messages(
    socket: WebSocket,
    limits: ReceiveLimits,
    read: Callable[[str | bytes], M],
    refuse: Callable[[str | bytes, str], Awaitable[None]],
) -> AsyncIterator[M]:
    """Yield a page's messages until it leaves, or the connection is closed for breaking a limit.

    Args:
        socket: the connection.
        limits: what it may send.
        read: returns the message in a frame; raises a ValueError if there is none.
        refuse: sends the page the reason for which a frame was refused.
    """
    limit, mistakes = RateLimit(limits.messages_per_s), 0
    while (frame := await socket.receive())["type"] == "websocket.receive":
        if limit.take():
            expected = _(
                "expected at most {messages_per_s} messages a second",
                messages_per_s=limits.messages_per_s,
            )
            await close_socket(socket, 1008, expected)
            return
        data = frame.get("text") or frame.get("bytes") or ""
        is_binary = isinstance(data, bytes)
        max_bytes = (limits.binary_bytes if is_binary else 0) or limits.message_bytes
        if len(data) > max_bytes:
            expected = _("expected at most {most} bytes", most=max_bytes)
            await refuse("", _("{expected}, got {number}", expected=expected, number=len(data)))
            await close_socket(socket, 1009, _("{expected} in a message", expected=expected))
            return
        try:
            message = read(data)
        except ValueError as error:
            mistakes += 1
            await refuse(data, text_of(error))
            if mistakes >= MAX_MISTAKES:
                await close_socket(
                    socket, 1008, _("{most} malformed messages in a row", most=MAX_MISTAKES)
                )
                return
            continue
        mistakes = 0
        yield message


async def close_socket(socket: WebSocket, code: int, reason: str) -> None:
    """Close a connection, unless another task has done so: a page floods while its world ends."""
    if socket.application_state is WebSocketState.CONNECTED:
        await socket.close(code, close_reason(reason))
