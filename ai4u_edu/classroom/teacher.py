"""HTTP routes of the teacher's page: the class as it is, and commands."""

import asyncio
import io
import secrets
from dataclasses import replace
from functools import lru_cache
from typing import Annotated, Any, Literal
from urllib.parse import quote

import segno
from pydantic import BaseModel, ConfigDict, Field, RootModel
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.base.atomic_write import reason
from ai4u_edu.base.errors import SceneError, SetupError, shorten, text_of
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.classroom.assignments import AssignedScene
from ai4u_edu.classroom.attention import MAX_SECONDS
from ai4u_edu.classroom.class_event import ClassEvents
from ai4u_edu.classroom.course_index import course_lessons
from ai4u_edu.classroom.errors import CommandError, JoinError, StoreError
from ai4u_edu.classroom.join import NO_STORE, problem
from ai4u_edu.classroom.live_class import LiveClass, ShownKind
from ai4u_edu.classroom.missions import MAX_NAME_CHARS
from ai4u_edu.classroom.names import MOVE_CODE_LIFE_S
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.room_queue import STOPPED_BY_TEACHER
from ai4u_edu.classroom.scene_file import NAME as SCENE_FILE
from ai4u_edu.classroom.seats import SeatState
from ai4u_edu.classroom.tournament.runner import System
from ai4u_edu.classroom.work_zip import class_zip, zip_response
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.permissions import Permissions
from ai4u_edu.page.server.limits.json_body import read_json
from ai4u_edu.page.server.standalone import standalone_page
from ai4u_edu.scenes import Scene
from ai4u_edu.teach.networks import FOLDER as TAUGHT
from ai4u_edu.teach.networks import HANDED_OUT, KeptNetwork, NetworkFolder
from ai4u_edu.wire.class_link import (
    MAX_MESSAGE_CHARS,
    MAX_SENT_SCENE_CHARS,
    MAX_STARTING_PROGRAM_CHARS,
)

MAX_BODY_BYTES = 4 * MAX_SENT_SCENE_CHARS + 6 * MAX_STARTING_PROGRAM_CHARS + 4000
MAX_COUNTDOWN_S = 60.0
HANDED_OUT_TITLE = _("From your teacher")
_RoomId = Annotated[str, Field(max_length=40)]
_Seed = Annotated[int, Field(ge=0, le=MAX_SEED)]
_Seconds = Annotated[float, Field(ge=0, le=MAX_SECONDS, allow_inf_nan=False)]


class SceneOfRoom(BaseModel):
    """The present scene of a room."""

    model_config = ConfigDict(extra="forbid")

    room: str = Field(max_length=40)


class SceneText(BaseModel):
    """A scene's YAML."""

    model_config = ConfigDict(extra="forbid")

    yaml: str = Field(max_length=MAX_SENT_SCENE_CHARS)


class SceneOfLesson(BaseModel):
    """The scene that a lesson begins with."""

    model_config = ConfigDict(extra="forbid")

    lesson: str = Field(max_length=2)


class SceneOfMission(BaseModel):
    """A mission, which pages open, and its scene."""

    model_config = ConfigDict(extra="forbid")

    mission: str = Field(max_length=MAX_NAME_CHARS)


_SceneSource = str | SceneOfRoom | SceneText
_LessonOrScene = SceneOfLesson | SceneOfMission | _SceneSource


class _Command(BaseModel):
    model_config = ConfigDict(extra="forbid")


class _SeatCommand(_Command):
    """Send a seat out, ban it, give it another name, or delete everything of it."""

    do: Literal["kick", "ban", "rename", "forget seat"]
    seat: int
    name: str = Field(default="", max_length=60)
    new_code: bool = False
    """True with a ban to set a new code too, since who knows the old one may join again."""


class _GiveMoveCode(_Command):
    """Return a code with which a student takes a seat again, whatever its state is."""

    do: Literal["move code"]
    seat: int


class _PlainCommand(_Command):
    """A command without arguments."""

    do: Literal[
        "new code",
        "open",
        "close",
        "end race",
        "cancel tournament",
        "close tournament",
        "forget",
    ]


class _Assign(_Command):
    """Give rooms a scene, a lesson or a mission."""

    do: Literal["assign"]
    rooms: list[_RoomId] | Literal["all"]
    scene: _LessonOrScene
    seed: _Seed | None = None
    """Seed of all these worlds."""
    same_seed: bool = False
    """True without a seed: a random one, the same for all."""
    program: str = Field(default="", max_length=MAX_STARTING_PROGRAM_CHARS)
    """Python that students may begin with."""


