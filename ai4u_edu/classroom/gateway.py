"""The web app of a class: joining, the way into rooms, and the teacher's page."""

import asyncio
import hmac
import re
import secrets
from collections.abc import Callable, Collection, Iterable
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import HTTPConnection
from starlette.responses import RedirectResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket

from ai4u_edu.base.errors import text_of
from ai4u_edu.classroom.class_event import ClassEvents
from ai4u_edu.classroom.episode_check import EpisodeCheck
from ai4u_edu.classroom.errors import RoomError
from ai4u_edu.classroom.join import Join, seat_of
from ai4u_edu.classroom.link_endpoint import LinkEndpoint
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.open_limits import seat_requests, seat_sockets, stranger_sockets
from ai4u_edu.classroom.pages import FILE_ROUTES, Echo, page_route
from ai4u_edu.classroom.room_host import RoomHost
from ai4u_edu.classroom.room_process import ROOMS_PATH, path_of
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.seats import Seats
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.classroom.teacher import Teacher, join_code
from ai4u_edu.classroom.teacher_socket import WallSocket
from ai4u_edu.classroom.tournament.files import TournamentFiles
from ai4u_edu.classroom.work_routes import WorkRoutes
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.host_origin import LOOPBACK, HostOriginCheck
from ai4u_edu.page.server.limits.attempts import Attempts
from ai4u_edu.page.server.limits.concurrency_limit import ConcurrencyLimit
from ai4u_edu.page.server.limits.socket_close import NOT_ALLOWED, TRY_LATER, refuse_socket
from ai4u_edu.page.server.proxy import AGENT_COOKIE, DARK_COOKIE
from ai4u_edu.page.server.reader_language import ReaderLanguage, TextResponse
from ai4u_edu.page.server.token_auth import PageCookie, TokenAuth
from ai4u_edu.page.server.token_page import TokenPage, wants_page
from ai4u_edu.wire.class_link import MAX_FRAME_BYTES
from ai4u_edu.wire.class_link import PATH as LINK_PATH

SCRIPTS_PATH = "ws/remote"
"""Path of a room's socket for scripts, which have no cookie."""
INPUT_PATH = "ws/input"
"""Path of the socket that each page of a room has."""
NO_KEY = _(
    "expected the key of a seat of this world; take the whole address that its "
    "page shows under Python, with ?token=... at its end"
)
LEFT = _("you have no place in this class now; ask your teacher, or join again")
TEACHER = 0
"""Number that stands for the teacher in the place of a seat's."""
PAGES = re.compile(r"/|/teacher|/projector|/check|/privacy|/r/\w+/(start)?")
"""Paths of pages, to which other sites may lead a person."""

SERVER_LIMITS: dict[str, Any] = {"per_address": 1000, "max_message_bytes": MAX_FRAME_BYTES}
"""Arguments of :func:`~ai4u_edu.page.server.serve`: a school may have one address for all."""


def class_app(
    store: ClassStore,
    seats: Seats,
    rooms: RoomHost,
    *,
    teacher_token: str,
    join_address: Callable[[str], str] = str,
    allowed_hosts: Collection[str] = LOOPBACK,
    proxy_hosts: Collection[str] = (),
    blocks: Iterable[Path] = (),
    missions: Path | None = None,
) -> Starlette:
    """Return the ASGI app of a class.

    Call its ``state.begin()`` once the event loop runs: practices of an earlier process go on then,
    though nobody may come soon.

    Args:
        store: of the class.
        seats: of the class.
        rooms: runs the rooms; the caller closes it.
        teacher_token: secret of the teacher's page.
        join_address: returns the address that students open, for the one that the teacher opened.
        allowed_hosts: host names of requests; see :mod:`ai4u_edu.page.server.host_origin`.
        proxy_hosts: host names of a reverse proxy in front; see there.
        blocks: Python files with the teacher's blocks.
        missions: folder with the teacher's missions; None for none.
    """
    live, attempts = LiveClass(store, seats, rooms, EpisodeCheck(blocks), missions), Attempts()
    keys = ScriptKeys(store, seats)
    strangers, seated = stranger_sockets(), seat_sockets()
    proxy = RoomProxy([AGENT_COOKIE, DARK_COOKIE], keys.key_of, live.page_opened)

    def join_here(url: str) -> tuple[str, str]:
        address = join_address(url)
        return address, join_code(address, seats.code)

    events = ClassEvents(live, join_here)
    join, teacher = Join(seats, live.tell_people), Teacher(live, events, proxy)
    work = WorkRoutes(live)
    cookie = PageCookie(teacher_token)
    entrance = RoomEntrance(live, proxy, cookie, keys, sockets=seated, requests=seat_requests())
    auth = Middleware(TokenAuth, token=teacher_token, attempts=attempts)
    page_auth = Middleware(
        TokenAuth, token=teacher_token, attempts=attempts, token_page=TokenPage()
    )
    projector = WallSocket(live, events, is_projected=True)
    app = Starlette(
        routes=[
            Route("/", join.page),
            Route("/api/names", join.names),
            Route("/api/join", join.join, methods=["POST"]),
            Route("/api/move-code", join.move_code, methods=["GET", "POST"]),
            *work.routes(),
            Route("/check", page_route("check.html")),
            WebSocketRoute("/check/socket", Echo(strangers)),
            Route("/privacy", page_route("privacy.html")),
            *FILE_ROUTES,
            WebSocketRoute(LINK_PATH, LinkEndpoint(live, strangers, seated)),
            Route("/teacher", teacher.page, middleware=[page_auth]),
            Route("/teacher/state", teacher.state, middleware=[auth]),
            Route("/teacher/export", teacher.export, middleware=[auth]),
            Route("/teacher/programs", work.programs, middleware=[auth]),
            Route("/teacher/networks", teacher.networks, middleware=[auth]),
            Route("/teacher/command", teacher.command, methods=["POST"], middleware=[auth]),
            *TournamentFiles(live.tournament).routes(auth),
            WebSocketRoute("/teacher/socket", WallSocket(live, events), middleware=[auth]),
            Route("/projector", page_route("projector.html"), middleware=[page_auth]),
            WebSocketRoute("/projector/socket", projector, middleware=[auth]),
            Mount("/r", app=entrance),
        ],
        middleware=[
            Middleware(ReaderLanguage),
            Middleware(
                HostOriginCheck, allowed_hosts=allowed_hosts, proxy_hosts=proxy_hosts, pages=PAGES
            ),
        ],
    )
    app.state.begin = live.ensure_ticking
    return app


