"""HTTP routes with which a seat's pages keep and fetch its work: programs, missions, networks.

What a page tells of runs, stars and missions nobody proves, as with a notebook's results.
"""

import asyncio
from collections.abc import Awaitable, Callable
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, StringConstraints
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from ai4u_edu.base.errors import text_of
from ai4u_edu.classroom.errors import (
    NetworkError,
    NewerProgramError,
    ProgramNotKeptError,
    StoreError,
)
from ai4u_edu.classroom.join import NO_STORE, problem, seat_of, storage_problem
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.missions import (
    MAX_COUNT,
    MAX_HINT_CHARS,
    MAX_MISSIONS,
    MAX_NAME_CHARS,
    MissionPlace,
    Reached,
)
from ai4u_edu.classroom.programs import (
    MAX_AGENT_NAME_CHARS,
    MAX_DEVICE_CHARS,
    MAX_PROGRAM_CHARS,
    MAX_SCENE_NAME_CHARS,
    MistakeKind,
    ProgramRow,
    ProgramRun,
    RunState,
)
from ai4u_edu.classroom.tournament.event import network_facts
from ai4u_edu.classroom.tournament.network_scene import network_scenes
from ai4u_edu.classroom.tournament.networks import TOO_LARGE, check_network
from ai4u_edu.classroom.work_zip import seat_zip, zip_response
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text, translate
from ai4u_edu.page.messages import to_json
from ai4u_edu.page.server.limits.json_body import read_json
from ai4u_edu.page.server.limits.rate_limit import RateLimits
from ai4u_edu.page.server.reader_language import TextResponse
from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES

REQUESTS_PER_S = 1.0
"""Rate of a seat's requests for each kind of work, of which some may come at once."""
MAX_REQUESTS_AT_ONCE = 30
TOO_MANY = _("Too many requests at once. Try again in some seconds.")
TOO_MANY_PROGRAMS = _("Too many programs at once. Try again in some seconds.")
TOO_MANY_RUNS = _("Too many runs at once. Try again in some seconds.")
_MAX_PROGRAM_BYTES = 6 * MAX_PROGRAM_CHARS + 4000  # JSON takes at most six bytes for a character
_MAX_MISSIONS_BYTES = MAX_MISSIONS * (6 * MAX_NAME_CHARS + 60) + 6 * MAX_HINT_CHARS
_MAX_GLANCE_CHARS = 3000  # of each program in the view of all
_NETWORK_TYPE = "application/octet-stream"  # a browser asks another site before it sends this


class _Request(BaseModel):
    model_config = ConfigDict(extra="forbid")


class _SavedProgram(_Request):
    """A program to keep."""

    scene: str = Field(min_length=1, max_length=MAX_SCENE_NAME_CHARS)
    agent: str = Field(min_length=1, max_length=MAX_AGENT_NAME_CHARS)
    source: str = Field(max_length=MAX_PROGRAM_CHARS)
    base: int = Field(ge=0, le=2**53, strict=True)
    """Latest version that the device has seen; 0 for none."""
    device: str = Field(min_length=1, max_length=MAX_DEVICE_CHARS)
    """Random id of the browser."""


class _ReportedRun(_Request):
    """The way in which a program runs, or the mistake that stopped it."""

    state: RunState
    kind: MistakeKind | Literal[""] = ""
    text: str = Field(default="", max_length=700)
    line: int = Field(default=0, ge=0, le=MAX_PROGRAM_CHARS, strict=True)


class _EarnedStars(_Request):
    """Stars to keep, in a scene of the library."""

    model_config = ConfigDict(strict=True)

    scene: str = Field(min_length=1, max_length=MAX_SCENE_NAME_CHARS)
    stars: int = Field(ge=1, le=3)


class _Reached(_Request):
    """Progress in one mission."""

    model_config = ConfigDict(strict=True)

    steps: int = Field(default=0, ge=0, le=MAX_COUNT)
    stars: int = Field(default=0, ge=0, le=MAX_COUNT)


class _ShownStep(_Request):
    """The step that a page shows."""

    model_config = ConfigDict(strict=True)

    mission: str = Field(max_length=MAX_NAME_CHARS)
    """Empty if no mission is open."""
    step: int = Field(default=0, ge=0, le=MAX_COUNT)
    is_done: bool = False
    hint: str = Field(default="", max_length=MAX_HINT_CHARS)
    hints: int = Field(default=0, ge=0, le=MAX_COUNT)


_MissionName = Annotated[str, StringConstraints(min_length=1, max_length=MAX_NAME_CHARS)]


