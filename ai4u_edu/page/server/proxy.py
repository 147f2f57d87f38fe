"""Proxy for viser's WebSocket, so that the page needs one port only."""

import asyncio
import logging
import re
from collections.abc import Iterable
from contextlib import suppress

from starlette.datastructures import Headers
from starlette.requests import HTTPConnection
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from ai4u_edu.base.log_limit import log_limited
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server import page_messages
from ai4u_edu.page.server.limits.rate_limit import RateLimit
from ai4u_edu.page.server.limits.socket_close import close_reason
from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS
from ai4u_edu.page.server.socket_pump import pump_sockets
from ai4u_edu.page.server.token_auth import with_token
from ai4u_edu.page.server.viser_lockdown import PROXY_SECRET, PROXY_SECRET_HEADER

MAX_MESSAGES_PER_S = 500
"""Rate limit for messages from one page to viser; a page that sends more is throttled. Dragging
something sends about a hundred a second."""
MAX_UPWARD_BYTES = 2**20
"""Size of a message from a page. The largest one is a part of a file, of 512 KiB."""
MAX_HEADER_CHARS = 2048
"""Length of a header to viser; websockets accepts lines of at most 8,192."""
MAX_SUBPROTOCOLS = 8
UNSUPPORTED_DATA = 1003
"""Code of a close: the page sent something that is no message of viser's."""
TOO_BIG = 1009
"""Code of a close: the page sent a message that is too large."""

PAGE_HEADER = "X-AI4U-Edu-Page"
"""Header to viser: the address under which a browser has the page."""
SCRIPT_KEY_HEADER = "X-AI4U-Edu-Script-Key"
"""Header from a class's gateway: secret for the seat's scripts, in place of the room's token."""
PAGE_ID_HEADER = "X-AI4U-Edu-Page-Id"
"""Header to viser: the page's random id, which its panel's socket has too; empty without one."""
PAGE_ID_PARAM = "page"
"""Query parameter of a page's sockets with the same; see ``web/page/page_id.js``."""
AGENT_HEADER = "X-AI4U-Edu-Agent"
"""Header to viser: the agent that the page shows, percent-encoded; empty for none."""
AGENT_COOKIE = "ai4u_edu_agent"
"""Cookie from the page with the same; viser's client drops the query of the page's address."""
DARK_HEADER = "X-AI4U-Edu-Dark"
"""Header to viser: not empty for a dark page."""
DARK_COOKIE = "ai4u_edu_dark"
"""Cookie from the page: not empty for a dark page."""
_SUBPROTOCOL = re.compile(r"[A-Za-z0-9._+-]{1,64}")
_PAGE_ID = re.compile(r"[A-Za-z0-9-]{8,64}")

_logger = logging.getLogger(__name__)


class ViserProxy:
    """ASGI app that connects each page to viser.

    Args:
        port: viser's port on 127.0.0.1.
        token: the room's token, for the address that the page shows if nobody gives another one.
        secret: viser's, as given to :func:`~ai4u_edu.page.server.viser_lockdown.lock_viser_port`.
        timeout: time (s) for viser to accept a connection.
    """

    def __init__(
        self,
        port: int,
        token: str = "",
        secret: str = PROXY_SECRET,
        timeout: float = DEFAULT_TIMEOUTS.viser,
    ) -> None:
        self._port, self._token, self._secret, self._timeout = port, token, secret, timeout

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one page's connection until one side closes it."""
        page = WebSocket(scope, receive, send)
        try:
            token = page.headers.get(SCRIPT_KEY_HEADER, self._token)
            viser = await connect_viser(scope, self._port, self._secret, token, self._timeout)
        except (OSError, InvalidHandshake):
            await page.close(
                1013, close_reason(_("the viewer does not answer; reload the page in a moment"))
            )
            return
        await pump_sockets(page, viser, pass_up(page, viser))


