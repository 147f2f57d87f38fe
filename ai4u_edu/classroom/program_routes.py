"""HTTP routes of programs: a seat's own, and those of a room for the teacher."""

import asyncio
from typing import Any

from pydantic import BaseModel, ConfigDict, Field
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from ai4u_edu.classroom.errors import NewerProgramError, ProgramNotKeptError, StoreError
from ai4u_edu.classroom.join import NO_STORE, seat_of
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.programs import (
    MAX_AGENT_NAME_CHARS,
    MAX_PROGRAM_CHARS,
    MAX_SCENE_NAME_CHARS,
    ProgramRow,
)
from ai4u_edu.classroom.seat_rate import SeatRate
from ai4u_edu.server.json_body import read_json

MAX_BODY_BYTES = 6 * MAX_PROGRAM_CHARS + 4000
"""JSON takes at most six bytes for a character."""
MAX_AGE_S = 10 * 366 * 24 * 3600.0


class SavedProgram(BaseModel):
    """Body of a request to keep a program."""

    model_config = ConfigDict(extra="forbid")

    scene: str = Field(min_length=1, max_length=MAX_SCENE_NAME_CHARS)
    agent: str = Field(min_length=1, max_length=MAX_AGENT_NAME_CHARS)
    source: str = Field(max_length=MAX_PROGRAM_CHARS)
    age: float = Field(ge=0, le=MAX_AGE_S, allow_inf_nan=False)
    """Seconds since it was changed."""


class ProgramRoutes:
    """Routes of programs. Belongs to the event loop.

    Args:
        live: the class.
    """

    def __init__(self, live: LiveClass) -> None:
        self._live, self._programs, self._rate = live, live.programs, SeatRate()

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

    async def of_room(self, request: Request) -> Response:
        """Return the latest program of each seat of a room; the teacher's token is checked before.

        Earlier scenes' programs are in the export.
        """
        room = request.query_params.get("room", "")
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
        wanted = await read_json(request, SavedProgram, MAX_BODY_BYTES)
        await asyncio.to_thread(
            self._programs.save, seat, wanted.scene, wanted.agent, wanted.source, wanted.age
        )
        return JSONResponse({}, headers=NO_STORE)

    async def _found(self, seat: int, request: Request) -> Response:
        scene, agent = (request.query_params.get(name, "") for name in ("scene", "agent"))
        program = await asyncio.to_thread(self._programs.find, seat, scene, agent)
        return JSONResponse(self._facts(program), headers=NO_STORE)

    def _facts(self, program: ProgramRow | None) -> dict[str, Any]:
        if program is None:
            return {"source": None}
        return {
            "scene": program.scene,
            "agent": program.agent,
            "source": program.source,
            "age": round(self._programs.age_of(program), 3),
        }


def _problem(text: str, status: int) -> Response:
    return JSONResponse({"problem": text}, status, NO_STORE)
