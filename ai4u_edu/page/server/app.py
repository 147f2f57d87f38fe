"""The web app of one room: a running world, its page, and the API."""

from collections.abc import Awaitable, Callable, Collection, Mapping
from functools import partial
from pathlib import Path

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import Match, Mount, Route, WebSocketRoute
from starlette.types import ASGIApp, Scope

from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.server.class_feed import ClassFeed
from ai4u_edu.page.server.host_origin import LOOPBACK, HostOriginCheck
from ai4u_edu.page.server.input import Inputs
from ai4u_edu.page.server.library_pictures import PICTURE_PATH, library_picture_route
from ai4u_edu.page.server.limits.attempts import Attempts, LimitScripts
from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS, Timeouts
from ai4u_edu.page.server.page import PageRoutes
from ai4u_edu.page.server.past import Past
from ai4u_edu.page.server.proxy import ViserProxy
from ai4u_edu.page.server.reader_language import ReaderLanguage
from ai4u_edu.page.server.scene_routes import SceneRoutes
from ai4u_edu.page.server.scripts import RemoteSockets, Rules, ScriptLog
from ai4u_edu.page.server.start_page import MissionsView, StartPage
from ai4u_edu.page.server.state_routes import StateRoutes
from ai4u_edu.page.server.token_auth import TokenAuth
from ai4u_edu.page.server.token_page import PUBLIC_FILES, TokenPage
from ai4u_edu.page.server.viser_lockdown import PROXY_SECRET
from ai4u_edu.page.server.web_files import ALWAYS_ASK, WEB_PATHS, VendorFiles, program_zip
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire.native import PROBLEMS


def room_app(
    runner: Runner,
    *,
    viser_port: int,
    viser_secret: str = PROXY_SECRET,
    title: str | Callable[[], str],
    allowed_hosts: Collection[str] = LOOPBACK,
    proxy_hosts: Collection[str] = (),
    rules: Rules | None = None,
    panel: ASGIApp | None = None,
    tab_scripts: Mapping[str, Path] | None = None,
    editor: SceneEditor | None = None,
    missions: Callable[[], MissionsView] = MissionsView,
    class_feed: ClassFeed | None = None,
    script_report: ScriptLog | None = None,
    timeouts: Timeouts = DEFAULT_TIMEOUTS,
) -> Starlette:
    """Return the ASGI app of one room; mount it under a path with :class:`RoomMount`.

    Args:
        runner: runs the world; the caller starts it.
        viser_port: where the room's viser listens, on 127.0.0.1.
        viser_secret: viser's, if it has one of its own.
        title: the page's title and the scene's name in the API; a function if it may change.
        allowed_hosts: host names of requests; see :mod:`ai4u_edu.page.server.host_origin`.
        proxy_hosts: host names of a reverse proxy in front; see there.
        rules: for scripts that drive agents from other machines; the page and the API ask for
            their token too.
        panel: serves the sockets of the pages' panels; default: pages have viser's panel only.
        tab_scripts: modules of the tabs that options bring, by the tab's name.
        editor: lets pages open and share scenes; without it the scene stays as it is, and there is
            no start page.
        missions: returns the missions that the start page shows.
        class_feed: of the class that the room belongs to; pages show it.
        script_report: of what happens with scripts, for whoever runs the room.
        timeouts: time limits of the room's answers; those of connections belong to the server.
    """
    rules = rules or Rules()
    current_title = title if callable(title) else partial(str, title)
    page = PageRoutes(current_title, has_panel=panel is not None)
    attempts = Attempts()
    auth = [Middleware(TokenAuth, token=rules.token, attempts=attempts)]
    page_auth = [
        Middleware(TokenAuth, token=rules.token, attempts=attempts, token_page=TokenPage())
    ]
    script_limit = [Middleware(LimitScripts, attempts=attempts, code=PROBLEMS["bad_token"])]
    past = Past(runner)
    state = StateRoutes(runner, current_title, can_open=editor is not None)
    scenes: list[Route] = []
    if editor is not None:
        scenes = _scene_routes(
            SceneRoutes(runner, editor, timeouts.open_scene),
            StartPage(missions, editor),
            auth,
            page_auth,
        )
    return Starlette(
        routes=[
            Route("/", page.index, middleware=page_auth),
            *_script_routes(tab_scripts or {}, auth),
            *_file_routes(page, auth),
            Route("/program.zip", program_zip, middleware=auth),
            Route("/healthz", state.health, middleware=auth),
            Route("/api/snapshot", state.snapshot, middleware=auth),
            Route("/api/training", state.training, middleware=auth),
            Route("/api/past", past.list, middleware=auth),
            Route("/api/past/{file}", past.file, middleware=auth),
            Route("/api/openapi.json", state.describe, middleware=auth),
            *scenes,
            WebSocketRoute(
                "/",
                ViserProxy(viser_port, rules.token, viser_secret, timeouts.viser),
                middleware=auth,
            ),
            WebSocketRoute("/ws/input", Inputs(runner, current_title, class_feed), middleware=auth),
            *([WebSocketRoute("/ws/panel", panel, middleware=auth)] if panel is not None else []),
            # scripts send the token in their hello
            WebSocketRoute(
                "/ws/remote",
                RemoteSockets(runner, current_title, rules, script_report),
                middleware=script_limit,
            ),
        ],
        middleware=[
            Middleware(ReaderLanguage),
            Middleware(HostOriginCheck, allowed_hosts=allowed_hosts, proxy_hosts=proxy_hosts),
        ],
    )


