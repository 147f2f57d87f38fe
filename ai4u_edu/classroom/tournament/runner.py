"""Course of a class's tournament: networks are checked, it is played, and pages are told."""

import asyncio
import json
import os
import shutil
import subprocess
import sys
from collections import defaultdict, deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from threading import Thread
from typing import Any, Literal

from ai4u_edu.base.atomic_write import reason, write_atomically
from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.classroom.errors import CommandError, StoreError
from ai4u_edu.classroom.store import ClassStore, SeatRow
from ai4u_edu.classroom.tournament.network_check import NetworkCheck, driver_of, missing_extras
from ai4u_edu.classroom.tournament.network_scene import network_scenes
from ai4u_edu.classroom.tournament.networks import FOLDER as NETWORKS
from ai4u_edu.classroom.tournament.networks import Networks
from ai4u_edu.classroom.tournament.tournaments import TournamentRow, Tournaments
from ai4u_edu.games.tournament.entry import Driver
from ai4u_edu.games.tournament.plan import TournamentPlan
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import unpacked

VIEW = "view.json"
"""File with a tournament as it was at its end."""
RETRY_S = 2.0
"""Time after which what could not be written is tried again."""


_SEATS = "seats.json"
"""File with the number of the seat of each entry; 0 for the scene's own player."""
System = Literal["round-robin", "swiss"]
END_TIMEOUT_S = 5.0
"""Time in which the process of a tournament has to end."""


