"""The web app of a class that is a service of a JupyterHub."""

import asyncio
import hmac
import re
import secrets
from collections.abc import Awaitable, Iterable
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from urllib.parse import quote, unquote

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocketClose

from ai4u_edu.base.errors import text_of
from ai4u_edu.classroom.class_event import ClassEvents
from ai4u_edu.classroom.episode_check import EpisodeCheck
from ai4u_edu.classroom.errors import JoinError, RoomError, StoreError
from ai4u_edu.classroom.hub.api import HubApi, HubUnreachableError, HubUser, NoAccessError
from ai4u_edu.classroom.hub.environment import HubEnvironment
from ai4u_edu.classroom.hub.sign_in import SIGN_IN, SignIn, TeacherAuth, is_teacher
from ai4u_edu.classroom.join import NO_STORE, Join, problem, storage_problem
from ai4u_edu.classroom.link_endpoint import LinkEndpoint
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.live_rooms import LiveRoom, remote_id
from ai4u_edu.classroom.open_limits import seat_sockets, stranger_sockets
from ai4u_edu.classroom.pages import FILE_ROUTES, Echo, page_route
from ai4u_edu.classroom.room_host import RoomAddress
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.seats import Seats
from ai4u_edu.classroom.store import ClassStore, SeatRow
from ai4u_edu.classroom.teacher import Teacher, qr_code
from ai4u_edu.classroom.teacher_socket import WallSocket
from ai4u_edu.classroom.tournament.files import TournamentFiles
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.host_origin import HostOriginCheck
from ai4u_edu.page.server.limits.attempts import client_address
from ai4u_edu.page.server.reader_language import TextResponse
from ai4u_edu.page.server.standalone import standalone_page
from ai4u_edu.wire.class_link import PATH as LINK_PATH

_TOKEN = re.compile(r"(?:token|bearer)\s+(\S+)", re.IGNORECASE)
_STUDENTS_PAGE = re.compile(r"user/([\w\-.@~%!+]+)(/[\w\-./@~%=?&]*)?", re.ASCII)
"""Path of a world's page, without what is before it at this hub."""
PAGES = re.compile(r"/|/teacher|/teacher/look/[\w-]+|/projector|/check|/privacy|/oauth_callback")
"""Paths of pages, to which other sites may lead a person, such as the one where users sign in."""


def hub_class_app(
    store: ClassStore,
    seats: Seats,
    hub: HubEnvironment,
    *,
    teachers: Iterable[str],
    blocks: Iterable[Path] = (),
) -> ASGIApp:
    """Return the ASGI app of a class at a hub.

    Args:
        store: of the class.
        seats: of the class.
        hub: environment of the service.
        teachers: groups of the hub whose members are teachers; its admins always are.
        blocks: Python files with the teacher's blocks.
    """
    live = LiveClass(store, seats, _NoRooms(), EpisodeCheck(blocks))
    api, groups = HubApi(hub), tuple(teachers)
    sign_in, hub_seats = SignIn(hub, api), _HubSeats(store, seats)

    def join_here(url: str) -> tuple[str, str]:
        address = hub.public_url or f"{url.rstrip('/')}{hub.prefix}"
        return address, qr_code(address)

    events = ClassEvents(live, join_here, asks_for_code=False)
    student = _HubStudent(live, hub, api, sign_in, hub_seats, groups)
    teacher = Teacher(live, events, RoomProxy((), lambda _: ""))
    auth = Middleware(TeacherAuth, sign_in=sign_in, groups=groups)
    projector = WallSocket(live, events, is_projected=True)
    strangers = stranger_sockets()
    link = LinkEndpoint(live, strangers, seat_sockets(), student.room_of)
    app = Starlette(
        routes=[
            Route("/", student.page),
            Route("/oauth_callback", sign_in.callback),
            Route("/api/me", student.me),
            Route("/api/hub-seat", student.seat, methods=["POST"]),
            Route("/check", page_route("check.html")),
            WebSocketRoute("/check/socket", Echo(strangers)),
            Route("/privacy", page_route("privacy.html")),
            *FILE_ROUTES,
            WebSocketRoute(LINK_PATH, link),
            Route("/api/names", Join(seats).names, middleware=[auth]),
            Route("/teacher", teacher.page, middleware=[auth]),
            Route("/teacher/state", teacher.state, middleware=[auth]),
            Route("/teacher/export", teacher.export, middleware=[auth]),
            Route("/teacher/command", teacher.command, methods=["POST"], middleware=[auth]),
            Route("/teacher/look/{room}", _LookIn(live, hub, hub_seats).page, middleware=[auth]),
            *TournamentFiles(live.tournament).routes(auth),
            WebSocketRoute("/teacher/socket", WallSocket(live, events), middleware=[auth]),
            Route("/projector", page_route("projector.html"), middleware=[auth]),
            WebSocketRoute("/projector/socket", projector, middleware=[auth]),
        ],
        # the hub's proxy passes any name on, and no name opens anything without a sign-in
        middleware=[Middleware(HostOriginCheck, allowed_hosts=("*",), pages=PAGES)],
    )
    return _BehindHub(app, hub.prefix)