def _script_routes(scripts: Mapping[str, Path], auth: list[Middleware]) -> list[Route]:
    def route_of(script: Path) -> Callable[[Request], Awaitable[Response]]:
        async def route(_: Request) -> Response:
            return FileResponse(script, headers=ALWAYS_ASK, media_type="text/javascript")

        return route

    return [
        Route(f"{folder}/options/{name}.js", route_of(script), middleware=auth)
        for folder in WEB_PATHS
        for name, script in scripts.items()
    ]


def _file_routes(page: PageRoutes, auth: list[Middleware]) -> list[Route]:
    files = {
        "/styles/all.css": page.styles,
        "/vendor/{file:path}": VendorFiles().file,
        "/{file:path}": page.file,
    }
    public = [Route(f"/web/{name}", page.public_file(name)) for name in PUBLIC_FILES]
    return public + [
        Route(folder + path, route, middleware=auth)
        for folder in WEB_PATHS
        for path, route in files.items()
    ]


def _scene_routes(
    scenes: SceneRoutes, start: StartPage, auth: list[Middleware], page_auth: list[Middleware]
) -> list[Route]:
    return [
        Route("/start", start.page, middleware=page_auth),
        Route("/api/scene", scenes.present, methods=["GET"], middleware=auth),
        Route("/api/scene", scenes.open, methods=["POST"], middleware=auth),
        Route("/api/scene/link", scenes.link, methods=["GET"], middleware=auth),
        Route("/api/scene/link", scenes.describe, methods=["POST"], middleware=auth),
        Route("/api/scenes", start.scenes, middleware=auth),
        Route(PICTURE_PATH, library_picture_route, middleware=auth),
        Route("/api/missions", start.missions, middleware=auth),
    ]


class RoomMount(Mount):
    """Mount of a room under a path.

    starlette's mount at ``/lab`` does not match a WebSocket at ``/lab``, only at ``/lab/``; viser's
    client connects to the page's address without its slash.
    """

    def matches(self, scope: Scope) -> tuple[Match, Scope]:
        """Return whether a request is for the room, and its scope there."""
        match, child = super().matches(scope)
        if match is Match.NONE and scope["type"] == "websocket":
            slashed = scope["path"] + "/"
            match, child = super().matches({**scope, "path": slashed})
            if match is not Match.NONE:
                child["path"] = slashed
        return match, child
