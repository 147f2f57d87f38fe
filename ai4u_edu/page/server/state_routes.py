"""HTTP routes for the state of a room: health, snapshot, and the API's description."""

import time
from collections.abc import Callable
from functools import cache
from typing import Any

from pydantic import BaseModel
from pydantic.json_schema import models_json_schema
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.base.version import __version__
from ai4u_edu.page.server.api import Health, SnapshotView, TrainingView
from ai4u_edu.page.server.past import RECORDING, WRITERS, PastView
from ai4u_edu.page.server.scene_routes import (
    LinkRequest,
    LinkView,
    OpenRequest,
    SceneView,
    SharedView,
)
from ai4u_edu.page.server.start_page import MissionsView, ScenesView
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot

_ANSWERS: dict[str, tuple[str, type[BaseModel]]] = {
    "/healthz": ("Whether the room is well.", Health),
    "/api/snapshot": ("Everything at the last tick.", SnapshotView),
    "/api/training": ("Progress of the training whose policy drives.", TrainingView),
    "/api/past": ("The kept episodes.", PastView),
}

_SCENE_ANSWERS: dict[str, tuple[str, type[BaseModel]]] = {
    "/api/scene": ("The scene that runs.", SceneView),
    "/api/scene/link": ("A link to the scene that runs.", LinkView),
    "/api/scenes": ("The library's scenes.", ScenesView),
    "/api/missions": ("The missions of the map.", MissionsView),
}
_SCENE_REQUESTS: dict[str, tuple[str, type[BaseModel]]] = {
    "/api/scene": ("Open a scene.", OpenRequest),
    "/api/scene/link": ("Read a link, and open nothing.", LinkRequest),
}


class StateRoutes:
    """Routes for the state of a room.

    They are async, since all worker threads may be busy.

    Args:
        runner: runs the world.
        title: returns the scene's present title.
        can_open: True if the room has the routes that open scenes.
    """

    def __init__(self, runner: Runner, title: Callable[[], str], *, can_open: bool) -> None:
        self._runner, self._title = runner, title
        self._began = time.monotonic()
        self._can_open = can_open
        self._cached: tuple[Snapshot | None, str] = None, ""

    async def health(self, _: Request) -> Response:
        """Return the room's health, with status 503 if a block does not return."""
        runner, uptime = self._runner, time.monotonic() - self._began
        stall = runner.stall
        health = Health.of(runner.latest, self._title(), uptime, stall)
        return _json(health.model_dump_json(), status=503 if stall else 200)

    async def snapshot(self, _: Request) -> Response:
        """Return the latest snapshot."""
        latest = self._runner.latest
        if self._cached[0] is not latest:
            self._cached = latest, SnapshotView.of(latest).model_dump_json()
        return _json(self._cached[1])

    async def training(self, _: Request) -> Response:
        """Return the progress of a training whose policy drives here."""
        return _json(TrainingView(training=self._runner.training).model_dump_json())

    async def describe(self, _: Request) -> Response:
        """Return the API's OpenAPI document."""
        return JSONResponse(_openapi(can_open=self._can_open))


def _json(text: str, *, status: int = 200) -> Response:
    headers = {"Cache-Control": "no-store"}
    return Response(text, status, media_type="application/json", headers=headers)


@cache
def _openapi(*, can_open: bool) -> dict[str, Any]:
    """Return the OpenAPI 3.1 document, which is derived from the models of the answers.

    Args:
        can_open: True if the room has the routes that open scenes.
    """
    answers = _ANSWERS | (_SCENE_ANSWERS if can_open else {})
    models = [model for _, model in answers.values()]
    if can_open:
        models += [SharedView, *(model for _, model in _SCENE_REQUESTS.values())]
    _, schemas = models_json_schema(
        [(model, "serialization") for model in models],
        ref_template="#/components/schemas/{model}",
    )
    paths = {
        path: _get(summary, {"$ref": f"#/components/schemas/{model.__name__}"})
        for path, (summary, model) in answers.items()
    }
    if can_open:
        for path, (summary, model) in _SCENE_REQUESTS.items():
            paths[path] |= _post(summary, model)
        paths["/api/scenes/{file}"] = _picture("A picture of a scene of the library.")
    health = paths["/healthz"]["get"]["responses"]
    health["503"] = {**health["200"], "description": "A block of the world does not return."}
    paths["/api/past/{file}"] = _file("A kept episode as a file.")
    paths["/api/openapi.json"] = _get("This document.", {"type": "object"})
    return {
        "openapi": "3.1.0",
        "info": {"title": "AI4U Edu", "version": __version__},
        # relative to this document's address, which may have a path prefix
        "servers": [{"url": ".."}],
        "paths": paths,
        "components": {"schemas": schemas["$defs"]},
    }


def _get(summary: str, schema: dict[str, Any]) -> dict[str, Any]:
    content = {"application/json": {"schema": schema}}
    return {
        "get": {
            "summary": summary,
            "responses": {
                "200": {"description": "OK", "content": content},
                "401": {"description": "The room has a token, and the request does not."},
                "403": {"description": "The host name is not allowed, or another site asks."},
                "429": {"description": "Too many wrong tokens; Retry-After gives the delay."},
            },
        }
    }


def _post(summary: str, model: type[BaseModel]) -> dict[str, Any]:
    post = _get(summary, {"$ref": f"#/components/schemas/{SharedView.__name__}"})["get"]
    schema = {"$ref": f"#/components/schemas/{model.__name__}"}
    post["requestBody"] = {"required": True, "content": {"application/json": {"schema": schema}}}
    post["responses"] |= {
        "404": {"description": "No scene has that name."},
        "409": {"description": "The world can't open the scene; the text gives the reason."},
        "413": {"description": "The body is too large."},
        "415": {"description": "The body is not JSON."},
        "422": {"description": "The link or its scene can't be used; the text gives the reason."},
        "503": {"description": "The world does not answer, or too many scenes wait."},
    }
    return {"post": post}


def _picture(summary: str) -> dict[str, Any]:
    responses = {"404": {"description": "No scene has that name."}}
    about = "the scene's name and .png"
    return _file_at(summary, about, r"^[a-z0-9_]+\.png$", "image/png", responses)


def _file(summary: str) -> dict[str, Any]:
    known = "|".join((RECORDING, *WRITERS))
    responses = {
        "404": {"description": "No such episode is kept; the text lists those that are."},
        "409": {"description": "The file can't be made; the text gives the reason."},
        "503": {"description": "Too many files are being made; Retry-After gives the delay."},
    }
    about = "the episode's number, and what to make of it"
    return _file_at(summary, about, rf"^[0-9]+\.({known})$", "*/*", responses)


def _file_at(
    summary: str, about: str, pattern: str, media_type: str, responses: dict[str, Any]
) -> dict[str, Any]:
    """Describe a file whose name is the last part of the path."""
    described = _get(summary, {})
    found = described["get"]
    found["parameters"] = [
        {
            "name": "file",
            "in": "path",
            "required": True,
            "description": about,
            "schema": {"type": "string", "pattern": pattern},
        }
    ]
    found["responses"]["200"]["content"] = {media_type: {}}
    found["responses"] |= responses
    return described
