"""HTTP route of the stars that the programs of a seat have earned."""

import asyncio

from pydantic import BaseModel, ConfigDict, Field
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.join import NO_STORE, seat_of
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.programs import MAX_SCENE_NAME_CHARS
from ai4u_edu.classroom.seat_rate import SeatRate
from ai4u_edu.page.server.limits.json_body import read_json

MAX_BODY_BYTES = 2000


class EarnedStars(BaseModel):
    """Body of a request to keep stars."""

    model_config = ConfigDict(extra="forbid", strict=True)

    scene: str = Field(min_length=1, max_length=MAX_SCENE_NAME_CHARS)
    """Name of a scene of the library."""
    stars: int = Field(ge=1, le=3)


class StarRoutes:
    """The route of stars. Belongs to the event loop.

    Args:
        live: the class.
    """

    def __init__(self, live: LiveClass) -> None:
        self._live, self._rate = live, SeatRate()

    async def own(self, request: Request) -> Response:
        """Keep stars of the browser's seat (PUT); return all that it has, by scene."""
        live = self._live
        seat = seat_of(live.seats, request)
        if seat is None:
            return _problem("This browser has no place in the class.", 403)
        if not self._rate.is_allowed(seat.number):
            return _problem("Too many requests at once. Try again in some seconds.", 429)
        try:
            if request.method == "PUT":
                earned = await read_json(request, EarnedStars, MAX_BODY_BYTES)
                await asyncio.to_thread(live.stars.save, seat.number, earned.scene, earned.stars)
                live.stars.note(seat.number, earned.scene, earned.stars)
                live.note_change()
        except HTTPException as error:
            return _problem(error.detail, error.status_code)
        except ValueError as error:
            return _problem(str(error), 422)
        except StoreError as error:
            return _problem(f"{error} Tell your teacher.", 503)
        return JSONResponse({"stars": live.stars.of_seat(seat.number)}, headers=NO_STORE)


def _problem(text: str, status: int) -> Response:
    return JSONResponse({"problem": text}, status, NO_STORE)
