"""Route with which a student takes the own work home."""

import asyncio
from collections.abc import Awaitable, Callable

from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

from ai4u_edu.classroom.join import NO_STORE, seat_of
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.work_zip import seat_zip, zip_response


def my_work_route(live: LiveClass) -> Callable[[Request], Awaitable[Response]]:
    """Return a route's function that answers with a ZIP file of a seat's work."""

    async def answer(request: Request) -> Response:
        seat = seat_of(live.seats, request)
        if seat is None:
            return PlainTextResponse("this browser has no place in the class\n", 403, NO_STORE)
        return zip_response(await asyncio.to_thread(seat_zip, live, seat), "my-work.zip")

    return answer
