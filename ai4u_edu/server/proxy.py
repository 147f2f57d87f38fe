"""viser's WebSocket, passed through our port."""

import asyncio
import logging
import re
from collections.abc import Iterable
from contextlib import suppress

from starlette.datastructures import Headers
from starlette.requests import HTTPConnection
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from ai4u_edu.base.log_limit import log_limited
from ai4u_edu.server import page_messages
from ai4u_edu.server.rate_limit import RateLimit
from ai4u_edu.server.token_auth import with_token
from ai4u_edu.server.viser_lockdown import PROXY_SECRET, PROXY_SECRET_HEADER

MAX_MESSAGES_PER_S = 500
"""Messages a second that viser gets from one page; a page that sends more is slowed down. Dragging
something sends about a hundred."""
MAX_UPWARD_BYTES = 2**20
"""Bytes of a message from a page. The largest one is a part of a file, of 512 KiB."""
MAX_HEADER_CHARS = 2048
"""Characters of what viser is told in a header; websockets takes no line longer than 8,192."""
MAX_SUBPROTOCOLS = 8
UNSUPPORTED_DATA = 1003
"""Code of a close: the page sent something that is no message of viser's."""
TOO_BIG = 1009
"""Code of a close: the page sent a message that is too large."""

PAGE_HEADER = "X-AI4U-Edu-Page"
"""By this viser is told the address under which a browser has the page."""
AGENT_HEADER = "X-AI4U-Edu-Agent"
"""By this viser is told which agent the page is about, percent-encoded; empty for none."""
AGENT_COOKIE = "ai4u_edu_agent"
"""By this the page tells us: viser leaves the query out of the address that it connects to."""
DARK_HEADER = "X-AI4U-Edu-Dark"
"""By this viser is told that a page is to be dark."""
DARK_COOKIE = "ai4u_edu_dark"
"""By this the page tells us; empty for light."""
_SUBPROTOCOL = re.compile(r"[A-Za-z0-9._+-]{1,64}")

_logger = logging.getLogger(__name__)


_SAYABLE = (1000, 1001, 1002, 1003, 1009)  # other codes of a close can't be passed on


class ViserProxy:
    """Connects each page to viser; an ASGI app.

    Each direction waits until the other side has taken a frame: a slow page slows its own stream
    down, and nothing piles up here.

    Args:
        port: where viser listens, on 127.0.0.1.
        token: the room's; who comes here has it, and its page may show it.
    """

    def __init__(self, port: int, token: str = "") -> None:
        self._url = f"ws://127.0.0.1:{port}"
        self._token = token

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """One page's connection, until one side closes it."""
        page = WebSocket(scope, receive, send)
        try:
            viser = await connect(
                self._url,
                additional_headers={
                    PAGE_HEADER: with_token(page_address(scope), self._token),
                    AGENT_HEADER: page_agent(scope),
                    DARK_HEADER: "1" if HTTPConnection(scope).cookies.get(DARK_COOKIE) else "",
                    PROXY_SECRET_HEADER: PROXY_SECRET,
                },
                subprotocols=_subprotocols(scope["subprotocols"]) or None,
                compression=None,  # viser compresses by itself
                max_size=None,
                max_queue=1,  # frames for a slow page wait in viser, where newer ones replace them
                ping_interval=None,  # the page is asked for signs of life, that's enough
                proxy=None,
            )
        except (OSError, InvalidHandshake):
            await page.close(1013, "the viewer does not answer; reload the page in a moment")
            return
        upward = asyncio.create_task(_upward(page, viser))
        try:
            await _downward(viser, page)
        finally:
            upward.cancel()
            viser.transport.abort()  # a farewell would have to wait behind frames nobody reads
            with suppress(asyncio.CancelledError):
                await upward


def page_address(scope: Scope) -> str:
    """The address under which a browser has the page, as far as it says.

    >>> headers = [(b"host", b"inner:8080"), (b"origin", b"https://teacher.example")]
    >>> page_address({"type": "websocket", "headers": headers, "root_path": "/lab"})
    'https://teacher.example/lab'
    """
    headers = Headers(scope=scope)
    secure = scope.get("scheme") in ("wss", "https")
    host = f"{'https' if secure else 'http'}://{headers.get('host', '')}"
    return _as_header(f"{headers.get('origin', host)}{scope.get('root_path', '')}")


def page_agent(scope: Scope) -> str:
    r"""The agent that a page says it is about, percent-encoded; empty if it says none.

    >>> page_agent({"type": "websocket", "headers": [(b"cookie", b"ai4u_edu_agent=red%201")]})
    'red%201'
    >>> quoted = rb'ai4u_edu_agent="red\015\012Origin: x"'
    >>> page_agent({"type": "websocket", "headers": [(b"cookie", quoted)]})
    ''
    """
    return _as_header(HTTPConnection(scope).cookies.get(AGENT_COOKIE, ""))


def _as_header(text: str) -> str:
    """Return a text that may stand in a header, or nothing.

    A cookie's text may have line ends, written otherwise, and begin another header.
    """
    is_fit = text.isascii() and text.isprintable() and len(text) <= MAX_HEADER_CHARS
    return text if is_fit else ""


def _subprotocols(offered: Iterable[str]) -> list[Subprotocol]:
    found = [Subprotocol(name) for name in offered if _SUBPROTOCOL.fullmatch(name)]
    return found[:MAX_SUBPROTOCOLS]


async def _downward(viser: ClientConnection, page: WebSocket) -> None:
    with suppress(WebSocketDisconnect):
        await page.accept(viser.subprotocol)
        with suppress(ConnectionClosed):
            while True:
                await page.send_bytes(await viser.recv(decode=False))
        code = viser.close_code or 1001
        await page.close(code if code in _SAYABLE else 1001, viser.close_reason)


async def _upward(page: WebSocket, viser: ClientConnection) -> None:
    """Hand the messages of a page on to viser, as far as a page may send them."""
    rate, code, reason = RateLimit(MAX_MESSAGES_PER_S), 1000, ""
    with suppress(ConnectionClosed):
        while (message := await page.receive())["type"] == "websocket.receive":
            frame = message.get("bytes")
            if frame is None:  # viser speaks in bytes only
                code, reason = UNSUPPORTED_DATA, "expected bytes, got text"
                break
            if len(frame) > MAX_UPWARD_BYTES:
                code, reason = TOO_BIG, f"expected at most {MAX_UPWARD_BYTES} bytes in a message"
                break
            try:
                await viser.send(page_messages.checked(frame))
            except page_messages.MalformedError as error:
                code, reason = UNSUPPORTED_DATA, "expected a message as msgpack"
                _log_refusal("malformed", error)
                break
            except ValueError as error:
                _log_refusal("refused", error)
            if wait := rate.take():
                await asyncio.sleep(wait)
    await viser.close(code, reason)


def _log_refusal(key: str, error: ValueError) -> None:
    # as ASCII: a page chooses some of the text, which is not to look like another line of the log
    log_limited(_logger, logging.WARNING, key, "a page's message was left out: %a", str(error))
