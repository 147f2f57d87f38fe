"""One room: a world that runs, its viewer, and everything that a browser asks of them."""

import time
from collections.abc import Collection

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Match, Mount, Route, WebSocketRoute
from starlette.types import Scope

from ai4u_edu.runner import Runner
from ai4u_edu.server.api import Health, SnapshotView
from ai4u_edu.server.door import LOOPBACK, Door
from ai4u_edu.server.input import Inputs
from ai4u_edu.server.openapi import openapi
from ai4u_edu.server.page import Page
from ai4u_edu.server.proxy import ViserProxy


def room_app(
    runner: Runner, *, viser_port: int, title: str, allowed_hosts: Collection[str] = LOOPBACK
) -> Starlette:
    """The ASGI app of one room; may be put under any path with :class:`RoomMount`.

    Args:
        runner: lets the world run; started by the caller.
        viser_port: where the room's viser listens, on 127.0.0.1.
        title: of the page, and the scene's name in the API.
        allowed_hosts: names under which the room may be asked for; see :mod:`ai4u_edu.server.door`.
    """
    began = time.monotonic()
    page = Page(title)
    document = openapi()

    def healthz(_: Request) -> Response:
        health = Health.of(runner.latest, title, time.monotonic() - began)
        return _json(health.model_dump_json())

    def snapshot(_: Request) -> Response:
        return _json(SnapshotView.of(runner.latest).model_dump_json())

    def describe(_: Request) -> Response:
        return JSONResponse(document)

    return Starlette(
        routes=[
            Route("/", page.index),
            Route("/web/{file}", page.file),
            Route("/healthz", healthz),
            Route("/api/snapshot", snapshot),
            Route("/api/openapi.json", describe),
            WebSocketRoute("/", ViserProxy(viser_port)),
            WebSocketRoute("/ws/input", Inputs(runner)),
        ],
        middleware=[Middleware(Door, allowed_hosts=allowed_hosts)],
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


def _json(text: str) -> Response:
    return Response(text, media_type="application/json", headers={"Cache-Control": "no-store"})