class _HubSeats:
    """The seat of each user of the hub.

    The class stores a keyed hash of the user's name, and not the name. The hash finds the seat
    again at the next sign-in. Without the key, nobody can compute it from a list of names; the key
    lies in the class's file beside it.

    Args:
        store: of the class.
        seats: of the class.
    """

    def __init__(self, store: ClassStore, seats: Seats) -> None:
        self._store, self._seats = store, seats

    def find(self, user: HubUser) -> SeatRow | None:
        """Return a user's seat; None if there is none that may enter."""
        return self._seats.by_identity(self._identity_of(user.name))

    def admit(self, user: HubUser) -> SeatRow:
        """Return a user's seat, which is made if there is none.

        Raises:
            JoinError: the seat is banned, or the class is closed or full.
        """
        return self._seats.admit(self._identity_of(user.name))

    def is_of(self, number: int, name: str) -> bool:
        """Return True if a seat is that of the user with this name."""
        seat = self._seats.by_identity(self._identity_of(name))
        return seat is not None and seat.number == number

    def _identity_of(self, name: str) -> bytes:
        """Return the keyed hash of a user's name."""
        return hmac.digest(self._key(), name.encode(), "sha256")

    def _key(self) -> bytes:
        return bytes.fromhex(self._store.setting_or("hub_key", lambda: secrets.token_hex(32)))


class _HubStudent:
    """Routes for a user of the hub who is in the class.

    Args:
        live: the class.
        hub: environment of the service.
        api: of the hub.
        sign_in: knows whose browser it is.
        seats: of the hub's users.
        teachers: the hub's groups of teachers.
    """

    def __init__(
        self,
        live: LiveClass,
        hub: HubEnvironment,
        api: HubApi,
        sign_in: SignIn,
        seats: _HubSeats,
        teachers: tuple[str, ...],
    ) -> None:
        self._live, self._hub, self._api = live, hub, api
        self._sign_in, self._seats, self._teachers = sign_in, seats, teachers

    async def page(self, request: Request) -> Response:
        """Return the page, after the sign-in; a teacher gets to the teacher's page."""
        try:
            user = await self._sign_in.user_of(request)
        except HubUnreachableError as error:
            headers = {"Retry-After": "2", "Refresh": "2", **NO_STORE}
            return TextResponse(text_of(error), 503, headers)
        except NoAccessError as error:
            return TextResponse(text_of(error), 403, NO_STORE)
        if user is None:
            return self._sign_in.begin(request)
        if is_teacher(user, self._teachers):
            return RedirectResponse(f"{self._hub.prefix}teacher", 303, NO_STORE)
        return standalone_page("hub.html")

    async def me(self, request: Request) -> Response:
        """Return a browser's seat, and the way to the student's own server."""
        return await self._seat(self._sign_in.user_of(request))

    async def seat(self, request: Request) -> Response:
        """Return the seat of a program that has a token of the hub."""
        found = _TOKEN.fullmatch(request.headers.get("authorization", ""))
        if found is None:
            return problem(SIGN_IN, 401)
        return await self._seat(self._api.user_of(found[1], client_address(request.scope)))

    async def room_of(self, token: str, address: str) -> LiveRoom | None:
        """Return the room of a link with a token of the hub; None if its user has no seat.

        Args:
            token: from the link.
            address: of its sender.

        Raises:
            HubUnreachableError: the hub does not answer.
        """
        try:
            user = await self._api.user_of(token, address)
        except NoAccessError:
            return None
        seat = None if user is None else await asyncio.to_thread(self._seats.find, user)
        return None if seat is None else self._live.room(remote_id(seat.number), seat.number)

    async def _seat(self, asked: Awaitable[HubUser | None]) -> Response:
        try:
            user = await asked
        except HubUnreachableError as error:
            return problem(text_of(error), 503)
        except NoAccessError as error:
            return problem(text_of(error), 403)
        if user is None:
            return problem(SIGN_IN, 401)
        try:
            seat = await asyncio.to_thread(self._seats.admit, user)
        except JoinError as error:
            return problem(text_of(error), 403)
        except StoreError as error:
            return storage_problem(error)
        self._live.tell_people()
        return JSONResponse(self._told(seat), headers=NO_STORE)

    def _told(self, seat: SeatRow) -> dict[str, str]:
        return {
            "name": seat.name,
            "colour": seat.colour,
            "notebooks": f"{self._hub.hub_url}user-redirect/",
            "world": f"{self._hub.hub_url}user-redirect/ai4u-edu/",
        }


