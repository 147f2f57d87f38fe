"""Reverse proxy for the pages of rooms: HTTP by httpx, WebSockets by websockets."""

from collections.abc import Awaitable, Callable, Coroutine, Iterable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import httpx
from starlette.datastructures import Headers
from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response, StreamingResponse
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from ai4u_edu.classroom.no_cookies import no_cookies
from ai4u_edu.classroom.room_host import RoomAddress
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.request_target import target_of
from ai4u_edu.page.server.limits.socket_close import NOT_ALLOWED, TRY_LATER
from ai4u_edu.page.server.proxy import SCRIPT_KEY_HEADER, connect_viser, pass_up
from ai4u_edu.page.server.reader_language import TextResponse
from ai4u_edu.page.server.socket_pump import pump_sockets, sendable_code

_HOP_BY_HOP = {
    "connection",
    "keep-alive",
    "proxy-authenticate",
    "proxy-authorization",
    "te",
    "trailer",
    "transfer-encoding",
    "upgrade",
}
"""Headers of one connection, which a proxy does not pass on (RFC 9110, 7.6.1)."""
ROLE_HEADER, SEAT_HEADER = "x-ai4u-role", "x-ai4u-seat"
"""Headers to a room: ``teacher`` or ``student``, and the seat's number; given ones are dropped."""
_OURS = {
    *("authorization", "cookie", "content-length", "origin"),
    *(ROLE_HEADER, SEAT_HEADER, SCRIPT_KEY_HEADER.lower()),
}
_WEBSOCKET = "sec-websocket-"
OPEN_TIMEOUT_S = 10.0
"""Time in which a room has to accept a page's socket."""
ANSWER_TIMEOUT_S = 30.0
"""Time for a room's answer to a request, or for its next part."""
NORMAL = 1000


@dataclass(eq=False)
class _Link:
    """A browser's socket that is connected with its room."""

    there: ClientConnection
    refusal: str = ""
    """Reason for which the class ended it."""

    def close_for_refusal(self) -> tuple[int, str] | None:
        """Return the close's code and reason if the class ended it."""
        return (NOT_ALLOWED, self.refusal) if self.refusal else None


