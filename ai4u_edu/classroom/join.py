"""HTTP routes of joining: the page, names to choose from, and the seat's cookie."""

import asyncio
from collections.abc import Callable
from functools import partial
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field
from starlette.requests import HTTPConnection, Request
from starlette.responses import JSONResponse, RedirectResponse, Response

from ai4u_edu.base.errors import text_of
from ai4u_edu.classroom.errors import (
    JoinError,
    NameTakenError,
    NewSeatError,
    StoreError,
    WrongCodeError,
)
from ai4u_edu.classroom.names import MOVE_CODE_LIFE_S
from ai4u_edu.classroom.open_limits import sign_ins
from ai4u_edu.classroom.room_process import path_of
from ai4u_edu.classroom.seats import Seats
from ai4u_edu.classroom.store import SeatRow
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join as joined
from ai4u_edu.locale import translate
from ai4u_edu.member.joining import SEAT_COOKIE
from ai4u_edu.page.server.limits.attempts import CodeLimit, client_address
from ai4u_edu.page.server.limits.concurrency_limit import TooManyOpenError
from ai4u_edu.page.server.limits.json_body import read_json
from ai4u_edu.page.server.limits.rate_limit import RateLimits
from ai4u_edu.page.server.standalone import standalone_page

COOKIE_LIFE_S = 200 * 24 * 3600
MAX_BODY_BYTES = 2000
MAX_NEW_SEATS_AT_ONCE = 60
"""New seats that an address may get at once, such as a school's; then they come one by one."""
NEW_SEATS_PER_S = 1.0
MAX_NEW_SEAT_WAIT_S = 20.0
"""Longest wait for a new seat; a device that would wait longer is asked to try again."""
NO_STORE = {"Cache-Control": "no-store"}
TOO_MANY = _("Too many devices join from your network. Try again in a moment.")


class JoinRequest(BaseModel):
    """Body of a request for a seat."""

    model_config = ConfigDict(extra="forbid")

    code: str = Field(max_length=40)
    name: str = Field(max_length=60)
    request: str = Field(pattern=r"^[A-Za-z0-9-]{16,64}$")
    kind: Literal["page", "play", "notebook"] = "page"
    """Program that joins; the last two bring a world of their own."""


class Join:
    """Routes for whoever has no seat yet.

    Args:
        seats: of the class.
        on_change: called when somebody has joined.
    """

    def __init__(self, seats: Seats, on_change: Callable[[], object] = lambda: None) -> None:
        self._seats, self._limit, self._on_change = seats, CodeLimit(), on_change
        self._waiting = sign_ins()
        self._new_seats = RateLimits(NEW_SEATS_PER_S, MAX_NEW_SEATS_AT_ONCE)

    async def page(self, request: Request) -> Response:
        """Return the page, or send a browser that has a seat to its room."""
        seat = seat_of(self._seats, request)
        if seat is not None:
            return RedirectResponse(f"{path_of(seat.room)}/", 303, NO_STORE)
        return standalone_page("join.html")

    async def names(self, _: Request) -> Response:
        """Return names to choose from."""
        return JSONResponse({"names": self._seats.offered_names()}, headers=NO_STORE)

    async def move_code(self, request: Request) -> Response:
        """Return a code with which another device takes this seat, too.

        Asked with GET, say only whether the last one can still be used.
        """
        seat = seat_of(self._seats, request)
        if seat is None:
            return problem(_("You have no place in this class. Join with the code."), 403)
        if request.method != "POST":
            is_open = self._seats.has_move_code(seat.number)
            return JSONResponse({"is_open": is_open}, headers=NO_STORE)
        code = self._seats.new_move_code(seat.number)
        return JSONResponse({"code": code, "minutes": MOVE_CODE_LIFE_S // 60}, headers=NO_STORE)

    async def join(self, request: Request) -> Response:
        """Give a browser or program a seat, as a cookie, and return the address of its room.

        The room's process starts when its page is opened, so never for a program with a world.
        """
        wanted = await read_json(request, JoinRequest, MAX_BODY_BYTES)
        try:
            async with self._waiting.one_of(client_address(request.scope)):
                return await self._join(request, wanted)
        except TooManyOpenError:
            return problem(TOO_MANY, 429)

    async def _join(self, request: Request, wanted: JoinRequest) -> Response:
        address = client_address(request.scope)
        if not await self._limit.wait_for_turn(address):
            return problem(_("Too many wrong codes come from your network. Try again."), 429)
        given = wanted.code, wanted.name, wanted.request, seat_token(self._seats, request)
        try:
            try:
                join = partial(self._seats.join, *given, may_be_new=False)
                seat, token = await asyncio.to_thread(join)
            except NewSeatError:
                wait_s = self._new_seats.take_within(address, MAX_NEW_SEAT_WAIT_S)
                if wait_s is None:
                    return problem(TOO_MANY, 429)
                await asyncio.sleep(wait_s)
                seat, token = await asyncio.to_thread(self._seats.join, *given)
        except WrongCodeError as error:
            self._limit.add_wrong(address)
            return problem(text_of(error), 403)
        except NameTakenError as error:
            return problem(text_of(error), 409)
        except JoinError as error:
            return problem(text_of(error), 403)
        except StoreError as error:
            return storage_problem(error)
        self._on_change()
        found = {"room": f"{path_of(seat.room)}/", "name": seat.name, "colour": seat.colour}
        answer = JSONResponse(found, headers=NO_STORE)
        answer.set_cookie(
            self._seats.cookie,
            token,
            max_age=COOKIE_LIFE_S,
            secure=request.url.scheme == "https",
            httponly=True,
            samesite="lax",
        )
        return answer


def seat_of(seats: Seats, connection: HTTPConnection) -> SeatRow | None:
    """Return the seat of a browser's cookie; None if it has none."""
    token = seat_token(seats, connection)
    return seats.by_token(token) if token else None


def seat_token(seats: Seats, connection: HTTPConnection) -> str:
    """Return the token in a browser's cookie, or in a program's, which knows no class's name."""
    cookies = connection.cookies
    return cookies.get(seats.cookie) or cookies.get(SEAT_COOKIE, "")


def problem(text: str, status: int) -> Response:
    """Return a refusal with a sentence to show, in the reader's language."""
    return JSONResponse({"problem": translate(text)}, status, NO_STORE)


def storage_problem(error: StoreError) -> Response:
    """Return a refusal to a student, since nothing can be stored now."""
    return problem(joined([text_of(error), _("Tell your teacher.")]), 503)