class _Attend(_Command):
    """Ask for attention; without kind and message, end it."""

    do: Literal["attention"]
    kind: Literal["", "pause", "blank"]
    message: str = Field(default="", max_length=MAX_MESSAGE_CHARS)
    seconds: _Seconds = 0.0


class _Switch(_Command):
    """Turn something on or off in the whole class."""

    do: Literal["switch"]
    name: str = Field(max_length=40)
    """A field of :class:`~ai4u_edu.wire.class_link.Switches`."""
    on: bool


class _StartRace(_Command):
    """Start a race."""

    do: Literal["race"]
    scene: _SceneSource
    seed: _Seed | None = None
    countdown: float = Field(default=5.0, ge=0, le=MAX_COUNTDOWN_S, allow_inf_nan=False)
    hide_board: bool = False


class _BeginTournament(_Command):
    """Begin a tournament: students hand in networks for its scene."""

    do: Literal["tournament"]
    scene: str = Field(max_length=60)
    """Name in the library."""


class _StartTournament(_Command):
    """Play the present tournament."""

    do: Literal["start tournament"]
    seeds: int = Field(default=1, ge=1, le=20)
    """Seeds of each pair's duels, or of races."""
    system: System = "round-robin"
    own_player: bool = False
    """True if the scene's own player takes part."""


class _HideBoard(_Command):
    """Hide the board of the race from students, or show it."""

    do: Literal["board"]
    hide: bool


class _Show(_Command):
    """Choose what the projector page shows."""

    do: Literal["show"]
    kind: ShownKind
    room: _RoomId = ""
    game: int = Field(default=0, ge=0, le=10**6)
    """Number of a game of the tournament, for its recording."""


class _Sleep(_Command):
    """End the process of a room; it starts again when its page is opened."""

    do: Literal["sleep"]
    room: _RoomId


class _StopTraining(_Command):
    """End what learns or waits to learn in a room."""

    do: Literal["stop training"]
    room: _RoomId


class _HandOut(_Command):
    """Give all other rooms a copy of a network that learned in a room."""

    do: Literal["hand out"]
    room: _RoomId
    scene: str = Field(max_length=400)
    """Name of the network's scene."""
    network: int = Field(ge=0, le=10**9)
    """Its number among those of the scene."""


_AnyCommand = (
    _SeatCommand
    | _GiveMoveCode
    | _PlainCommand
    | _Assign
    | _Attend
    | _Switch
    | _StartRace
    | _BeginTournament
    | _StartTournament
    | _HideBoard
    | _Show
    | _Sleep
    | _StopTraining
    | _HandOut
)


