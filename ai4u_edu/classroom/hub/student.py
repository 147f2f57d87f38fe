"""A hub's students: their seats, their page, and the routes of a program on their server."""

import asyncio
import hmac
import re
import secrets

from starlette.requests import Request
from starlette.responses import JSONResponse, RedirectResponse, Response

from ai4u_edu.base.errors import text_of
from ai4u_edu.classroom.errors import JoinError, StoreError
from ai4u_edu.classroom.hub.api import HubApi, HubUnreachableError, HubUser, NoAccessError
from ai4u_edu.classroom.hub.environment import HubEnvironment
from ai4u_edu.classroom.hub.sign_in import SIGN_IN, SignIn, is_teacher
from ai4u_edu.classroom.join import NO_STORE, problem, storage_problem
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.live_rooms import LiveRoom, remote_id
from ai4u_edu.classroom.seats import Seats
from ai4u_edu.classroom.store import ClassStore, SeatRow
from ai4u_edu.page.server.limits.attempts import client_address
from ai4u_edu.page.server.reader_language import TextResponse
from ai4u_edu.page.server.standalone import standalone_page

_TOKEN = re.compile(r"(?:token|bearer)\s+(\S+)", re.IGNORECASE)


class HubSeats:
    """The seat of each user of the hub.

    The class stores a keyed hash of the user's name, and not the name. The hash finds the seat
    again at the next sign-in. Without the key, nobody can compute it from a list of names; the key
    lies in the class's file beside it.

    Args:
        store: of the class.
        seats: of the class.
    """

    def __init__(self, store: ClassStore, seats: Seats) -> None:
        self._store, self._seats = store, seats

    def find(self, user: HubUser) -> SeatRow | None:
        """Return a user's seat; None if there is none that may enter."""
        return self._seats.by_identity(self._identity_of(user.name))

    def admit(self, user: HubUser) -> SeatRow:
        """Return a user's seat, which is made if there is none.

        Raises:
            JoinError: the seat is banned, or the class is closed or full.
        """
        return self._seats.admit(self._identity_of(user.name))

    def is_of(self, number: int, name: str) -> bool:
        """Return True if a seat is that of the user with this name."""
        seat = self._seats.by_identity(self._identity_of(name))
        return seat is not None and seat.number == number

    def _identity_of(self, name: str) -> bytes:
        """Return the keyed hash of a user's name."""
        return hmac.digest(self._key(), name.encode(), "sha256")

    def _key(self) -> bytes:
        return bytes.fromhex(self._store.setting_or("hub_key", lambda: secrets.token_hex(32)))


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
            return TextResponse(text_of(error), 503, headers)
        except NoAccessError as error:
            return TextResponse(text_of(error), 403, NO_STORE)
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
            return problem(text_of(error), 503)
        except NoAccessError as error:
            return problem(text_of(error), 403)

    async def seat(self, request: Request) -> Response:
        """Return the seat of a program that has a token of the hub."""
        found = _TOKEN.fullmatch(request.headers.get("authorization", ""))
        try:
            address = client_address(request.scope)
            user = await self._api.user_of(found[1], address) if found else None
            return await self._seat(user)
        except HubUnreachableError as error:
            return problem(text_of(error), 503)
        except NoAccessError as error:
            return problem(text_of(error), 403)

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
            return problem(text_of(error), 403)
        except StoreError as error:
            return storage_problem(error)
        self._live.tell_people()
        return JSONResponse(self._told(seat), headers=NO_STORE)

    def _told(self, seat: SeatRow) -> dict[str, str]:
        return {
            "name": seat.name,
            "colour": seat.colour,
            "notebooks": f"{self._hub.hub_url}user-redirect/",
            "world": f"{self._hub.hub_url}user-redirect/ai4u-edu/",
        }
