"""One room: a world that runs, its viewer, and everything that a browser asks of them."""

import time
from collections.abc import Callable, Collection
from functools import partial

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Match, Mount, Route, WebSocketRoute
from starlette.types import Scope

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server.api import Health, SnapshotView
from ai4u_edu.server.attempts import Attempts, LimitScripts
from ai4u_edu.server.host_origin import LOOPBACK, HostOriginCheck
from ai4u_edu.server.input import Inputs
from ai4u_edu.server.openapi import openapi
from ai4u_edu.server.page import Page
from ai4u_edu.server.past import Past
from ai4u_edu.server.proxy import ViserProxy
from ai4u_edu.server.scripts import RemoteSockets, Rules
from ai4u_edu.server.token_auth import TokenAuth
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.wire.native import PROBLEMS


def room_app(
    runner: Runner,
    *,
    viser_port: int,
    title: str | Callable[[], str],
    allowed_hosts: Collection[str] = LOOPBACK,
    proxy_hosts: Collection[str] = (),
    rules: Rules | None = None,
) -> Starlette:
    """The ASGI app of one room; may be put under any path with :class:`RoomMount`.

    Args:
        runner: lets the world run; started by the caller.
        viser_port: where the room's viser listens, on 127.0.0.1.
        title: of the page, and the scene's name in the API; or what tells it, where it may change.
        allowed_hosts: names under which the room may be asked for; see
            :mod:`ai4u_edu.server.host_origin`.
        proxy_hosts: names under which a proxy gives out the page; see there.
        rules: for scripts that drive agents from other machines; their token is asked for by the
            page and the API too.
    """
    began = time.monotonic()
    rules = rules or Rules()
    called = title if callable(title) else partial(str, title)
    page = Page(called)
    attempts = Attempts()
    guard = [Middleware(TokenAuth, token=rules.token, attempts=attempts)]
    page_guard = [Middleware(TokenAuth, token=rules.token, attempts=attempts, is_page=True)]
    script_guard = [Middleware(LimitScripts, attempts=attempts, code=PROBLEMS["bad_token"])]
    past = Past(runner)
    document = openapi()
    described: tuple[Snapshot | None, str] = None, ""

    async def healthz(_: Request) -> Response:  # needs no worker thread: they may all be busy
        stall = runner.stall
        health = Health.of(runner.latest, called(), time.monotonic() - began, stall)
        return _json(health.model_dump_json(), status=503 if stall else 200)

    async def snapshot(_: Request) -> Response:
        nonlocal described
        latest = runner.latest
        if described[0] is not latest:  # however many ask, it is described once
            described = latest, SnapshotView.of(latest).model_dump_json()
        return _json(described[1])

    async def describe(_: Request) -> Response:
        return JSONResponse(document)

    return Starlette(
        routes=[
            Route("/", page.index, middleware=page_guard),
            Route("/web/{file}", page.file, middleware=guard),
            Route("/healthz", healthz, middleware=guard),
            Route("/api/snapshot", snapshot, middleware=guard),
            Route("/api/past", past.list, middleware=guard),
            Route("/api/past/{file}", past.file, middleware=guard),
            Route("/api/openapi.json", describe, middleware=guard),
            WebSocketRoute("/", ViserProxy(viser_port, rules.token), middleware=guard),
            WebSocketRoute("/ws/input", Inputs(runner, called), middleware=guard),
            # asks for the token itself, in the hello
            WebSocketRoute(
                "/ws/remote", RemoteSockets(runner, called, rules), middleware=script_guard
            ),
        ],
        middleware=[
            Middleware(HostOriginCheck, allowed_hosts=allowed_hosts, proxy_hosts=proxy_hosts)
        ],
    )


class RoomMount(Mount):
    """Puts a room under a path.

    An ordinary mount at ``/lab`` does not answer to a WebSocket at ``/lab``, only at ``/lab/``;
    viser's client asks for the page's address without its slash.
    """

    def matches(self, scope: Scope) -> tuple[Match, Scope]:
        """Whether, and as what, the room answers."""
        match, child = super().matches(scope)
        if match is Match.NONE and scope["type"] == "websocket":
            slashed = scope["path"] + "/"
            match, child = super().matches({**scope, "path": slashed})
            if match is not Match.NONE:
                child["path"] = slashed
        return match, child


def _json(text: str, *, status: int = 200) -> Response:
    headers = {"Cache-Control": "no-store"}
    return Response(text, status, media_type="application/json", headers=headers)
