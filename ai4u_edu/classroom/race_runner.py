"""Course of a race: its start, the check of its results, and news of it to rooms and pages."""

import asyncio
import time
from collections.abc import Callable, Sequence
from typing import Any

from ai4u_edu.classroom.episode_check import EpisodeCheck
from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.race import WINNING, RaceResult, Races
from ai4u_edu.classroom.store import SeatRow
from ai4u_edu.wire.class_link import Race, RaceRow

MIN_TELL_INTERVAL_S = 2.0
"""Shortest time between two messages to rooms because of results: ghosts may be large."""
NO_RACE = Race("", "over", 0.0, "", 0, ())
SeatsOf = Callable[[str], Sequence[SeatRow]]
NOBODY = ("", "#808080")
"""Name and colour for a room without seats."""


class RaceRunner:
    """Runs the present race. Belongs to the event loop.

    Args:
        races: of the class.
        check: of results.
        seats_of: returns the seats of a room.
        tell: tells rooms and pages of the race.
    """

    def __init__(
        self, races: Races, check: EpisodeCheck, seats_of: SeatsOf, tell: Callable[[], object]
    ) -> None:
        self._races, self._check, self._seats_of, self._tell = races, check, seats_of, tell
        self._judging: asyncio.Task[None] | None = None
        self._has_news = False
        self._told_at = 0.0
        self._ghosts = races.ghosts()

    def note_results(self) -> None:
        """Note that there are new results, or that they have changed."""
        self._has_news = True

    def tell(self) -> None:
        """Tell rooms and pages at once, after a command."""
        self._tell_now()

    def tick(self) -> None:
        """Start the race if it is time, tell news, and go on checking."""
        is_due = time.monotonic() - self._told_at >= MIN_TELL_INTERVAL_S
        if self._races.start_if_due() or (self._has_news and is_due):
            self._tell_now()
        if self._judging is None and self._races.has_open_claims:
            self._judging = asyncio.create_task(self._judge())

    def _tell_now(self) -> None:
        self._has_news, self._told_at = False, time.monotonic()
        self._ghosts = self._races.ghosts()
        self._tell()

    async def _judge(self) -> None:
        try:
            while (found := self._races.next_claim()) is not None:
                result, claim = found
                fault = await self._check.find_fault(claim)
                self._races.judge(result, "refused" if fault else "right", fault)
                self._has_news = True
        except (StoreError, OSError):  # a full disk, say: the next tick tries again
            await asyncio.sleep(MIN_TELL_INTERVAL_S)
        finally:
            self._judging = None

    def messages(self) -> Callable[[str], Race]:
        """Return a function that returns the race as a room gets it."""
        race = self._races.now
        if race is None:
            return lambda _room: NO_RACE
        best = self._races.best()
        times = {room: each.seconds for room, each in best.items() if each.outcome in WINNING}
        rows: list[RaceRow] = []
        if not race.is_board_hidden:
            rows = [
                RaceRow(*self._who(each.room), each.outcome, each.seconds, each.room)
                for each in sorted(best.values(), key=lambda each: each.rank)
            ]
        starts_in = self._races.starts_in_s
        fields = (race.id, race.phase, starts_in, race.scene, race.seed, tuple(rows))
        ghosts = self._ghosts
        return lambda room: Race(*fields, ghosts, times.get(room, 0.0))

    def event(self, *, is_projected: bool) -> dict[str, Any] | None:
        """Return the race as the teacher's page and the projector page get it."""
        race = self._races.now
        if race is None:
            return None
        best = sorted(self._races.best().values(), key=lambda each: each.rank)
        board = [self._row(each) for each in best]
        if not is_projected:
            board += [
                self._row(each) | {"outcome": "refused", "why": each.reason}
                for each in self._races.refused().values()
            ]
        elif race.is_board_hidden:
            board = []
        return {
            "id": race.id,
            "phase": race.phase,
            "starts_in": round(self._races.starts_in_s, 1),
            "scene": race.title,
            "is_board_hidden": race.is_board_hidden,
            "board": board,
        }

    def _row(self, result: RaceResult) -> dict[str, Any]:
        name, colour = self._who(result.room)
        row = {"name": name, "colour": colour, "room": result.room, "outcome": result.outcome}
        return row | {"seconds": round(result.seconds, 2)}

    def _who(self, room: str) -> tuple[str, str]:
        """Return the names of a room's seats, and the colour of the first."""
        seats = self._seats_of(room)
        if not seats:
            return NOBODY
        return " & ".join(each.name for each in seats), seats[0].colour
