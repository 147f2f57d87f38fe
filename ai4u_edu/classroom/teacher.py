"""HTTP routes of the teacher's page: who is here, and commands."""

import asyncio
import io
from collections.abc import Callable
from functools import lru_cache
from typing import Literal
from urllib.parse import quote

import segno
from pydantic import BaseModel, ConfigDict
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.classroom.errors import JoinError
from ai4u_edu.classroom.pages import html_page
from ai4u_edu.classroom.room_host import RoomHost
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.seats import Seats, State
from ai4u_edu.server.json_body import read_json

MAX_BODY_BYTES = 2000
NO_STORE = {"Cache-Control": "no-store"}


class Command(BaseModel):
    """Body of a command: ``seat`` for those that are about one."""

    model_config = ConfigDict(extra="forbid")

    do: Literal["kick", "ban", "rename", "new code", "open", "close"]
    seat: int = 0
    name: str = ""


class Teacher:
    """Routes of the teacher's page; the token is checked before.

    Args:
        seats: of the class.
        rooms: runs the rooms.
        proxy: has the sockets of their pages.
        join_address: returns the address that students open, for the one that the teacher opened.
    """

    def __init__(
        self,
        seats: Seats,
        rooms: RoomHost,
        proxy: RoomProxy,
        join_address: Callable[[str], str],
    ) -> None:
        self._seats, self._rooms, self._proxy = seats, rooms, proxy
        self._join_address = join_address

    async def page(self, _: Request) -> Response:
        """Return the page."""
        return html_page("teacher.html")

    async def state(self, request: Request) -> Response:
        """Return the join address, the code, and all seats."""
        address = self._join_address(str(request.url.replace(path="/", query="")))
        seats = [
            {
                "number": each.number,
                "name": each.name,
                "colour": each.colour,
                "room": each.room,
                "state": each.state,
                "running": self._rooms.is_running(each.room),
            }
            for each in self._seats.all()
        ]
        return JSONResponse(
            {
                "code": self._seats.code,
                "open": self._seats.is_open,
                "address": address,
                "qr": qr_code(f"{address}?code={quote(self._seats.code)}"),
                "seats": seats,
            },
            headers=NO_STORE,
        )

    async def command(self, request: Request) -> Response:
        """Do what the teacher wants; answer with a sentence if it can't be done."""
        wanted = await read_json(request, Command, MAX_BODY_BYTES)
        try:
            await asyncio.to_thread(self._do, wanted)
        except JoinError as error:
            return JSONResponse({"problem": str(error)}, 409, NO_STORE)
        if wanted.do in ("kick", "ban"):
            self._proxy.end(wanted.seat, "your teacher has sent you out; reload to join again")
        return JSONResponse({}, headers=NO_STORE)

    def _do(self, wanted: Command) -> None:
        match wanted.do:
            case "kick":
                self._seats.set_state(wanted.seat, State.KICKED)
            case "ban":
                self._seats.set_state(wanted.seat, State.BANNED)
            case "rename":
                self._seats.rename(wanted.seat, wanted.name)
            case "new code":
                self._seats.change_code()
            case "open" | "close":
                self._seats.set_open(wanted.do == "open")


@lru_cache(maxsize=8)  # the page asks every second
def qr_code(text: str) -> str:
    """Return a QR code as an SVG data URL."""
    out = io.BytesIO()
    segno.make(text, micro=False).save(out, kind="svg", scale=8, border=2, light="#fff")
    return "data:image/svg+xml," + quote(out.getvalue())
