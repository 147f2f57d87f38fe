"""HTTP route of the networks of a seat, for the student's page."""

import asyncio

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.classroom.errors import NetworkError, StoreError
from ai4u_edu.classroom.join import NO_STORE, seat_of
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.seat_rate import SeatRate
from ai4u_edu.classroom.tournament.event import network_facts
from ai4u_edu.classroom.tournament.network_scene import network_scenes
from ai4u_edu.classroom.tournament.networks import TOO_LARGE, check_network
from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES

MEDIA_TYPE = "application/octet-stream"
"""Media type of a network. A browser sends it to another site only after it has asked that site."""


class NetworkRoutes:
    """The route of networks. Belongs to the event loop.

    Args:
        live: the class.
    """

    def __init__(self, live: LiveClass) -> None:
        self._live, self._networks = live, live.tournament.networks
        self._rate = SeatRate()
        self._sending: set[int] = set()

    async def own(self, request: Request) -> Response:
        """Take a network of the browser's seat (PUT); return all that it has handed in."""
        seat = seat_of(self._live.seats, request)
        if seat is None:
            return _problem("This browser has no place in the class.", 403)
        if not self._rate.is_allowed(seat.number):
            return _problem("Too many requests at once. Try again in some seconds.", 429)
        self._live.ensure_ticking()
        try:
            if request.method == "PUT":
                await self._take(seat.number, request)
            return JSONResponse(await self._facts(seat.number), headers=NO_STORE)
        except HTTPException as error:
            return _problem(error.detail, error.status_code)
        except NetworkError as error:
            return _problem(str(error), 400)
        except StoreError as error:
            return _problem(f"{error} Tell your teacher.", 503)

    async def _take(self, seat: int, request: Request) -> None:
        kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
        if kind != MEDIA_TYPE:
            raise HTTPException(415, f"Content-Type: expected {MEDIA_TYPE}, got {kind[:80]!r}")
        if seat in self._sending:
            raise HTTPException(429, "Another file of yours is being sent. Wait for its end.")
        given = request.query_params
        scene, part, file = (given.get(name, "") for name in ("scene", "part", "file"))
        self._sending.add(seat)
        try:
            # before the file is read: what is known already needs no file
            await asyncio.to_thread(check_network, scene, part, file, 1)
            data = await _body(request)
            await asyncio.to_thread(self._networks.add, seat, scene, part, file, data)
        finally:
            self._sending.discard(seat)

    async def _facts(self, seat: int) -> dict[str, object]:
        scenes = await asyncio.to_thread(network_scenes)
        now = self._live.tournament.tournaments.now
        return {
            "scenes": [
                {"name": each.name, "title": each.title, "parts": each.parts}
                for each in scenes.values()
            ],
            "scene": "" if now is None else now.scene,
            "networks": [network_facts(each) for each in self._networks.of_seat(seat)],
            "max_bytes": MAX_NETWORK_BYTES,
        }


async def _body(request: Request) -> bytes:
    """Return the body of a request.

    Raises:
        NetworkError: it is too large.
    """
    parts, size = [], 0
    async for part in request.stream():
        size += len(part)
        if size > MAX_NETWORK_BYTES:
            raise NetworkError(TOO_LARGE)
        parts.append(part)
    return b"".join(parts)


def _problem(text: str, status: int) -> Response:
    return JSONResponse({"problem": text}, status, NO_STORE)
