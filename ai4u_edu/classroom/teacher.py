"""HTTP routes of the teacher's page: the class as it is, and commands."""

import asyncio
import io
from functools import lru_cache
from typing import Literal
from urllib.parse import quote

import segno
from pydantic import BaseModel, ConfigDict
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.classroom.class_event import ClassEvents
from ai4u_edu.classroom.errors import JoinError, StoreError
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.pages import html_page
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.seats import State
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
        live: the class.
        events: of the class.
        proxy: has the sockets of the rooms' pages.
    """

    def __init__(self, live: LiveClass, events: ClassEvents, proxy: RoomProxy) -> None:
        self._live, self._events, self._proxy = live, events, proxy
        self._seats = live.seats

    async def page(self, _: Request) -> Response:
        """Return the page."""
        return html_page("teacher.html")

    async def state(self, request: Request) -> Response:
        """Return the class, as the page's socket tells it."""
        url = str(request.url.replace(path="/", query=""))
        text = self._events.text(url, is_projected=False)
        return Response(text, media_type="application/json", headers=NO_STORE)

    async def command(self, request: Request) -> Response:
        """Do what the teacher wants; answer with a sentence if it can't be done."""
        wanted = await read_json(request, Command, MAX_BODY_BYTES)
        try:
            await asyncio.to_thread(self._do, wanted)
        except (JoinError, StoreError) as error:
            return JSONResponse({"problem": str(error)}, 400, NO_STORE)
        if wanted.do in ("kick", "ban"):
            self._proxy.end(wanted.seat, "your teacher has sent you out; reload to join again")
            self._live.end_links(wanted.seat, "Your teacher has sent you out. Join again.")
        self._live.tell_people()
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


def join_code(address: str, code: str) -> str:
    """Return the QR code of the join address, which has the class's code in it."""
    return _qr_code(f"{address}?code={quote(code)}")


@lru_cache(maxsize=8)
def _qr_code(text: str) -> str:
    """Return a QR code as an SVG data URL."""
    out = io.BytesIO()
    segno.make(text, micro=False).save(out, kind="svg", scale=8, border=2, light="#fff")
    return "data:image/svg+xml," + quote(out.getvalue())