class _ReportedMissions(_Request):
    """Progress in missions to keep, and where the page is."""

    missions: dict[_MissionName, _Reached] = Field(default={}, max_length=MAX_MISSIONS)
    place: _ShownStep | None = None
    """None if it is as before."""


class WorkRoutes:
    """Routes of work. Belongs to the event loop.

    Args:
        live: the class.
    """

    def __init__(self, live: LiveClass) -> None:
        self._live, self._programs = live, live.programs
        self._networks = live.tournament.networks
        self._sending: set[int] = set()
        """Seats whose network is being received."""

    def routes(self) -> list[Route]:
        """Return the routes of a seat, whose cookie they ask for."""
        return [
            self._route("/api/program", self._program, TOO_MANY_PROGRAMS),
            self._route("/api/stars", self._stars),
            self._route("/api/mission-progress", self._missions),
            self._route("/api/network", self._network),
            self._route("/api/program/run", self._run, TOO_MANY_RUNS, has_get=False),
            Route("/api/my-work", self._my_work),
        ]

    async def programs(self, request: Request) -> Response:
        """Return the latest program of each seat of a room; the teacher's token is checked before.

        Without a room, the beginnings of those of all seats that are in the class. Earlier scenes'
        programs are in the export.
        """
        room = request.query_params.get("room", "")
        if room and room not in self._live.rooms and room not in self._live.seats.scenes():
            return problem(_("room: there is no such room"), 404)
        try:
            programs = await (self._of_room(room) if room else self._of_all())
        except StoreError as error:
            return problem(text_of(error), 503)
        return JSONResponse({"programs": programs}, headers=NO_STORE)

    def _route(
        self,
        path: str,
        serve: Callable[[int, Request], Awaitable[Response]],
        too_many: str = TOO_MANY,
        *,
        has_get: bool = True,
    ) -> Route:
        """Return a route that serves seats, within their rate, and answers errors in words.

        Args:
            path: of the route.
            serve: answers a request of a seat with this number.
            too_many: sentence for a seat that sends more than its rate.
            has_get: True if the work can be fetched; then it is kept as long as the class's folder
                is not full.
        """
        rate = RateLimits(REQUESTS_PER_S, MAX_REQUESTS_AT_ONCE)

        async def answer(request: Request) -> Response:
            if has_get and request.method == "PUT" and self._live.store.quota.is_full:
                text = _("The class's folder is full, and keeps nothing more. Tell your teacher.")
                return problem(text, 507)
            seat = seat_of(self._live.seats, request)
            if seat is None:
                return problem(_("This browser has no place in the class."), 403)
            if rate.take_within(seat.number) is None:
                return problem(too_many, 429)
            try:
                return await serve(seat.number, request)
            except HTTPException as error:
                return problem(error.detail, error.status_code)
            except NewerProgramError as error:
                return problem(text_of(error), 409)
            except (ProgramNotKeptError, NetworkError) as error:
                return problem(text_of(error), 400)
            except StoreError as error:
                return storage_problem(error)

        return Route(path, answer, methods=["GET", "PUT"] if has_get else ["PUT"])

    async def _my_work(self, request: Request) -> Response:
        """Return a ZIP file of a seat's work."""
        seat = seat_of(self._live.seats, request)
        if seat is None:
            return TextResponse(_("this browser has no place in the class"), 403, NO_STORE)
        return zip_response(await asyncio.to_thread(seat_zip, self._live, seat), "my-work.zip")

    # -- programs ----------------------------------------------------------------------------------

    async def _program(self, seat: int, request: Request) -> Response:
        """Keep a seat's program (PUT), or return it (GET); without an agent, a scene's agents."""
        if request.method == "PUT":
            sent = await read_json(request, _SavedProgram, _MAX_PROGRAM_BYTES)
            version = await asyncio.to_thread(
                self._programs.save,
                seat,
                sent.scene,
                sent.agent,
                sent.source,
                base=sent.base,
                device=sent.device,
            )
            return JSONResponse({"version": version}, headers=NO_STORE)
        names = ("scene", "agent", "device")
        scene, agent, device = (request.query_params.get(name, "") for name in names)
        if not agent:
            agents = await asyncio.to_thread(self._programs.agents_of, seat, scene)
            return JSONResponse({"agents": agents}, headers=NO_STORE)
        program = await asyncio.to_thread(self._programs.find, seat, scene, agent)
        facts = self._program_facts(program)
        if program is not None:
            facts |= {"version": program.version, "is_of_device": program.device == device}
        return JSONResponse(facts, headers=NO_STORE)

    async def _run(self, seat: int, request: Request) -> Response:
        """Note how the program of a seat runs, or which mistake stopped it."""
        sent = await read_json(request, _ReportedRun, 6000)
        kind = (sent.kind or "error") if sent.state == "mistake" else ""
        run, runs = ProgramRun(sent.state, kind, sent.text, sent.line), self._live.program_runs
        await asyncio.to_thread(runs.save, seat, run)
        runs.note(seat, run)
        self._live.note_change()
        return JSONResponse({}, headers=NO_STORE)

    async def _of_all(self) -> list[dict[str, Any]]:
        latest = await asyncio.to_thread(self._programs.latest_of_all)
        names = {seat.number: seat.name for seat in self._live.seats.all() if seat.state == "in"}
        return [
            {"seat": program.seat, "name": names[program.seat]}
            | self._program_facts(program, _MAX_GLANCE_CHARS)
            for program in latest
            if program.seat in names
        ]

    async def _of_room(self, room: str) -> list[dict[str, Any]]:
        return [
            {"seat": seat.number, "name": seat.name}
            | self._program_facts(await asyncio.to_thread(self._programs.latest_of, seat.number))
            for seat in self._live.seats_of_id(room)
        ]

    def _program_facts(
        self, program: ProgramRow | None, max_chars: int = MAX_PROGRAM_CHARS
    ) -> dict[str, Any]:
        if program is None:
            return {"source": None}
        return {
            "scene": program.scene,
            "agent": program.agent,
            "source": program.source[:max_chars],
            "age": round(self._programs.age_of(program), 3),
        }

    # -- stars -------------------------------------------------------------------------------------

    async def _stars(self, seat: int, request: Request) -> Response:
        """Keep stars of a seat (PUT); return all that it has, by scene."""
        stars = self._live.stars
        if request.method == "PUT":
            earned = await read_json(request, _EarnedStars, 2000)
            try:
                await asyncio.to_thread(stars.save, seat, earned.scene, earned.stars)
            except ValueError as error:
                raise HTTPException(422, translate(text_of(error))) from None
            stars.note(seat, earned.scene, earned.stars)
            self._live.note_change()
        return JSONResponse({"stars": stars.of_seat(seat)}, headers=NO_STORE)

    # -- missions ----------------------------------------------------------------------------------

    async def _missions(self, seat: int, request: Request) -> Response:
        """Keep what a seat has reached, and where it is (PUT); return all that it has reached."""
        missions = self._live.missions
        if request.method == "PUT":
            sent = await read_json(request, _ReportedMissions, _MAX_MISSIONS_BYTES)
            reached = {
                name: Reached(each.steps, each.stars) for name, each in sent.missions.items()
            }
            place = None if sent.place is None else MissionPlace(**sent.place.model_dump())
            if missions.note(seat, *await asyncio.to_thread(missions.save, seat, reached, place)):
                self._live.note_change()
        own = {
            name: {"steps": each.steps, "stars": each.stars}
            for name, each in missions.of_seat(seat).items()
        }
        return JSONResponse({"missions": own}, headers=NO_STORE)

    # -- networks ----------------------------------------------------------------------------------

    async def _network(self, seat: int, request: Request) -> Response:
        """Take a network of a seat (PUT); return all that it has handed in."""
        self._live.ensure_ticking()
        if request.method == "PUT":
            await self._take_network(seat, request)
        scenes = await asyncio.to_thread(network_scenes)
        now = self._live.tournament.tournaments.now
        facts = {
            "scenes": [
                {"name": scene.name, "title": library_text(scene.title), "parts": scene.parts}
                for scene in scenes.values()
            ],
            "scene": "" if now is None else now.scene,
            "networks": [network_facts(row) for row in self._networks.of_seat(seat)],
            "max_bytes": MAX_NETWORK_BYTES,
        }
        return Response(to_json(facts), headers=NO_STORE, media_type="application/json")

    async def _take_network(self, seat: int, request: Request) -> None:
        kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
        if kind != _NETWORK_TYPE:
            raise HTTPException(
                415,
                _(
                    "Content-Type: expected {network_type}, got {kind!r}",
                    network_type=_NETWORK_TYPE,
                    kind=kind[:80],
                ),
            )
        if seat in self._sending:
            raise HTTPException(429, _("Another file of yours is being sent. Wait for its end."))
        given = request.query_params
        scene, part, file = (given.get(name, "") for name in ("scene", "part", "file"))
        self._sending.add(seat)
        try:
            # before the file is read: what is known already needs no file
            await asyncio.to_thread(check_network, scene, part, file, 1)
            data = await _network_in(request)
            await asyncio.to_thread(self._networks.add, seat, scene, part, file, data)
        finally:
            self._sending.discard(seat)


async def _network_in(request: Request) -> bytes:
    """Return the network in the body of a request.

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