async def connect_viser(
    scope: Scope, port: int, secret: str, token: str, timeout: float = DEFAULT_TIMEOUTS.viser
) -> ClientConnection:
    """Connect with viser in the name of a page.

    Args:
        scope: of the page's socket.
        port: viser's on 127.0.0.1.
        secret: viser's.
        token: secret in the address that the page shows to scripts.
        timeout: time (s) for viser to accept the connection.

    Raises:
        OSError, InvalidHandshake: viser does not answer.
    """
    return await connect(
        f"ws://127.0.0.1:{port}",
        additional_headers={
            PAGE_HEADER: with_token(page_address(scope), token),
            PAGE_ID_HEADER: page_id(scope),
            AGENT_HEADER: page_agent(scope),
            DARK_HEADER: "1" if HTTPConnection(scope).cookies.get(DARK_COOKIE) else "",
            PROXY_SECRET_HEADER: secret,
        },
        subprotocols=_subprotocols(scope["subprotocols"]) or None,
        compression=None,  # viser compresses by itself
        max_size=None,
        open_timeout=timeout,
        max_queue=1,  # frames for a slow page wait in viser, where newer ones replace them
        ping_interval=None,  # the other connection has pings
        proxy=None,
    )


def page_address(scope: Scope) -> str:
    """Return the address under which a browser has the page, from its headers.

    >>> headers = [(b"host", b"inner:8080"), (b"origin", b"https://teacher.example")]
    >>> page_address({"type": "websocket", "headers": headers, "root_path": "/lab"})
    'https://teacher.example/lab'
    """
    headers = Headers(scope=scope)
    secure = scope.get("scheme") in ("wss", "https")
    host = f"{'https' if secure else 'http'}://{headers.get('host', '')}"
    return _as_header(f"{headers.get('origin', host)}{scope.get('root_path', '')}")


def page_id(scope: Scope) -> str:
    """Return the id in the query of a page's socket; empty if there is none.

    >>> page_id({"type": "websocket", "query_string": b"page=0123-abcd", "headers": []})
    '0123-abcd'
    >>> page_id({"type": "websocket", "query_string": b"page=%0d%0aOrigin:x", "headers": []})
    ''
    """
    found = HTTPConnection(scope).query_params.get(PAGE_ID_PARAM, "")
    return found if _PAGE_ID.fullmatch(found) else ""


def page_agent(scope: Scope) -> str:
    r"""Return the agent in a page's cookie, percent-encoded; empty if there is none.

    >>> page_agent({"type": "websocket", "headers": [(b"cookie", b"ai4u_edu_agent=red%201")]})
    'red%201'
    >>> quoted = rb'ai4u_edu_agent="red\015\012Origin: x"'
    >>> page_agent({"type": "websocket", "headers": [(b"cookie", quoted)]})
    ''
    """
    return _as_header(HTTPConnection(scope).cookies.get(AGENT_COOKIE, ""))


def _as_header(text: str) -> str:
    """Return a text if it may stand in a header, else an empty one.

    A cookie may hold escaped line ends, which would begin another header.
    """
    is_fit = text.isascii() and text.isprintable() and len(text) <= MAX_HEADER_CHARS
    return text if is_fit else ""


def _subprotocols(offered: Iterable[str]) -> list[Subprotocol]:
    found = [Subprotocol(name) for name in offered if _SUBPROTOCOL.fullmatch(name)]
    return found[:MAX_SUBPROTOCOLS]


async def pass_up(page: WebSocket, viser: ClientConnection) -> None:
    """Pass a page's messages on to viser, except those that a page may not send."""
    rate, code, reason = RateLimit(MAX_MESSAGES_PER_S), 1000, ""
    with suppress(ConnectionClosed):
        while (message := await page.receive())["type"] == "websocket.receive":
            frame = message.get("bytes")
            if frame is None:  # viser uses binary messages only
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
    # as ASCII: the page chose part of the text, which must not look like another line of the log
    log_limited(_logger, logging.WARNING, key, "a page's message was left out: %a", str(error))