class RoomProxy:
    """Passes requests and sockets on to a room's server. Belongs to one event loop.

    The room gets its own token and not the browser's cookies of the class; only cookies of the page
    itself are passed on.

    Args:
        page_cookies: names of cookies that rooms read.
        script_key: returns a seat's key for scripts, which its page shows.
        on_socket: called with a seat's number and 1 or -1, when a socket is opened or closed.
    """

    def __init__(
        self,
        page_cookies: Iterable[str],
        script_key: Callable[[int], str],
        on_socket: Callable[[int, int], object] = lambda _seat, _change: None,
    ) -> None:
        self._script_key, self._on_socket = script_key, on_socket
        self._page_cookies = frozenset(page_cookies)
        self._links: dict[int, set[_Link]] = {}
        self._client = httpx.AsyncClient(
            limits=httpx.Limits(max_connections=None),
            timeout=ANSWER_TIMEOUT_S,
            trust_env=False,
            cookies=no_cookies(),
        )

    def end(self, seat: int, reason: str) -> None:
        """End all sockets of a seat that may not enter any more."""
        for link in self._links.get(seat, ()):
            link.refusal = reason
            link.there.transport.abort()

    async def http(
        self, room: RoomAddress, seat: int, scope: Scope, receive: Receive, send: Send
    ) -> None:
        """Answer a request with the room's answer.

        Args:
            room: the room.
            seat: number of the seat that asks; 0 for the teacher.
            scope: see ASGI.
            receive: see ASGI.
            send: see ASGI.
        """
        request = Request(scope, receive)
        headers = self._headers(room, seat, request.headers)
        passed = self._client.build_request(
            request.method,
            httpx.URL(scheme="http", host=room.host, port=room.port, path="/"),
            # as bytes: a value may have any
            headers=[(name.encode(), value.encode("latin-1")) for name, value in headers],
            content=request.stream() if request.method not in ("GET", "HEAD") else None,
            extensions={"target": target_of(scope).encode()},  # httpx would normalize it
        )
        response: Response
        try:
            answer = await self._client.send(passed, stream=True)
        except ClientDisconnect:  # in the middle of what it sends
            return
        except httpx.HTTPError:
            response = TextResponse(_("Your world does not answer. Reload in a moment."), 503)
            await response(scope, receive, send)
            return
        response = StreamingResponse(answer.aiter_raw(), answer.status_code)
        response.raw_headers = [
            (name.lower(), value)
            for name, value in answer.headers.raw
            if name.decode("latin-1").lower() not in _HOP_BY_HOP
        ]
        try:
            await response(scope, receive, send)
        finally:  # also of an answer that nobody waits for any more
            await answer.aclose()

    async def websocket(
        self, room: RoomAddress, seat: int, scope: Scope, receive: Receive, send: Send
    ) -> None:
        """Connect the socket of a seat's browser with the room until one side closes it."""
        page = WebSocket(scope, receive, send)
        await self._serve(page, seat, self._connect(room, seat, page), _upward)

    async def viser(
        self, room: RoomAddress, seat: int, scope: Scope, receive: Receive, send: Send
    ) -> None:
        """Connect the socket of a page's picture with the room's viser until one side closes it.

        Past the room's server, which would do the same checks: with thirty rooms, passing on
        pictures took it a sixth of the processor time of a room.

        Args:
            room: the room.
            seat: as for :meth:`http`.
            scope: see ASGI; its ``root_path`` is the room's.
            receive: see ASGI.
            send: see ASGI.
        """
        if room.viser_port is None:
            await self.websocket(room, seat, scope, receive, send)
            return
        page, key = WebSocket(scope, receive, send), self._script_key(seat)
        connecting = connect_viser(scope, room.viser_port, room.token, key, OPEN_TIMEOUT_S)
        await self._serve(page, seat, connecting, pass_up)

    async def _connect(self, room: RoomAddress, seat: int, page: WebSocket) -> ClientConnection:
        return await connect(
            # the name under which the browser has the page; where to connect to is said below
            f"ws://{page.headers['host']}{target_of(page.scope)}",
            host=room.host,
            port=room.port,
            additional_headers=[
                *(each for each in self._headers(room, seat, page.headers) if each[0] != "host"),
                (SCRIPT_KEY_HEADER, self._script_key(seat)),
            ],
            subprotocols=[Subprotocol(each) for each in page.scope["subprotocols"]] or None,
            user_agent_header=None,
            compression=None,
            max_size=None,
            open_timeout=OPEN_TIMEOUT_S,
            max_queue=1,  # what a slow page does not take waits in the room
            ping_interval=None,
            proxy=None,
        )

    async def _serve(
        self,
        page: WebSocket,
        seat: int,
        connecting: Awaitable[ClientConnection],
        upward: Callable[[WebSocket, ClientConnection], Coroutine[Any, Any, None]],
    ) -> None:
        try:
            there = await connecting
        except (OSError, InvalidHandshake):
            await page.close(TRY_LATER, _("the world does not answer; reload the page in a moment"))
            return
        link = _Link(there)
        links = self._links.setdefault(seat, set())
        links.add(link)
        self._on_socket(seat, 1)
        try:
            await pump_sockets(page, there, upward(page, there), link.close_for_refusal)
        finally:
            links.discard(link)
            self._on_socket(seat, -1)

    def _headers(self, room: RoomAddress, seat: int, given: Headers) -> list[tuple[str, str]]:
        passed = [
            (name, value)
            for name, value in given.items()
            if name not in _HOP_BY_HOP
            and name not in _OURS
            and not name.startswith(("sec-fetch-", _WEBSOCKET))
        ]
        page_cookies = [
            each.strip()
            for each in given.get("cookie", "").split(";")
            if each.partition("=")[0].strip() in self._page_cookies
        ]
        if page_cookies:
            passed.append(("cookie", "; ".join(page_cookies)))
        return [
            *passed,
            ("authorization", f"Bearer {room.token}"),
            (ROLE_HEADER, "student" if seat else "teacher"),
            (SEAT_HEADER, str(seat)),
        ]


async def _upward(page: WebSocket, there: ClientConnection) -> None:
    with suppress(ConnectionClosed):
        while (message := await page.receive())["type"] == "websocket.receive":
            text = message.get("text")
            await there.send(message["bytes"] if text is None else text)
        await there.close(sendable_code(message.get("code"), NORMAL), message.get("reason") or "")
