"""HTTP routes of programs: a seat's own, and those of rooms for the teacher."""

import asyncio
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.classroom.errors import NewerProgramError, ProgramNotKeptError, StoreError
from ai4u_edu.classroom.join import NO_STORE, seat_of
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.program_runs import MistakeKind, ProgramRun, RunState
from ai4u_edu.classroom.programs import (
    MAX_AGENT_NAME_CHARS,
    MAX_DEVICE_CHARS,
    MAX_PROGRAM_CHARS,
    MAX_SCENE_NAME_CHARS,
    ProgramRow,
)
from ai4u_edu.classroom.seat_rate import SeatRate
from ai4u_edu.page.server.limits.json_body import read_json

MAX_BODY_BYTES = 6 * MAX_PROGRAM_CHARS + 4000
"""JSON takes at most six bytes for a character."""
MAX_VERSION = 2**53
MAX_RUN_BODY_BYTES = 6000
MAX_MISTAKE_CHARS = 700
MAX_GLANCE_CHARS = 3000
"""Characters of each program in the view of all."""


class SavedProgram(BaseModel):
    """Body of a request to keep a program."""

    model_config = ConfigDict(extra="forbid")

    scene: str = Field(min_length=1, max_length=MAX_SCENE_NAME_CHARS)
    agent: str = Field(min_length=1, max_length=MAX_AGENT_NAME_CHARS)
    source: str = Field(max_length=MAX_PROGRAM_CHARS)
    base: int = Field(ge=0, le=MAX_VERSION, strict=True)
    """Latest version that the device has seen; 0 for none."""
    device: str = Field(min_length=1, max_length=MAX_DEVICE_CHARS)
    """Random id of the browser."""


class ReportedRun(BaseModel):
    """Body of a request that tells how a program runs."""

    model_config = ConfigDict(extra="forbid")

    state: RunState
    kind: MistakeKind | Literal[""] = ""
    text: str = Field(default="", max_length=MAX_MISTAKE_CHARS)
    line: int = Field(default=0, ge=0, le=MAX_PROGRAM_CHARS, strict=True)


class ProgramRoutes:
    """Routes of programs. Belongs to the event loop.

    Args:
        live: the class.
    """

    def __init__(self, live: LiveClass) -> None:
        self._live, self._programs, self._rate = live, live.programs, SeatRate()
        self._run_rate = SeatRate()

    async def own(self, request: Request) -> Response:
        """Keep a program of the browser's seat (PUT), or return it (GET)."""
        seat = seat_of(self._live.seats, request)
        if seat is None:
            return _problem("This browser has no place in the class.", 403)
        if not self._rate.is_allowed(seat.number):
            return _problem("Too many programs at once. Try again in some seconds.", 429)
        try:
            if request.method == "PUT":
                return await self._save(seat.number, request)
            return await self._found(seat.number, request)
        except HTTPException as error:
            return _problem(error.detail, error.status_code)
        except NewerProgramError as error:
            return _problem(str(error), 409)
        except ProgramNotKeptError as error:
            return _problem(str(error), 400)
        except StoreError as error:
            return _problem(f"{error} Tell your teacher.", 503)

    async def run(self, request: Request) -> Response:
        """Note how the program of the browser's seat runs, or which mistake stopped it."""
        seat = seat_of(self._live.seats, request)
        if seat is None:
            return _problem("This browser has no place in the class.", 403)
        if not self._run_rate.is_allowed(seat.number):
            return _problem("Too many runs at once. Try again in some seconds.", 429)
        runs = self._live.program_runs
        try:
            sent = await read_json(request, ReportedRun, MAX_RUN_BODY_BYTES)
            kind = (sent.kind or "error") if sent.state == "mistake" else ""
            run = ProgramRun(sent.state, kind, sent.text, sent.line)
            await asyncio.to_thread(runs.save, seat.number, run)
        except HTTPException as error:
            return _problem(error.detail, error.status_code)
        except StoreError as error:
            return _problem(f"{error} Tell your teacher.", 503)
        runs.note(seat.number, run)
        self._live.note_change()
        return JSONResponse({}, headers=NO_STORE)

    async def of_all(self) -> Response:
        """Return the beginning of the latest program of each seat that is in the class."""
        try:
            found = await asyncio.to_thread(self._programs.latest_of_all)
        except StoreError as error:
            return _problem(str(error), 503)
        names = {each.number: each.name for each in self._live.seats.all() if each.state == "in"}
        programs = [
            {"seat": each.seat, "name": names[each.seat], **self._facts(each, MAX_GLANCE_CHARS)}
            for each in found
            if each.seat in names
        ]
        return JSONResponse({"programs": programs}, headers=NO_STORE)

    async def of_room(self, request: Request) -> Response:
        """Return the latest program of each seat of a room; the teacher's token is checked before.

        Without a room, those of all seats. Earlier scenes' programs are in the export.
        """
        room = request.query_params.get("room", "")
        if not room:
            return await self.of_all()
        if room not in self._live.rooms and room not in self._live.seats.scenes():
            return _problem("room: there is no such room", 404)
        seats = self._live.seats_of_id(room)
        try:
            found = [
                await asyncio.to_thread(self._programs.latest_of, each.number) for each in seats
            ]
        except StoreError as error:
            return _problem(str(error), 503)
        programs = [
            {"seat": each.number, "name": each.name, **self._facts(program)}
            for each, program in zip(seats, found, strict=True)
        ]
        return JSONResponse({"programs": programs}, headers=NO_STORE)

    async def _save(self, seat: int, request: Request) -> Response:
        sent = await read_json(request, SavedProgram, MAX_BODY_BYTES)
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

    async def _found(self, seat: int, request: Request) -> Response:
        names = ("scene", "agent", "device")
        scene, agent, device = (request.query_params.get(name, "") for name in names)
        program = await asyncio.to_thread(self._programs.find, seat, scene, agent)
        facts = self._facts(program)
        if program is not None:
            facts |= {"version": program.version, "is_of_device": program.device == device}
        return JSONResponse(facts, headers=NO_STORE)

    def _facts(
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


def _problem(text: str, status: int) -> Response:
    return JSONResponse({"problem": text}, status, NO_STORE)