class _NoRooms:
    """Host without rooms: all worlds are students' own, and keep links to the class."""

    is_hosting = False

    async def enter(self, room: str, scene: str) -> RoomAddress:
        """Refuse to start a room."""
        raise RoomError(
            _(
                "expected a world on the student's own server, got {room!r}, {scene!r}",
                room=room,
                scene=scene,
            )
        )

    def in_use(self, room: str) -> AbstractContextManager[None]:  # noqa: ARG002 - of a protocol
        """Do nothing."""
        return nullcontext()

    def room_of(self, secret: str) -> str:  # noqa: ARG002 - of a protocol
        """Return that no room has this secret."""
        return ""

    def is_used(self, room: str) -> bool:  # noqa: ARG002 - of a protocol
        """Return False."""
        return False

    def is_running(self, room: str) -> bool:  # noqa: ARG002 - of a protocol
        """Return False."""
        return False

    async def end(self, room: str) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""


class _LookIn:
    """Route that leads a teacher to the page of a room on a student's server, through the hub.

    The hub checks whether the teacher may use that server: an admin, or somebody to whom it is
    shared. So the class needs no permission for it.

    Args:
        live: the class.
        hub: environment of the service.
        seats: of the hub's users.
    """

    def __init__(self, live: LiveClass, hub: HubEnvironment, seats: _HubSeats) -> None:
        self._live, self._hub, self._seats = live, hub, seats

    async def page(self, request: Request) -> Response:
        """Return the redirect."""
        room = self._live.rooms.get(request.path_params["room"])
        if room is None or room.link is None or room.state is None or not room.state.page:
            text = _("This world has no page now. Reload the class's page.")
            return TextResponse(text, 404, NO_STORE)
        # a student's program says where its page is; it may lead to that student's server only
        user = _user_of_page(room.state.page)
        if not user or not await asyncio.to_thread(self._seats.is_of, room.seat, user):
            text = _("This world gave an address that is not on its student's server.")
            return TextResponse(text, 403, NO_STORE)
        return RedirectResponse(f"{self._hub.hub_url}{room.state.page}", 303, NO_STORE)


def _user_of_page(page: str) -> str:
    """Return the name of the user on whose server a page is; empty if the path is no such page.

    >>> _user_of_page("user/ada/proxy/4000/?token=abc"), _user_of_page("user/ada/%2e%2e/grace/")
    ('ada', '')
    """
    match = _STUDENTS_PAGE.fullmatch(page)
    path, _, _ = page.partition("?")
    # browsers go up at such a part, also if it is escaped
    if match is None or {".", ".."} & {*unquote(path).split("/")}:
        return ""
    return unquote(match[1])


class _BehindHub:
    """ASGI middleware that removes the service's prefix, which the hub's proxy leaves in paths.

    It also takes over the scheme that the browser uses. A client can forge that header for its own
    requests only, where it has no use.

    Args:
        app: the app, which has no prefix.
        prefix: such as ``/services/ai4u-class/``.
    """

    def __init__(self, app: ASGIApp, prefix: str) -> None:
        self._app, self._prefix = app, prefix.rstrip("/")

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on without the prefix."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        path: str = scope["path"]
        if path == self._prefix and scope["type"] == "http":
            await RedirectResponse(f"{self._prefix}/")(scope, receive, send)
        elif path.startswith(f"{self._prefix}/"):
            inner_path = path.removeprefix(self._prefix)
            inner = {
                **scope,
                "path": inner_path,
                "raw_path": quote(inner_path).encode(),  # the one that was sent may be escaped
                "scheme": _scheme(scope),
            }
            await self._app(inner, receive, send)
        elif scope["type"] == "http":
            text = _("expected a path below {prefix}/", prefix=self._prefix)
            await TextResponse(text, 404)(scope, receive, send)
        else:
            await WebSocketClose()(scope, receive, send)


def _scheme(scope: Scope) -> str:
    given = next((value for name, value in scope["headers"] if name == b"x-forwarded-proto"), b"")
    is_secure = given.partition(b",")[0].strip().lower() in (b"https", b"wss")
    scheme: str = scope["scheme"]
    return {"http": "https", "ws": "wss"}.get(scheme, scheme) if is_secure else scheme