class TournamentRunner:
    """Checks networks and runs the present tournament. Belongs to the event loop.

    Args:
        store: of the class.
        tell_seat: sends a seat's networks to its link.
        note_change: called when pages must be updated.
    """

    def __init__(
        self,
        store: ClassStore,
        tell_seat: Callable[[int], object],
        note_change: Callable[[], object],
    ) -> None:
        self._tell_seat, self._note_change = tell_seat, note_change
        self._news: deque[int] = deque()
        """Seats whose networks have changed, and 0 for the tournament; threads add to it."""
        self.networks = Networks(store, self._news.append)
        self.tournaments = Tournaments(store)
        self._check = NetworkCheck(self.networks, store.folder / NETWORKS / "check")
        self._checking: asyncio.Task[None] | None = None
        self._updating: asyncio.Task[None] | None = None
        self._lock = asyncio.Lock()
        """Held while the tournament begins or ends."""
        self._played: _PlayedTournament | None = None
        self.read()

    def read(self) -> None:
        """Take everything from the store; a tournament that was interrupted goes on."""
        self.networks.read()
        self.tournaments.read()
        self._ended_view: dict[str, Any] | None = None
        self.seats: Mapping[str, int] = {}
        """Number of the seat of each entry, by its name; 0 for the scene's own player."""
        if self.tournaments.now is not None:
            work = self.tournaments.work_of(self.tournaments.now)
            self.seats = _seats_of(work)
            with suppress(OSError, ValueError):
                self._ended_view = json.loads((work / VIEW).read_bytes())

    @property
    def view(self) -> dict[str, Any] | None:
        """The tournament so far; see :func:`ai4u_edu.games.tournament.live_process.live_view`."""
        return self._ended_view if self._played is None else self._played.view

    def tick(self) -> None:
        """Send changes, and go on with the next step."""
        seats = set()
        while self._news:
            seats.add(self._news.popleft())
        for seat in seats - {0}:
            self._tell_seat(seat)
        if seats:
            self._note_change()
        if self._checking is None and self.networks.next_open() and not missing_extras():
            self._checking = asyncio.create_task(self._check_networks())
        if self._updating is None and self._is_due:
            self._updating = asyncio.create_task(self._update())

    @property
    def _is_due(self) -> bool:
        """True if the tournament's process has to be started, or has ended."""
        row = self.tournaments.now
        is_running = row is not None and row.phase == "running"
        return is_running and (self._played is None or self._played.has_ended)

    # -- commands ----------------------------------------------------------------------------------

    async def begin(self, scene: str) -> None:
        """Begin a tournament, for which students hand in networks.

        Raises:
            CommandError: there is no such scene, or another tournament is played.
            StoreError: it can't be stored.
        """
        known = (await asyncio.to_thread(network_scenes)).get(scene)
        async with self._lock:
            self.refuse_while_running()
            if known is None:
                text = _("scene: expected one of the library, got {scene!r}", scene=scene[:40])
                raise CommandError(text)
            self.tournaments.begin(known.name, known.title)
            self._ended_view, self.seats = None, {}

    async def start(
        self, seats: Sequence[SeatRow], seeds: int, system: System, *, has_own_player: bool
    ) -> None:
        """Play the present tournament with the networks of some seats.

        Games of the same networks that were played before are not played again.

        Raises:
            CommandError: it can't be played now.
            StoreError: it can't be stored.
        """
        async with self._lock:
            row = self.refuse_while_running()
            if row is None:
                raise CommandError(_("There is no tournament: choose its scene first."))
            if missing := missing_extras():
                raise CommandError(missing)
            folder, work = self.tournaments.folder_of(row), self.tournaments.work_of(row)
            await asyncio.to_thread(
                _write_plan,
                folder,
                work,
                self.networks,
                seats,
                row.scene,
                seeds,
                system,
                has_own_player=has_own_player,
            )
            self.seats = await asyncio.to_thread(_seats_of, work)
            self.tournaments.change("running")
            self._ended_view = None

    async def cancel(self) -> None:
        """End the games; what was played stays.

        Raises:
            StoreError: it can't be stored.
        """
        async with self._lock:
            row = self.tournaments.now
            if row is None or row.phase != "running":
                return
            self.tournaments.change("cancelled")
            await self._end_played(row)

    async def dismiss(self) -> None:
        """Show no tournament any more.

        Raises:
            CommandError: it is played now.
            StoreError: it can't be stored.
        """
        async with self._lock:
            self.refuse_while_running()
            self.tournaments.dismiss()

    async def end(self) -> None:
        """End all processes and forget everything in memory, because it will be deleted."""
        self.networks.clear()
        self.tournaments.now = None
        if self._checking is not None:
            self._checking.cancel()
            await asyncio.gather(self._checking, return_exceptions=True)
        async with self._lock:
            played, self._played = self._played, None
            if played is not None:
                await asyncio.to_thread(played.end)

    async def delete(self, seat: int) -> None:
        """Delete a seat's networks, and the tournaments that they have played in.

        Raises:
            CommandError: one is played now.
            StoreError: they can't be deleted.
        """
        async with self._lock:
            self.refuse_while_running()
            now = self.tournaments.now
            await asyncio.to_thread(self._delete, seat)
            if self.tournaments.now is not now:
                self._ended_view, self.seats = None, {}

    def refuse_while_running(self) -> TournamentRow | None:
        """Return the present tournament.

        Raises:
            CommandError: it is played now.
        """
        row = self.tournaments.now
        if row is not None and row.phase == "running":
            text = _("A tournament is played now. Wait for its end, or cancel it first.")
            raise CommandError(text)
        return row

    def _delete(self, seat: int) -> None:
        self.networks.delete(seat)
        self.tournaments.delete(
            row
            for row in self.tournaments.all()
            if seat in _seats_of(self.tournaments.work_of(row)).values()
        )

    # -- tasks -------------------------------------------------------------------------------------

    async def _check_networks(self) -> None:
        try:
            await self._check.run()
        except (StoreError, OSError):  # a full disk, say: a later tick tries again
            await asyncio.sleep(RETRY_S)
        finally:
            self._checking = None

    async def _update(self) -> None:
        """Start the process of a tournament that runs, or note that it has ended."""
        try:
            async with self._lock:
                row = self.tournaments.now
                if row is None or not self._is_due:
                    return
                played = self._played
                if played is None:
                    folder, work = self.tournaments.folder_of(row), self.tournaments.work_of(row)
                    self._played = await asyncio.to_thread(
                        _PlayedTournament, folder, work, lambda: self._news.append(0)
                    )
                else:
                    self.tournaments.change("over" if played.is_over else "failed", played.problem)
                    await self._end_played(row)
        except (StoreError, OSError):
            await asyncio.sleep(RETRY_S)
        finally:
            self._updating = None

    async def _end_played(self, row: TournamentRow) -> None:
        played, self._played = self._played, None
        if played is not None:
            await asyncio.to_thread(played.end)
            self._ended_view = played.view
            path = self.tournaments.work_of(row) / VIEW
            with suppress(OSError):  # a full disk: the results are in the journal
                await asyncio.to_thread(write_atomically, path, json.dumps(played.view))
        self._note_change()