class _TeacherRequest(RootModel[Annotated[_AnyCommand, Field(discriminator="do")]]):
    """Body of a command."""


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
        """Return the class, as the page's socket sends it."""
        self._live.ensure_ticking()
        url = str(request.url.replace(path="/", query=""))
        text = self._events.text(url, is_projected=False)
        return Response(text, media_type="application/json", headers=NO_STORE)

    async def export(self, _: Request) -> Response:
        """Return a ZIP file with the work of the class."""
        return zip_response(await asyncio.to_thread(class_zip, self._live), "class.zip")

    async def networks(self, request: Request) -> Response:
        """Return the networks that learned in a room."""
        room = request.query_params.get("room", "")
        if room not in self._seats.scenes():
            return problem(_("room: there is no such room on this machine"), 404)
        networks = await asyncio.to_thread(_networks_of, self._live, room)
        return JSONResponse({"networks": networks}, headers=NO_STORE)

    async def command(self, request: Request) -> Response:
        """Do what the teacher wants; answer with a sentence if it can't be done."""
        try:
            wanted = await read_json(request, _TeacherRequest, MAX_BODY_BYTES)
            if isinstance(wanted.root, _GiveMoveCode):
                code = self._seats.new_move_code(wanted.root.seat, is_teachers=True)
                return JSONResponse(
                    {"code": code, "minutes": MOVE_CODE_LIFE_S // 60}, headers=NO_STORE
                )
            await self._do(wanted.root)
        except HTTPException as error:
            status = 400 if error.status_code == 422 else error.status_code
            return problem(error.detail, status)
        except (JoinError, CommandError, StoreError) as error:
            return problem(text_of(error), 400)
        self._live.tell_people()
        return JSONResponse({}, headers=NO_STORE)

    async def _do(self, wanted: _AnyCommand) -> None:
        live = self._live
        match wanted:
            case _SeatCommand():
                await self._do_seat(wanted)
            case _PlainCommand():
                await self._do_plain(wanted)
            case _Assign():
                await self._assign(wanted)
            case _Attend(kind=kind, message=message, seconds=seconds):
                await asyncio.to_thread(live.attention.set, kind, message.strip(), seconds)
                live.tell_attention()
            case _Switch(name=name, on=on):
                live.switch(name, on=on)
            case _StartRace():
                scene = await asyncio.to_thread(_find_scene, live, wanted.scene)
                race = live.races.start(scene, wanted.seed, wanted.countdown, wanted.hide_board)
                live.assignments.assign_race(scene, race.id)
                live.race.tell()
            case _BeginTournament(scene=name):
                await live.tournament.begin(name)
            case _StartTournament():
                seats = [each for each in self._seats.all() if each.state == SeatState.IN.value]
                await live.tournament.start(
                    seats, wanted.seeds, wanted.system, has_own_player=wanted.own_player
                )
            case _HideBoard(hide=hide):
                live.races.change(hide=hide)
                live.race.tell()
            case _Show(kind=kind, room=room, game=game):
                if kind == "room":
                    self._check_room(room)
                live.show(kind, room if kind == "room" else "", game if kind == "game" else 0)
            case _Sleep(room=room):
                self._check_room(room)
                await live.host.end(room)
            case _StopTraining(room=room):
                self._check_room(room)
                queues = live.trainings, live.practices, live.tasks
                stopped = [await queue.stop(room, problem=STOPPED_BY_TEACHER) for queue in queues]
                if not any(stopped):
                    raise CommandError(_("nothing learns in this room any more"))
            case _HandOut(room=room, scene=name, network=number):
                self._check_local(room)
                others = [other for other in self._seats.scenes() if other != room]
                await asyncio.to_thread(_hand_out, live, room, name, number, others)
                for other in others:
                    live.tell_trainings(other)

    async def _do_seat(self, wanted: _SeatCommand) -> None:
        match wanted.do:
            case "rename":
                await asyncio.to_thread(self._seats.rename, wanted.seat, wanted.name)
                return
            case "forget seat":
                await self._live.delete_seat(wanted.seat, self._proxy.end)
                return
            case "kick":
                await asyncio.to_thread(self._seats.set_state, wanted.seat, SeatState.KICKED)
            case "ban":
                await asyncio.to_thread(self._seats.set_state, wanted.seat, SeatState.BANNED)
                if wanted.new_code:
                    await asyncio.to_thread(self._seats.change_code)
        self._proxy.end(wanted.seat, _("your teacher has sent you out; ask before you join again"))
        self._live.end_links(wanted.seat, _("Your teacher has sent you out. Join again."))
        (seat,) = (seat for seat in self._seats.all() if seat.number == wanted.seat)
        if not self._live.seats_of_id(seat.room):  # nobody is left to see the results
            await self._live.tasks.stop(seat.room)

    async def _do_plain(self, wanted: _PlainCommand) -> None:
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
                await self._live.delete_all(self._proxy.end)
            case "end race":
                if races.now is not None and races.now.phase != "over":
                    races.change(phase="over")
                else:
                    races.dismiss()
                self._live.race.tell()

    async def _assign(self, wanted: _Assign) -> None:
        live = self._live
        scene = await asyncio.to_thread(_find_scene, live, wanted.scene)
        scene = replace(scene, program=wanted.program)
        seed = wanted.seed
        if seed is None and wanted.same_seed:
            seed = secrets.randbelow(MAX_SEED + 1)
        rooms = None if wanted.rooms == "all" else wanted.rooms
        for each in rooms or ():
            self._check_room(each)
        await asyncio.to_thread(live.assignments.assign, scene, rooms, seed)
        live.tell_assignments()

    def _check_local(self, room: str) -> None:
        if room not in self._seats.scenes():
            text = _("room: there is no room {room!r} on this machine", room=room[:40])
            raise CommandError(text)

    def _check_room(self, room: str) -> None:
        if room not in self._live.rooms and room not in self._seats.scenes():
            raise CommandError(_("room: there is no room {room!r}", room=room[:40]))


def _find_scene(live: LiveClass, source: _LessonOrScene) -> AssignedScene:
    """Return a scene that rooms can open; a thread may do it.

    That of a lesson is empty if the lesson shows no scene of the library.

    Raises:
        CommandError: there is none, or something in it is wrong.
    """
    if isinstance(source, SceneOfLesson):
        return _scene_of_lesson(source.lesson)
    if isinstance(source, SceneOfMission):
        mission = live.missions.known.get(source.mission)
        if mission is None:
            name = source.mission[:40]
            raise CommandError(_("mission: there is no mission {name!r}", name=name))
        return AssignedScene(mission.title, mission.scene, mission=source.mission)
    if isinstance(source, str):
        if source not in Scene.names():
            raise CommandError(
                _("scene: expected a scene of the library, got {scene!r}", scene=source[:40])
            )
        return AssignedScene(Scene.load(source).description.title or source, source)
    text = source.yaml if isinstance(source, SceneText) else _text_of_room(live, source.room)
    try:
        scene = Scene.loads(text)
        Permissions(()).check(scene.description.agents)
    except (SceneError, ChangeError) as error:
        why = shorten(text_of(error), 400)
        raise CommandError(_("scene: {problem}", problem=why)) from None
    title = scene.description.title or scene.description.name
    # a text without a line break would be taken for a name
    return AssignedScene(title, text if "\n" in text else f"{text}\n")


def _scene_of_lesson(number: str) -> AssignedScene:
    for each in course_lessons():
        if each.number == number:
            return AssignedScene(each.title, each.scene, f"{number} {each.title}")
    last = course_lessons()[-1].number
    raise CommandError(
        _("lesson: expected a number from 00 to {last}, got {number!r}", last=last, number=number)
    )


def _text_of_room(live: LiveClass, room: str) -> str:
    """Return the YAML of a room's present scene.

    Raises:
        CommandError: there is no such room, or nothing is known of its scene.
    """
    if room not in live.rooms and room not in live.seats.scenes():
        raise CommandError(_("room: there is no room {room!r}", room=room[:40]))
    state = live.rooms.get(room)
    if state is not None and state.work is not None:
        return state.work.scene
    try:
        return (live.store.room_folder(room) / SCENE_FILE).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        text = _("room: its scene is not known yet; it was not changed")
        raise CommandError(text) from None


def _taught(live: LiveClass, room: str, folder: str) -> NetworkFolder:
    return NetworkFolder(live.store.room_folder(room) / folder)


def _networks_of(live: LiveClass, room: str) -> list[dict[str, Any]]:
    """Return the networks that learned in a room, the latest first; a thread does it."""
    networks = _taught(live, room, TAUGHT).all()
    return [
        {"scene": scene, "number": about.number, "title": about.title, "how": about.how}
        for scene, about in sorted(networks, key=lambda pair: pair[1].made_at, reverse=True)
    ]


def _hand_out(live: LiveClass, room: str, scene: str, number: int, others: list[str]) -> None:
    """Give other rooms a copy of a network, which names neither its seat nor its title.

    Each takes it as soon as it runs.

    Raises:
        CommandError: it can't be read, or a copy can't be written.
    """
    own = _taught(live, room, TAUGHT)
    try:
        network = own.file(scene, number).read_bytes()
        (agent,) = [
            about.agent for name, about in own.all() if (name, about.number) == (scene, number)
        ]
        about = KeptNetwork(0, HANDED_OUT_TITLE, agent, _("handed out by your teacher"))
        for other in others:
            _taught(live, other, HANDED_OUT).add(scene, network, about)
    except (SetupError, ValueError):
        text = _("network: it is not there any more; choose another one")
        raise CommandError(text) from None
    except OSError as error:
        text = _("network: it can't be handed out: {reason}", reason=reason(error))
        raise CommandError(text) from None


def join_code(address: str, code: str) -> str:
    """Return the QR code of the join address, which has the class's code in it."""
    return qr_code(f"{address}?code={quote(code)}")


@lru_cache(maxsize=8)
def qr_code(text: str) -> str:
    """Return a QR code as an SVG data URL."""
    out = io.BytesIO()
    segno.make(text, micro=False).save(out, kind="svg", scale=8, border=2, light="#fff")
    return "data:image/svg+xml," + quote(out.getvalue())
