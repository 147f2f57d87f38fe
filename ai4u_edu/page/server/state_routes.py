"""HTTP routes for the state of a room: health, snapshot, and the API's description."""

import time
from collections.abc import Callable

from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.page.server.api import Health, SnapshotView, TrainingView
from ai4u_edu.page.server.openapi import openapi
from ai4u_edu.recording.snapshot import Snapshot
from ai4u_edu.runtime.runner import Runner


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
        self._document = openapi(can_open=can_open)
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
        return JSONResponse(self._document)


def _json(text: str, *, status: int = 200) -> Response:
    headers = {"Cache-Control": "no-store"}
    return Response(text, status, media_type="application/json", headers=headers)
