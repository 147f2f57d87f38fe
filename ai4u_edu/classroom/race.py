"""A race: everybody drives the same world in their own room; the best verified time wins."""

import asyncio
import secrets
import sqlite3
import time
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.classroom.assignments import AssignedScene
from ai4u_edu.classroom.episode_check import Claim, EpisodeCheck
from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.store import ClassStore, SeatRow
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text, packed, unpacked
from ai4u_edu.wire.class_link import CurrentRace, EpisodeResult, RaceRow

WINNING = ("goal", "won")
GHOSTS = 3
MAX_RESULTS_PER_ROOM = 300
"""Results of one race and room that are kept; later ones do not count."""
MIN_TELL_INTERVAL_S = 2.0
"""Shortest time between two messages to rooms because of results: ghosts may be large."""
FOLDER = "race"
DISMISSED = "dismissed_race"
_NO_RACE = CurrentRace("", "over", 0.0, "", 0, ())
Phase = Literal["countdown", "running", "over"]
Verdict = Literal["open", "right", "refused", "none"]


@dataclass(frozen=True)
class RaceState:
    """A race."""

    id: str
    title: str
    scene: str
    """Name in the library, or YAML."""
    seed: int
    phase: Phase
    is_board_hidden: bool


@dataclass(frozen=True)
class RaceResult:
    """Result of one episode."""

    key: str
    room: str
    outcome: str
    seconds: float
    verdict: Verdict
    """``open``: to be checked; ``none``: it claims no goal, or was slower than the room's best."""
    reason: str = ""
    """Reason for which it was refused."""

    @property
    def rank(self) -> tuple[bool, float]:
        """Order of results: whoever reached the goal first."""
        return self.outcome not in WINNING, self.seconds


