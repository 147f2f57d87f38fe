"""Closes of WebSockets, with a code and a reason."""

from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket

from ai4u_edu.locale import translate

NOT_ALLOWED = 1008
"""Code of a close: the same request would be refused again."""
TRY_LATER = 1013
"""Code of a close: the same request may succeed later."""
_MAX_REASON_BYTES = 123


def close_reason(text: str) -> str:
    """Return a text in the reader's language as the reason of a close, of at most 123 bytes.

    >>> len(close_reason("é" * 100))
    61
    """
    return translate(text).encode()[:_MAX_REASON_BYTES].decode(errors="ignore")


async def refuse_socket(scope: Scope, receive: Receive, send: Send, code: int, reason: str) -> None:
    """Accept a WebSocket, and close it with a reason.

    A browser tells a script why a socket was closed, but not why a handshake failed.
    """
    socket = WebSocket(scope, receive, send)
    await socket.accept(next(iter(scope["subprotocols"]), None))
    await socket.close(code, close_reason(reason))
