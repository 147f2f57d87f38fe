"""The web app of a class: joining, the way into rooms, and the teacher's page."""

import re
from collections.abc import Callable, Collection, Iterable
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.routing import Mount, Route, WebSocketRoute

from ai4u_edu.classroom.class_event import ClassEvents
from ai4u_edu.classroom.episode_check import EpisodeCheck
from ai4u_edu.classroom.join import Join
from ai4u_edu.classroom.link_endpoint import LinkEndpoint
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.open_limits import seat_requests, seat_sockets, stranger_sockets
from ai4u_edu.classroom.pages import FILE_ROUTES, Echo, page_route
from ai4u_edu.classroom.room_entrance import RoomEntrance, ScriptKeys
from ai4u_edu.classroom.room_host import RoomHost
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.seats import Seats
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.classroom.teacher import Teacher, join_code
from ai4u_edu.classroom.teacher_socket import WallSocket
from ai4u_edu.classroom.tournament.files import TournamentFiles
from ai4u_edu.classroom.work_routes import WorkRoutes
from ai4u_edu.page.server.host_origin import LOOPBACK, HostOriginCheck
from ai4u_edu.page.server.limits.attempts import Attempts
from ai4u_edu.page.server.proxy import AGENT_COOKIE, DARK_COOKIE
from ai4u_edu.page.server.reader_language import ReaderLanguage
from ai4u_edu.page.server.token_auth import PageCookie, TokenAuth
from ai4u_edu.page.server.token_page import TokenPage
from ai4u_edu.wire.class_link import MAX_FRAME_BYTES
from ai4u_edu.wire.class_link import PATH as LINK_PATH

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
