"""HTTP routes of a hub's students: their page, and the seat of a program on their server."""

import asyncio
import re

from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, RedirectResponse, Response

from ai4u_edu.classroom.errors import JoinError, StoreError
from ai4u_edu.classroom.hub.api import HubApi, HubUnreachableError, HubUser, NoAccessError
from ai4u_edu.classroom.hub.environment import HubEnvironment
from ai4u_edu.classroom.hub.hub_seats import HubSeats
from ai4u_edu.classroom.hub.sign_in import SignIn
from ai4u_edu.classroom.hub.teacher_auth import SIGN_IN, is_teacher
from ai4u_edu.classroom.join import NO_STORE, problem
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.live_rooms import LiveRoom, remote_id
from ai4u_edu.classroom.store import SeatRow
from ai4u_edu.page.server.limits.attempts import client_address
from ai4u_edu.page.server.standalone import standalone_page

_TOKEN = re.compile(r"(?:token|bearer)\s+(\S+)", re.IGNORECASE)


class HubStudent:
    """Routes for a user of the hub who is in the class.

    Args:
        live: the class.
        hub: environment of the service.
        api: of the hub.
        sign_in: knows whose browser it is.
        seats: of the hub's users.
        teachers: the hub's groups of teachers.
    """

    def __init__(
        self,
        live: LiveClass,
        hub: HubEnvironment,
        api: HubApi,
        sign_in: SignIn,
        seats: HubSeats,
        teachers: tuple[str, ...],
    ) -> None:
        self._live, self._hub, self._api = live, hub, api
        self._sign_in, self._seats, self._teachers = sign_in, seats, teachers

    async def page(self, request: Request) -> Response:
        """Return the page, after the sign-in; a teacher gets to the teacher's page."""
        try:
            user = await self._sign_in.user_of(request)
        except HubUnreachableError as error:
            headers = {"Retry-After": "2", "Refresh": "2", **NO_STORE}
            return PlainTextResponse(f"{error}\n", 503, headers)
        except NoAccessError as error:
            return PlainTextResponse(f"{error}\n", 403, NO_STORE)
        if user is None:
            return self._sign_in.begin(request)
        if is_teacher(user, self._teachers):
            return RedirectResponse(f"{self._hub.prefix}teacher", 303, NO_STORE)
        return standalone_page("hub.html")

    async def me(self, request: Request) -> Response:
        """Return a browser's seat, and the way to the student's own server."""
        try:
            user = await self._sign_in.user_of(request)
            return await self._seat(user)
        except HubUnreachableError as error:
            return problem(str(error), 503)
        except NoAccessError as error:
            return problem(str(error), 403)

    async def seat(self, request: Request) -> Response:
        """Return the seat of a program that has a token of the hub."""
        found = _TOKEN.fullmatch(request.headers.get("authorization", ""))
        try:
            address = client_address(request.scope)
            user = await self._api.user_of(found[1], address) if found else None
            return await self._seat(user)
        except HubUnreachableError as error:
            return problem(str(error), 503)
        except NoAccessError as error:
            return problem(str(error), 403)

    async def room_of(self, token: str, address: str) -> LiveRoom | None:
        """Return the room of a link with a token of the hub; None if its user has no seat.

        Args:
            token: from the link.
            address: of its sender.

        Raises:
            HubUnreachableError: the hub does not answer.
        """
        try:
            user = await self._api.user_of(token, address)
        except NoAccessError:
            return None
        seat = None if user is None else await asyncio.to_thread(self._seats.find, user)
        return None if seat is None else self._live.room(remote_id(seat.number), seat.number)

    async def _seat(self, user: HubUser | None) -> Response:
        if user is None:
            return problem(SIGN_IN, 401)
        try:
            seat = await asyncio.to_thread(self._seats.admit, user)
        except JoinError as error:
            return problem(str(error), 403)
        except StoreError as error:
            return problem(f"{error} Tell your teacher.", 503)
        self._live.tell_people()
        return JSONResponse(self._told(seat), headers=NO_STORE)

    def _told(self, seat: SeatRow) -> dict[str, str]:
        return {
            "name": seat.name,
            "colour": seat.colour,
            "notebooks": f"{self._hub.hub_url}user-redirect/",
            "world": f"{self._hub.hub_url}user-redirect/ai4u-edu/",
        }
