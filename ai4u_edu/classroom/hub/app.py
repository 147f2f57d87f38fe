"""The web app of a class that is a service of a JupyterHub."""

import re
from collections.abc import Iterable
from pathlib import Path

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp

from ai4u_edu.classroom.class_event import ClassEvents
from ai4u_edu.classroom.echo import Echo
from ai4u_edu.classroom.episode_check import EpisodeCheck
from ai4u_edu.classroom.hub.api import HubApi
from ai4u_edu.classroom.hub.environment import HubEnvironment
from ai4u_edu.classroom.hub.hub_seats import HubSeats
from ai4u_edu.classroom.hub.look_in import LookIn
from ai4u_edu.classroom.hub.no_rooms import NoRooms
from ai4u_edu.classroom.hub.prefix import BehindHub
from ai4u_edu.classroom.hub.sign_in import SignIn
from ai4u_edu.classroom.hub.student import HubStudent
from ai4u_edu.classroom.hub.teacher_auth import TeacherAuth
from ai4u_edu.classroom.join import Join
from ai4u_edu.classroom.link_endpoint import LinkEndpoint
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.open_limits import seat_sockets, stranger_sockets
from ai4u_edu.classroom.pages import FILE_ROUTES, page_route
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.seats import Seats
from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.classroom.teacher import Teacher, qr_code
from ai4u_edu.classroom.teacher_socket import WallSocket
from ai4u_edu.classroom.tournament.files import TournamentFiles
from ai4u_edu.page.server.host_origin import HostOriginCheck
from ai4u_edu.wire.class_link import PATH as LINK_PATH

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
    live = LiveClass(store, seats, NoRooms(), EpisodeCheck(blocks))
    api, groups = HubApi(hub), tuple(teachers)
    sign_in, hub_seats = SignIn(hub, api), HubSeats(store, seats)

    def join_here(url: str) -> tuple[str, str]:
        address = hub.public_url or f"{url.rstrip('/')}{hub.prefix}"
        return address, qr_code(address)

    events = ClassEvents(live, join_here, asks_for_code=False)
    student = HubStudent(live, hub, api, sign_in, hub_seats, groups)
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
            Route("/teacher/look/{room}", LookIn(live, hub, hub_seats).page, middleware=[auth]),
            *TournamentFiles(live.tournament).routes(auth),
            WebSocketRoute("/teacher/socket", WallSocket(live, events), middleware=[auth]),
            Route("/projector", page_route("projector.html"), middleware=[auth]),
            WebSocketRoute("/projector/socket", projector, middleware=[auth]),
        ],
        # the hub's proxy passes any name on, and no name opens anything without a sign-in
        middleware=[Middleware(HostOriginCheck, allowed_hosts=("*",), pages=PAGES)],
    )
    return BehindHub(app, hub.prefix)