class ScriptKeys:
    """A key for each seat, which its page shows in the Python code that drives the agent.

    Keys are computed from one secret of the class, so none is stored.

    Args:
        store: of the class.
        seats: of the class.
    """

    def __init__(self, store: ClassStore, seats: Seats) -> None:
        self._store, self._seats = store, seats

    def key_of(self, number: int) -> str:
        """Return a seat's key; empty for number 0, the teacher's."""
        if not number:
            return ""
        return hmac.digest(self._secret(), str(number).encode(), "sha256").hex()[:24]

    def seat_of(self, room: str, authorization: str) -> int | None:
        """Return the number of a room's seat whose key a header has; None if there is none."""
        for seat in self._seats.all():
            if seat.room == room and seat.state == "in":
                wanted = f"Bearer {self.key_of(seat.number)}"
                if secrets.compare_digest(wanted.encode(), authorization.encode()):
                    return seat.number
        return None

    def _secret(self) -> bytes:
        return self._store.setting_or("script_secret", lambda: secrets.token_hex(16)).encode()


class RoomEntrance:
    """ASGI app for everything below ``/r/``.

    Args:
        live: the class.
        proxy: passes requests on to rooms.
        teacher: cookie of the teacher's browser.
        keys: of students' scripts.
        sockets: limit of the sockets of seats.
        requests: limit of the requests of seats.
    """

    def __init__(
        self,
        live: LiveClass,
        proxy: RoomProxy,
        teacher: PageCookie,
        keys: ScriptKeys,
        *,
        sockets: ConcurrencyLimit,
        requests: ConcurrencyLimit,
    ) -> None:
        self._limits = {"websocket": sockets, "http": requests}
        self._live = live
        self._seats, self._rooms, self._proxy = live.seats, live.host, proxy
        self._teacher, self._keys = teacher, keys

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on to its room, or refuse it."""
        room, slash, rest = scope["path"].removeprefix(ROOMS_PATH).partition("/")
        visitor = self._visitor(room, HTTPConnection(scope))
        if visitor is None and scope["type"] == "websocket" and rest == SCRIPTS_PATH:
            given = HTTPConnection(scope).headers.get("authorization", "")
            visitor = self._keys.seat_of(room, given)
            if visitor is None:
                refusal = TextResponse(NO_KEY, 403)
                await WebSocket(scope, receive, send).send_denial_response(refusal)
                return
        if visitor is None:
            await _refuse(scope, receive, send)
            return
        if not slash and scope["type"] == "http":  # the page's addresses are relative
            await RedirectResponse(f"{path_of(room)}/")(scope, receive, send)
            return

        async def enter(scope: Scope, receive: Receive, send: Send) -> None:
            await self._enter(room, rest, visitor, scope, receive, send)

        if visitor == TEACHER:
            await enter(scope, receive, send)
            return
        await self._limits[scope["type"]].serve(visitor, enter, scope, receive, send)
        # not before: a seat that is sent out while this is stored would still enter
        if not self._seats.has_opened(visitor):
            await asyncio.to_thread(self._seats.note_opened, visitor)

    async def _enter(
        self, room: str, rest: str, visitor: int, scope: Scope, receive: Receive, send: Send
    ) -> None:
        """Pass a request of somebody who may enter on to a room."""
        try:
            address = await self._rooms.enter(room, self._seats.scenes()[room])
        except RoomError as error:
            await _say_not_ready(text_of(error), scope, receive, send)
            return
        if scope["type"] == "http":
            await self._proxy.http(address, visitor, scope, receive, send)
        else:
            inner = {**scope, "root_path": path_of(room)}
            serve = self._proxy.websocket if rest else self._proxy.viser
            try:
                is_look = visitor == TEACHER and rest == INPUT_PATH
                looking = self._live.looking_in(room) if is_look else nullcontext()
                with self._rooms.in_use(room), looking:
                    await serve(address, visitor, inner, receive, send)
            finally:
                self._live.tell_people()  # the room may rest now

    def _visitor(self, room: str, given: HTTPConnection) -> int | None:
        """Return the number of a room's seat, or the teacher's; None for anybody else."""
        seat = seat_of(self._seats, given)
        if seat is not None and seat.room == room:
            return seat.number
        if room in self._seats.scenes() and self._teacher.is_in(given):
            return TEACHER
        return None


async def _refuse(scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await refuse_socket(scope, receive, send, NOT_ALLOWED, LEFT)
        return
    response: Response = TextResponse(_("this is not your world; join the class at /"), 403)
    if scope["method"] == "GET" and wants_page(HTTPConnection(scope)):
        response = RedirectResponse("/", 303)
    response.headers["Cache-Control"] = "no-store"
    await response(scope, receive, send)


async def _say_not_ready(text: str, scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await refuse_socket(scope, receive, send, TRY_LATER, text)
        return
    headers = {"Retry-After": "2", "Refresh": "2", "Cache-Control": "no-store"}
    await TextResponse(text + "", 503, headers)(scope, receive, send)