class Races:
    """The present race of a class. Belongs to the event loop, except :meth:`stage`.

    Args:
        store: of the class.
        clock: returns seconds; to be replaced in tests.
    """

    def __init__(self, store: ClassStore, clock: Callable[[], float] = time.monotonic) -> None:
        self._store, self._clock = store, clock
        self.read()

    def read(self) -> None:
        """Take the last race from the store; a countdown that was interrupted has ended."""
        self.now: RaceState | None = None
        self.results: dict[str, RaceResult] = {}
        self._starts_at = self._clock()
        rows = self._store.query(
            "select id, title, scene, seed, phase, is_board_hidden from races "
            "order by rowid desc limit 1"
        )
        for row in rows:
            if row[0] == self._store.setting(DISMISSED):
                continue
            self.now = RaceState(row[0], row[1], row[2], row[3], row[4], bool(row[5]))
            found = self._store.query(
                "select key, room, outcome, seconds, verdict, reason from race_results "
                "where race = ?",
                [self.now.id],
            )
            self.results = {row[0]: RaceResult(*row) for row in found}

    @property
    def starts_in_s(self) -> float:
        """Seconds until the start; 0 after it."""
        return max(0.0, self._starts_at - self._clock())

    def start(
        self, scene: AssignedScene, seed: int | None, countdown: float, hide: bool
    ) -> RaceState:
        """Begin a race, in the place of one before, and return it.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        seed = secrets.randbelow(MAX_SEED + 1) if seed is None else seed
        phase: Phase = "countdown" if countdown else "running"
        race = RaceState(secrets.token_hex(8), scene.title, scene.text, seed, phase, hide)
        with self._store.transaction() as database:
            database.execute(
                "insert into races values (?, ?, ?, ?, ?, ?)",
                (race.id, race.title, race.scene, race.seed, race.phase, hide),
            )
        self.now, self.results = race, {}
        self._starts_at = self._clock() + countdown
        return race

    def change(self, *, phase: Phase | None = None, hide: bool | None = None) -> None:
        """Change the present race's phase, or hide or show its board.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        if self.now is None:
            return
        race = replace(
            self.now,
            phase=phase or self.now.phase,
            is_board_hidden=self.now.is_board_hidden if hide is None else hide,
        )
        with self._store.transaction() as database:
            database.execute(
                "update races set phase = ?, is_board_hidden = ? where id = ?",
                (race.phase, race.is_board_hidden, race.id),
            )
        self.now = race

    def start_if_due(self) -> bool:
        """Start the race when its countdown is over; return True if it starts now."""
        if self.now is None or self.now.phase != "countdown" or self.starts_in_s > 0:
            return False
        self.now = replace(self.now, phase="running")
        return True

    def dismiss(self) -> None:
        """Show no race any more; its results stay in the store.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        if self.now is not None:
            self._store.set_setting(DISMISSED, self.now.id)
        self.now, self.results = None, {}

    def takes(self, room: str, result: EpisodeResult) -> bool:
        """Return True for a result of the present race that counts."""
        if self.now is None or result.race != self.now.id or self.now.phase == "countdown":
            return False
        count = sum(each.room == room for each in self.results.values())
        return count < MAX_RESULTS_PER_ROOM

    def stage(
        self, database: sqlite3.Connection, results: Iterable[tuple[str, EpisodeResult]]
    ) -> list[RaceResult]:
        """Write new results of the present race; called in a thread, within a transaction.

        Args:
            database: in the transaction.
            results: room and result.

        Raises:
            StoreError: an episode can't be written.
        """
        staged = []
        for room, result in results:
            is_open = result.outcome in WINNING
            if is_open:
                try:
                    path = self.path_of(result.race, result.key)
                    path.parent.mkdir(parents=True, exist_ok=True)
                    write_atomically(path, result.episode)
                except OSError as error:
                    raise StoreError(
                        _("The class can't save an episode: {problem}", problem=str(error))
                    ) from None
            verdict: Verdict = "open" if is_open else "none"
            one = RaceResult(result.key, room, result.outcome, result.seconds, verdict)
            row = (one.key, result.race, room, one.outcome, one.seconds, verdict, "")
            database.execute("insert into race_results values (?, ?, ?, ?, ?, ?, ?)", row)
            staged.append(one)
        return staged

    def path_of(self, race: str, key: str) -> Path:
        """Return the path of an episode's file."""
        return self._store.folder / FOLDER / race / f"{key}.episode"

    def delete_episodes(self, rooms: Iterable[str]) -> None:
        """Delete the episodes of rooms, in all races; a thread may do it."""
        for room in rooms:
            for race, key in self._store.query(
                "select race, key from race_results where room = ?", [room]
            ):
                self.path_of(race, key).unlink(missing_ok=True)

    def forget(self, rooms: Collection[str]) -> None:
        """Forget rooms that were deleted."""
        self.results = {key: each for key, each in self.results.items() if each.room not in rooms}

    @property
    def has_open_claims(self) -> bool:
        """True if a result must be checked."""
        return any(each.verdict == "open" for each in self.results.values())

    def next_claim(self) -> tuple[RaceResult, Claim] | None:
        """Return the fastest result to check; those that can't matter are closed.

        Raises:
            StoreError: that can't be stored.
        """
        best = self.best()
        for each in sorted(self.results.values(), key=lambda each: each.rank):
            if each.verdict != "open" or self.now is None:
                continue
            known = best.get(each.room)
            if known is not None and known.rank <= each.rank:
                self.judge(each, "none")
                continue
            try:
                episode = self.path_of(self.now.id, each.key).read_bytes()
            except OSError:
                episode = b""
            race = self.now
            return each, Claim(episode, race.scene, race.seed, each.outcome, each.seconds)
        return None

    def judge(self, result: RaceResult, verdict: Verdict, reason: str = "") -> None:
        """Note the verdict on a result, and delete an episode that nobody needs any more.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        if self.now is None or result.key not in self.results:  # of a race before
            return
        reason = packed(reason)
        judged = replace(result, verdict=verdict, reason=reason)
        with self._store.transaction() as database:
            database.execute(
                "update race_results set verdict = ?, reason = ? where key = ?",
                (verdict, reason, result.key),
            )
        slower = self.best().get(result.room) if verdict == "right" else result
        self.results[result.key] = judged
        if slower is not None:
            self.path_of(self.now.id, slower.key).unlink(missing_ok=True)

    def best(self) -> dict[str, RaceResult]:
        """Return the best result of each room that is not open or refused."""
        found: dict[str, RaceResult] = {}
        for each in self.results.values():
            counts = each.verdict == "right" or each.outcome not in WINNING
            if counts and (each.room not in found or each.rank < found[each.room].rank):
                found[each.room] = each
        return found

    def refused(self) -> dict[str, RaceResult]:
        """Return the last refused result of each room."""
        return {each.room: each for each in self.results.values() if each.verdict == "refused"}

    def ghosts(self) -> tuple[bytes, ...]:
        """Return the episodes of the best three that reached the goal."""
        if self.now is None:
            return ()
        best = sorted(self.best().values(), key=lambda each: each.rank)
        paths = [self.path_of(self.now.id, e.key) for e in best if e.outcome in WINNING]
        return tuple(path.read_bytes() for path in paths[:GHOSTS] if path.is_file())


class RaceRunner:
    """Runs the present race. Belongs to the event loop.

    Args:
        races: of the class.
        check: of results.
        seats_of: returns the seats of a room.
        tell: sends the race to rooms and pages.
    """

    def __init__(
        self,
        races: Races,
        check: EpisodeCheck,
        seats_of: Callable[[str], Sequence[SeatRow]],
        tell: Callable[[], object],
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
        """Start the race if it is time, send changes, and go on checking."""
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

    def messages(self) -> Callable[[str], CurrentRace]:
        """Return a function that returns the race as a room gets it."""
        race = self._races.now
        if race is None:
            return lambda _room: _NO_RACE
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
        return lambda room: CurrentRace(*fields, ghosts, times.get(room, 0.0))

    def event(self, *, is_projected: bool) -> dict[str, Any] | None:
        """Return the race as the teacher's page and the projector page get it."""
        race = self._races.now
        if race is None:
            return None
        best = sorted(self._races.best().values(), key=lambda each: each.rank)
        board = [self._row(each) for each in best]
        if not is_projected:
            board += [
                self._row(each) | {"outcome": "refused", "why": unpacked(each.reason)}
                for each in self._races.refused().values()
            ]
        elif race.is_board_hidden:
            board = []
        return {
            "id": race.id,
            "phase": race.phase,
            "starts_in": round(self._races.starts_in_s, 1),
            "scene": library_text(race.title),
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
            return "", "#808080"
        return " & ".join(each.name for each in seats), seats[0].colour