class _PlayedTournament:
    """A tournament that is played in a process of its own, which ends with this one.

    Args:
        folder: of the tournament's results, with its plan.
        work: gets the journal, and files of the games that are played.
        on_change: called in a thread of its own when the tournament goes on or ends.
    """

    def __init__(self, folder: Path, work: Path, on_change: Callable[[], object]) -> None:
        self.view: dict[str, Any] | None = None
        """The tournament so far; see :func:`ai4u_edu.games.tournament.live_process.live_view`."""
        self.problem = ""
        """Reason for which it could not be played."""
        self.is_over = False
        """True when all games were played."""
        self.has_ended = False
        """True when the process has ended, in any way."""
        self._on_change = on_change
        self._temporary = work / "games.tmp"
        # for files of the games that are played, with networks; nothing of it stays
        shutil.rmtree(self._temporary, ignore_errors=True)  # of a class that was killed
        self._temporary.mkdir(parents=True, exist_ok=True)
        variables = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(self._temporary.absolute()))
        self._process = subprocess.Popen(  # noqa: S603 - our own module
            [
                sys.executable,
                "-m",
                "ai4u_edu.games.tournament.live_process",
                str(folder),
                str(work),
            ],
            env={**os.environ, **variables},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        self._reader = Thread(target=self._read, name="tournament", daemon=True)
        self._reader.start()

    def end(self) -> None:
        """End the process, and wait for that; a thread does it."""
        if self._process.stdin is not None:
            self._process.stdin.close()
        try:
            self._process.wait(END_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
        self._reader.join(END_TIMEOUT_S)
        shutil.rmtree(self._temporary, ignore_errors=True)

    def _read(self) -> None:
        assert self._process.stdout is not None  # noqa: S101 - it is a pipe
        with self._process.stdout as lines:
            for line in lines:
                told = json.loads(line)
                self.view = told.get("view", self.view)
                self.problem = unpacked(told.get("problem", ""))
                self.is_over = told.get("is_over", False)
                self._on_change()
        code = self._process.wait()
        if not self.is_over and not self.problem:
            self.problem = _(
                "The tournament's process has ended by itself (code {code}). Start it "
                "again: it goes on where it was.",
                code=code,
            )
        self.has_ended = True
        self._on_change()


def _write_plan(
    folder: Path,
    work: Path,
    networks: Networks,
    seats: Sequence[SeatRow],
    scene: str,
    seeds: int,
    system: System,
    *,
    has_own_player: bool,
) -> None:
    """Write the plan of a tournament into its folder; a thread does it.

    The journal of games that were played before stays, so a game with the same networks is not
    played again.

    Args:
        folder: of the tournament's results.
        work: gets the seats of the entries.
        networks: of the class.
        seats: those that may take part.
        scene: name of a scene of the library.
        seeds: number of seeds for each pair, or of races.
        system: of the pairs.
        has_own_player: True if the scene's own player takes part.

    Raises:
        CommandError: fewer than two can play.
        StoreError: it can't be written.
    """
    try:
        plan, numbers = _plan(networks, seats, scene, seeds, system, has_own_player)
        shutil.rmtree(folder, ignore_errors=True)  # files of a plan before; see the journal
        plan.save(folder)
        work.mkdir(exist_ok=True)
        write_atomically(work / _SEATS, json.dumps(numbers))
    except OSError as error:
        text = _("The tournament can't be saved: {reason}.", reason=reason(error))
        raise StoreError(text) from None
    except SetupError as error:
        text = _("The tournament can't be saved: {reason}.", reason=text_of(error))
        raise StoreError(text) from None


def _plan(
    networks: Networks,
    seats: Sequence[SeatRow],
    scene: str,
    seeds: int,
    system: System,
    has_own_player: bool,
) -> tuple[TournamentPlan, dict[str, int]]:
    """Return the plan, and the number of the seat of each entry."""
    known = network_scenes()[scene]
    own: dict[int, dict[str, Driver]] = defaultdict(dict)
    for row in networks.playing(scene):
        own[row.seat][row.part] = driver_of(networks, row)
    playing = [seat for seat in seats if seat.number in own]
    entries = [known.entry(seat.name, own[seat.number]) for seat in playing]
    numbers = {seat.name: seat.number for seat in playing}
    player = known.own_player() if has_own_player else None
    if player is not None:
        entries.append(player)
        numbers[player.name] = 0
    if len(entries) < 2:
        raise CommandError(
            _(
                "A tournament needs two players at least, and {n} can play: wait until more "
                "networks were handed in and checked, or let the scene's player take part.",
                n=len(entries),
            )
        )
    plan = TournamentPlan(
        scene={"name": scene},
        entries=tuple(entries),
        seeds=tuple(range(seeds)),
        system=system,
        rounds=0,
    )
    return plan, numbers


def _seats_of(work: Path) -> Mapping[str, int]:
    """Return the number of the seat of each entry of a tournament; a thread does it."""
    try:
        found: dict[str, int] = json.loads((work / _SEATS).read_bytes())
    except (OSError, ValueError):
        return {}
    return found
