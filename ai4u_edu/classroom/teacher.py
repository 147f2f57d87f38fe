"""HTTP routes of the teacher's page: the class as it is, and commands."""

import asyncio
import io
import secrets
from dataclasses import replace
from functools import lru_cache
from urllib.parse import quote

import segno
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.classroom.class_event import ClassEvents
from ai4u_edu.classroom.commands import (
    AnyCommand,
    Assign,
    Attend,
    BeginTournament,
    Command,
    HideBoard,
    MoveCode,
    PlainCommand,
    SeatCommand,
    Show,
    Sleep,
    StartRace,
    StartTournament,
)
from ai4u_edu.classroom.errors import CommandError, JoinError, StoreError
from ai4u_edu.classroom.forget import forget
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.move_codes import LIFE_S
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.scene_source import find_scene
from ai4u_edu.classroom.seats import State
from ai4u_edu.classroom.work_zip import class_zip, zip_response
from ai4u_edu.page.server.limits.json_body import read_json
from ai4u_edu.page.server.standalone import standalone_page
from ai4u_edu.wire.class_link import MAX_SCENE_CHARS, MAX_STARTING_PROGRAM_CHARS

MAX_BODY_BYTES = 4 * MAX_SCENE_CHARS + 6 * MAX_STARTING_PROGRAM_CHARS + 4000
UNPROCESSABLE = 422
NO_STORE = {"Cache-Control": "no-store"}


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
        return standalone_page("teacher.html")

    async def state(self, request: Request) -> Response:
        """Return the class, as the page's socket tells it."""
        self._live.ensure_ticking()
        url = str(request.url.replace(path="/", query=""))
        text = self._events.text(url, is_projected=False)
        return Response(text, media_type="application/json", headers=NO_STORE)

    async def export(self, _: Request) -> Response:
        """Return a ZIP file with the work of the class."""
        return zip_response(await asyncio.to_thread(class_zip, self._live), "class.zip")

    async def command(self, request: Request) -> Response:
        """Do what the teacher wants; answer with a sentence if it can't be done."""
        try:
            wanted = await read_json(request, Command, MAX_BODY_BYTES)
            if isinstance(wanted.root, MoveCode):
                code = self._seats.new_move_code(wanted.root.seat, is_teachers=True)
                return JSONResponse({"code": code, "minutes": LIFE_S // 60}, headers=NO_STORE)
            await self._do(wanted.root)
        except HTTPException as error:
            status = 400 if error.status_code == UNPROCESSABLE else error.status_code
            return JSONResponse({"problem": error.detail}, status, NO_STORE)
        except (JoinError, CommandError, StoreError) as error:
            return JSONResponse({"problem": str(error)}, 400, NO_STORE)
        self._live.tell_people()
        return JSONResponse({}, headers=NO_STORE)

    async def _do(self, wanted: AnyCommand) -> None:
        live = self._live
        match wanted:
            case SeatCommand():
                await self._do_seat(wanted)
            case PlainCommand():
                await self._do_plain(wanted)
            case Assign():
                await self._assign(wanted)
            case Attend(kind=kind, message=message, seconds=seconds):
                await asyncio.to_thread(live.attention.set, kind, message.strip(), seconds)
                live.tell_attention()
            case StartRace():
                scene = await asyncio.to_thread(find_scene, live, wanted.scene)
                race = live.races.start(scene, wanted.seed, wanted.countdown, wanted.hide_board)
                live.assignments.assign_race(scene, race.id)
                live.race.tell()
            case BeginTournament(scene=name):
                await live.tournament.begin(name)
            case StartTournament():
                seats = [each for each in self._seats.all() if each.state == State.IN.value]
                await live.tournament.start(
                    seats, wanted.seeds, wanted.system, has_own_player=wanted.own_player
                )
            case HideBoard(hide=hide):
                live.races.change(hide=hide)
                live.race.tell()
            case Show(kind=kind, room=room, game=game):
                if kind == "room":
                    self._check_room(room)
                live.show(kind, room if kind == "room" else "", game if kind == "game" else 0)
            case Sleep(room=room):
                self._check_room(room)
                await live.host.end(room)

    async def _do_seat(self, wanted: SeatCommand) -> None:
        match wanted.do:
            case "rename":
                await asyncio.to_thread(self._seats.rename, wanted.seat, wanted.name)
                return
            case "kick":
                await asyncio.to_thread(self._seats.set_state, wanted.seat, State.KICKED)
            case "ban":
                await asyncio.to_thread(self._seats.set_state, wanted.seat, State.BANNED)
                if wanted.new_code:
                    await asyncio.to_thread(self._seats.change_code)
        self._proxy.end(wanted.seat, "your teacher has sent you out; ask before you join again")
        self._live.end_links(wanted.seat, "Your teacher has sent you out. Join again.")

    async def _do_plain(self, wanted: PlainCommand) -> None:
        races = self._live.races
        match wanted.do:
            case "new code":
                await asyncio.to_thread(self._seats.change_code)
            case "open" | "close":
                await asyncio.to_thread(self._seats.set_open, wanted.do == "open")
            case "cancel tournament":
                await self._live.tournament.cancel()
            case "close tournament":
                await self._live.tournament.dismiss()
            case "forget":
                await forget(self._live, self._proxy)
            case "end race":
                if races.now is not None and races.now.phase != "over":
                    races.change(phase="over")
                else:
                    races.dismiss()
                self._live.race.tell()

    async def _assign(self, wanted: Assign) -> None:
        live = self._live
        scene = await asyncio.to_thread(find_scene, live, wanted.scene)
        scene = replace(scene, program=wanted.program)
        seed = wanted.seed
        if seed is None and wanted.same_seed:
            seed = secrets.randbelow(MAX_SEED + 1)
        rooms = None if wanted.rooms == "all" else wanted.rooms
        for each in rooms or ():
            self._check_room(each)
        await asyncio.to_thread(live.assignments.assign, scene, rooms, seed)
        live.tell_assignments()

    def _check_room(self, room: str) -> None:
        if room not in self._live.rooms and room not in self._seats.scenes():
            raise CommandError(f"room: there is no room {room[:40]!r}")


def join_code(address: str, code: str) -> str:
    """Return the QR code of the join address, which has the class's code in it."""
    return qr_code(f"{address}?code={quote(code)}")


@lru_cache(maxsize=8)
def qr_code(text: str) -> str:
    """Return a QR code as an SVG data URL."""
    out = io.BytesIO()
    segno.make(text, micro=False).save(out, kind="svg", scale=8, border=2, light="#fff")
    return "data:image/svg+xml," + quote(out.getvalue())
