"""The web app of a class: joining, the way into rooms, and the teacher's page."""

import re
from collections.abc import Callable, Collection

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import HTTPConnection
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.routing import Mount, Route
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket

from ai4u_edu.classroom.errors import RoomError
from ai4u_edu.classroom.join import Join, seat_of
from ai4u_edu.classroom.pages import web_file
from ai4u_edu.classroom.room_host import RoomHost
from ai4u_edu.classroom.room_process import ROOMS_PATH, path_of
from ai4u_edu.classroom.room_proxy import NOT_ALLOWED, TRY_LATER, RoomProxy
from ai4u_edu.classroom.seats import Seats
from ai4u_edu.classroom.teacher import Teacher
from ai4u_edu.server.attempts import Attempts
from ai4u_edu.server.host_origin import LOOPBACK, HostOriginCheck
from ai4u_edu.server.proxy import AGENT_COOKIE, DARK_COOKIE
from ai4u_edu.server.token_auth import TokenAuth
from ai4u_edu.server.token_page import TokenPage, wants_page

PAGES = re.compile(r"/|/teacher|/r/\w+/(start)?")
"""Paths of pages, to which other sites may lead a person."""


def class_app(
    seats: Seats,
    rooms: RoomHost,
    *,
    teacher_token: str,
    join_address: Callable[[str], str] = str,
    allowed_hosts: Collection[str] = LOOPBACK,
    proxy_hosts: Collection[str] = (),
) -> Starlette:
    """Return the ASGI app of a class.

    Args:
        seats: of the class.
        rooms: runs the rooms; the caller closes it.
        teacher_token: secret of the teacher's page.
        join_address: returns the address that students open, for the one that the teacher opened.
        allowed_hosts: host names that requests may use; see :mod:`ai4u_edu.server.host_origin`.
        proxy_hosts: host names of a reverse proxy in front; see there.
    """
    attempts = Attempts()
    proxy = RoomProxy([AGENT_COOKIE, DARK_COOKIE])
    join, teacher = Join(seats), Teacher(seats, rooms, proxy, join_address)
    auth = Middleware(TokenAuth, token=teacher_token, attempts=attempts)
    page_auth = Middleware(
        TokenAuth, token=teacher_token, attempts=attempts, token_page=TokenPage()
    )

    return Starlette(
        routes=[
            Route("/", join.page),
            Route("/api/names", join.names),
            Route("/api/join", join.join, methods=["POST"]),
            Route("/web/{file}", web_file),
            Route("/teacher", teacher.page, middleware=[page_auth]),
            Route("/teacher/state", teacher.state, middleware=[auth]),
            Route("/teacher/command", teacher.command, methods=["POST"], middleware=[auth]),
            Mount("/r", app=_RoomEntrance(seats, rooms, proxy)),
        ],
        middleware=[
            Middleware(
                HostOriginCheck,
                allowed_hosts=allowed_hosts,
                proxy_hosts=proxy_hosts,
                pages=PAGES,
            )
        ],
    )


class _RoomEntrance:
    """ASGI app for everything below ``/r/``: lets a room's own seats in.

    Args:
        seats: of the class.
        rooms: runs the rooms.
        proxy: passes requests on to them.
    """

    def __init__(self, seats: Seats, rooms: RoomHost, proxy: RoomProxy) -> None:
        self._seats, self._rooms, self._proxy = seats, rooms, proxy

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on to its room, or refuse it."""
        room, slash, _ = scope["path"].removeprefix(ROOMS_PATH).partition("/")
        seat = seat_of(self._seats, HTTPConnection(scope))
        if seat is None or seat.room != room:
            await _refuse(scope, receive, send)
            return
        if not slash and scope["type"] == "http":  # the page's addresses are relative
            await RedirectResponse(f"{path_of(room)}/")(scope, receive, send)
            return
        try:
            address = await self._rooms.enter(room, self._seats.scenes()[room])
        except RoomError as error:
            await _say_not_ready(str(error), scope, receive, send)
            return
        if scope["type"] == "http":
            await self._proxy.http(address, scope, receive, send)
        else:
            with self._rooms.in_use(room):
                await self._proxy.websocket(address, seat.number, scope, receive, send)


async def _refuse(scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await _close(scope, receive, send, NOT_ALLOWED, "this is not your world; join the class")
        return
    response: Response = PlainTextResponse("this is not your world; join the class at /\n", 403)
    if scope["method"] == "GET" and wants_page(HTTPConnection(scope)):
        response = RedirectResponse("/", 303)
    response.headers["Cache-Control"] = "no-store"
    await response(scope, receive, send)


async def _say_not_ready(text: str, scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await _close(scope, receive, send, TRY_LATER, text)
        return
    headers = {"Retry-After": "2", "Refresh": "2", "Cache-Control": "no-store"}
    await PlainTextResponse(text + "\n", 503, headers)(scope, receive, send)


async def _close(scope: Scope, receive: Receive, send: Send, code: int, reason: str) -> None:
    socket = WebSocket(scope, receive, send)
    # a browser tells a script why a socket was closed, but not why a handshake failed
    await socket.accept(next(iter(scope["subprotocols"]), None))
    await socket.close(code, reason)
