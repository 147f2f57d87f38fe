"""A class as it is now: rooms, links, who is here, and what the teacher has asked for."""

import asyncio
import logging
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Literal

from msgspec.structs import asdict, replace
from pydantic import BaseModel, RootModel

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.log_limit import log_limited
from ai4u_edu.classroom.assignments import Assignments
from ai4u_edu.classroom.attention import AttentionState
from ai4u_edu.classroom.episode_check import EpisodeCheck
from ai4u_edu.classroom.errors import CommandError, StoreError
from ai4u_edu.classroom.live_rooms import LiveRoom, OpenLink, remote_id
from ai4u_edu.classroom.missions import ClassMissions
from ai4u_edu.classroom.practice_queue import PracticeQueue
from ai4u_edu.classroom.programs import ProgramRuns, Programs, Stars
from ai4u_edu.classroom.progress import Progress
from ai4u_edu.classroom.race import FOLDER as RACES
from ai4u_edu.classroom.race import RaceRunner, Races
from ai4u_edu.classroom.result_writer import Received, ResultWriter
from ai4u_edu.classroom.room_host import RoomHost
from ai4u_edu.classroom.scene_file import NAME as SCENE_FILE
from ai4u_edu.classroom.seats import Seats, SeatState
from ai4u_edu.classroom.store import PRESENT_ROOM, ROOMS, TEACHER_SETTING, ClassStore, SeatRow
from ai4u_edu.classroom.task_queue import TaskQueue
from ai4u_edu.classroom.tournament.networks import FOLDER as NETWORKS
from ai4u_edu.classroom.tournament.runner import TournamentRunner
from ai4u_edu.classroom.tournament.tournaments import FOLDER as TOURNAMENTS
from ai4u_edu.classroom.trainings import Trainings
from ai4u_edu.games.jobs.processes import core_count
from ai4u_edu.locale import gettext as _
from ai4u_edu.member.room_state import read_counts
from ai4u_edu.wire.class_link import (
    VERSION,
    CheckedNetwork,
    ClassSettings,
    ExerciseResult,
    FromClass,
    HandedIn,
    LinkWelcome,
    People,
    Person,
    RoomTrainings,
    Switches,
    Work,
)

_logger = logging.getLogger(__name__)
TICK_S = 0.5
"""Interval at which ends of times are looked for."""
SHOWN = "shown"
SWITCHES = "switches"
EndSockets = Callable[[int, str], object]
"""Ends the sockets of a seat's pages, for a reason."""
ShownKind = Literal["join", "room", "race", "tournament", "game", "board"]


class Shown(BaseModel):
    """Content of the projector page."""

    kind: ShownKind = "join"
    room: str = ""
    game: int = 0


class _StoredSwitches(RootModel[dict[str, bool]]):
    root: dict[str, bool] = {}


class LiveClass:
    """Present state of a class, in memory. Belongs to the event loop.

    Args:
        store: of the class.
        seats: of the class.
        host: runs the rooms of this machine.
        check: of the results of races.
        missions: folder with the teacher's missions; None for none.
    """

    def __init__(
        self,
        store: ClassStore,
        seats: Seats,
        host: RoomHost,
        check: EpisodeCheck,
        missions: Path | None = None,
    ) -> None:
        self.store, self.seats, self.host = store, seats, host
        self.version = 0
        """Counts changes, except drawings and poses, which rooms count."""
        self.rooms: dict[str, LiveRoom] = {}
        self._wrong = _wrong_answers(store)
        """Last wrong answers of rooms before this process: exercise, diagnosis and count."""
        self.pages: Counter[int] = Counter()
        """Open sockets of each seat's pages."""
        self.looks_in: Counter[str] = Counter()
        """Open sockets of the teacher's pages in each room."""
        self.attention = AttentionState(store)
        self.switches = _read_switches(store)
        self.assignments = Assignments(store)
        self.progress = Progress(store)
        self.programs, self.program_runs = Programs(store), ProgramRuns(store)
        self.stars = Stars(store)
        self.missions = ClassMissions(store, missions)
        self.races = Races(store)
        self.race = RaceRunner(self.races, check, self.seats_of_id, self._tell_race)
        self.tournament = TournamentRunner(store, self._tell_networks, self.note_change)
        self.trainings = Trainings(store, self.tell_trainings, self.note_change)
        workers = max(1, core_count() - 1)
        self.practices = PracticeQueue(store, workers, self.tell_trainings, self.note_change)
        self.tasks = TaskQueue(store, self.tell_trainings, self.note_change)
        self.results = ResultWriter(
            store, self.progress, self.races, self._note_exercise, self._note_results
        )

        self.shown = store.setting_as(SHOWN, Shown)
        """Content of the projector page."""
        self._ticking: asyncio.Task[None] | None = None

    def note_change(self) -> None:
        """Count a change, which is sent to pages soon."""
        self.version += 1

    def ensure_ticking(self) -> None:
        """Start the task that looks for ends of times, once the event loop runs."""
        if self._ticking is None:
            self._ticking = asyncio.create_task(self._tick())

    async def _tick(self) -> None:
        while True:
            await asyncio.sleep(TICK_S)
            try:
                if self.attention.is_over():
                    self.attention.end()
                    self.tell_attention()
                self.race.tick()
                self.tournament.tick()
                self.trainings.tick()
                self.practices.tick()
                self.tasks.tick()
                await asyncio.to_thread(self.attention.save_rest)
                await self._measure_folder()
                await self._refresh_missions()
            except Exception as error:  # a full disk, say: the next tick tries again
                log_limited(_logger, logging.ERROR, "tick", "a class's clock failed: %r", error)

    async def _refresh_missions(self) -> None:
        before = self.missions.known
        await asyncio.to_thread(self.missions.refresh)
        if self.missions.known is not before:
            self.note_change()

    async def _measure_folder(self) -> None:
        before = self.store.quota.warning
        await asyncio.to_thread(self.store.quota.measure)
        if self.store.quota.warning != before:
            self.note_change()

    @property
    def problem(self) -> str:
        """Sentence for the teacher about what is not saved, or soon won't be; empty for none."""
        return self.results.problem or self.store.quota.warning

    def show(self, kind: ShownKind, room: str, game: int = 0) -> None:
        """Store what the projector page shows."""
        shown = Shown(kind=kind, room=room, game=game)
        self.store.set_setting(SHOWN, shown.model_dump_json())
        self.shown = shown

    def room_of(self, secret: str) -> LiveRoom | None:
        """Return the room of a link, by a room's secret or a seat's token; None for a wrong one."""
        room = self.host.room_of(secret)
        if room and room in self.seats.scenes():
            return self.room(room)
        seat = self.seats.by_token(secret)
        return None if seat is None else self.room(remote_id(seat.number), seat.number)

    def room(self, room: str, seat: int = 0) -> LiveRoom:
        """Return the state of a room, which is made if there is none; with a seat, a remote one."""
        if room not in self.rooms:
            self.rooms[room] = live = LiveRoom(room, "remote" if seat else "local", seat)
            exercise, diagnosis, live.wrong = self._wrong.get(room, ("", "", 0))
            live.wrong_answer = exercise, diagnosis
            if not seat:
                live.note_counts(read_counts(self.store.room_folder(room)))
        return self.rooms[room]

    def seats_of(self, room: LiveRoom) -> list[SeatRow]:
        """Return the seats of a room that may enter it."""
        return self.members().get(room.id, [])

    def members(self) -> dict[str, list[SeatRow]]:
        """Return the seats of all rooms, also of those that seats bring along, by the room's id."""
        found: dict[str, list[SeatRow]] = defaultdict(list)
        for each in self.seats.all():
            if each.state == SeatState.IN.value:
                found[each.room].append(each)
                found[remote_id(each.number)].append(each)
        return found

    def seats_of_id(self, room: str) -> list[SeatRow]:
        """Return the seats of a room that may enter it; see :meth:`seats_of`."""
        return self.members().get(room, [])

    def all_seats_of(self, room: str) -> list[SeatRow]:
        """Return all seats of a room, also those that were sent out or banned."""
        return [each for each in self.seats.all() if room in (each.room, remote_id(each.number))]

    def is_here(self, seat: int) -> bool:
        """Return True while a page, a notebook or a world of the seat is connected."""
        remote = self.rooms.get(remote_id(seat))
        return self.pages[seat] > 0 or (remote is not None and remote.link is not None)

    def connect(self, room: LiveRoom, link: OpenLink) -> None:
        """Take a room's new link, in the place of one before, and send it everything."""
        before, room.link, room.people = room.link, link, None
        if before is not None:
            before.end(_("Another program has taken this place in the class; this one is out."))
        seats = self.seats_of(room)
        for each in seats:
            self.progress.begin(each.number)
        name, colour = (seats[0].name, seats[0].colour) if len(seats) == 1 else ("", "")
        link.send(LinkWelcome(VERSION, name, colour))
        link.send(self.assignments.of(room.id))
        link.send(self.attention.as_message())
        link.send(ClassSettings(self.switches))
        link.send(self.race.messages()(room.id))
        if room.seat:
            self.missions.arrived(room.seat)
            link.send(self._handed_in(room.seat))
        else:
            link.send(self._trainings(room.id))
        self.tell_people()

    def disconnect(self, room: LiveRoom, link: OpenLink) -> None:
        """Note that a link has ended."""
        if room.link is link:
            room.link = None
            self.tell_people()

    def page_opened(self, seat: int, change: int) -> None:
        """Note that a socket of a seat's page was opened (1) or closed (-1)."""
        if change > 0 and not self.is_here(seat):
            self.missions.arrived(seat)
        self.pages[seat] += change
        self.tell_people()

    @contextmanager
    def looking_in(self, room: str) -> Iterator[None]:
        """Tell a room's students that the teacher looks in, meanwhile."""
        self.looks_in[room] += 1
        self.tell_people()
        try:
            yield
        finally:
            self.looks_in[room] -= 1
            self.tell_people()

    def tell_people(self) -> None:
        """Tell all rooms and pages who has a seat, and who is here."""
        members = self.members()
        for room in self.rooms.values():
            if room.link is None:
                continue
            people = People(
                tuple(
                    Person(each.number, each.name, each.colour, self.is_here(each.number))
                    for each in members.get(room.id, ())
                ),
                is_visited=bool(room.seat) or self.host.is_used(room.id),
                has_teacher=self.looks_in[room.id] > 0,
            )
            if people != room.people:
                room.people = people
                room.link.send(people)
        self.note_change()

    def tell_attention(self) -> None:
        """Tell all rooms and pages of the teacher's request."""
        self._send(lambda _: self.attention.as_message())

    def switch(self, name: str, *, on: bool) -> None:
        """Turn one of the class's switches, and tell all rooms and pages.

        Raises:
            CommandError: there is no such switch.
            StoreError: it can't be stored; then nothing has changed.
        """
        if name not in Switches.__struct_fields__:
            known = ", ".join(Switches.__struct_fields__)
            text = _("name: expected one of {known}, got {name!r}", known=known, name=name)
            raise CommandError(text)
        switches = replace(self.switches, **{name: on})
        stored = _StoredSwitches(asdict(switches))
        self.store.set_setting(SWITCHES, stored.model_dump_json())
        self.switches = switches
        self._send(lambda _: ClassSettings(switches))

    def tell_assignments(self) -> None:
        """Tell all rooms their scenes."""
        self._send(lambda room: self.assignments.of(room.id))

    def _tell_race(self) -> None:
        message = self.race.messages()
        self._send(lambda room: message(room.id))

    def _tell_networks(self, seat: int) -> None:
        room = self.rooms.get(remote_id(seat))
        if room is not None and room.link is not None:
            room.link.send(self._handed_in(seat))

    def tell_trainings(self, room: str) -> None:
        """Tell a room of its trainings, and that there may be a network for it."""
        live = self.rooms.get(room)
        if live is not None and live.link is not None:
            live.link.send(self._trainings(room))

    def _trainings(self, room: str) -> RoomTrainings:
        training = self.trainings.of_room(room)
        trainings = () if training is None else (training,)
        practices, tasks = self.practices.of_room(room), self.tasks.of_room(room)
        return RoomTrainings(trainings, practices, tasks)

    def _handed_in(self, seat: int) -> HandedIn:
        return HandedIn(
            tuple(
                CheckedNetwork(
                    each.request, each.scene, each.part, each.file, each.verdict, each.reason
                )
                for each in self.tournament.networks.of_seat(seat)
            )
        )

    def _send(self, message: Callable[[LiveRoom], FromClass]) -> None:
        for room in self.rooms.values():
            if room.link is not None:
                room.link.send(message(room))
        self.note_change()

    def keep_work(self, room: LiveRoom, work: Work) -> None:
        """Note the scene of a room, and write that of a remote one; a thread may do it.

        Rooms of this machine write their own. A scene that can't be written is sent again later.
        """
        with suppress(StoreError, OSError):
            for seat in self.seats_of(room):
                if self.present_room(seat) != room.id:
                    self.store.set_setting(f"{PRESENT_ROOM}{seat.number}", room.id)
            if room.seat:
                self.store.quota.check()
                folder = self.store.room_folder(room.id)
                folder.mkdir(parents=True, exist_ok=True)
                write_atomically(folder / SCENE_FILE, work.scene)

    def present_room(self, seat: SeatRow) -> str:
        """Return the room of a seat whose scene changed last: the class's, or one it brought.

        Raises:
            StoreError: the class's file can't be read.
        """
        return self.store.setting(f"{PRESENT_ROOM}{seat.number}", seat.room)

    def end_links(self, seat: int, sentence: str) -> None:
        """End the link that a seat brought along."""
        room = self.rooms.get(remote_id(seat))
        if room is not None and room.link is not None:
            link, room.link = room.link, None
            link.end(sentence)
        self.tell_people()

    def end_all_links(self, sentence: str) -> None:
        """End all links."""
        for room in self.rooms.values():
            link, room.link = room.link, None
            if link is not None:
                link.end(sentence)

    async def delete_all(self, end_sockets: EndSockets) -> None:
        """Delete everything but the secret of the teacher's page, and set a new code.

        Nothing of seats, tokens, names and addresses is left in the folder; the file with the
        tables is made again, since deleted rows may be read from one.

        Args:
            end_sockets: ends those of a seat's pages, for a reason.

        Raises:
            StoreError: something can't be deleted; the class goes on without what is deleted.
        """
        rooms, seats = list(self.seats.scenes()), self.seats.all()
        self.seats.let_nobody_in()  # else a page that comes back would start its room again
        self.end_all_links(_("The class is over, and your teacher has deleted everything of it."))
        for seat in seats:
            end_sockets(seat.number, _("the class is over"))
        await asyncio.gather(*(self.host.end(each) for each in rooms))
        await self.results.finish()
        await self.tournament.end()
        await self.trainings.end()
        await self.practices.end()
        await self.tasks.end()
        self.attention.end()  # so that no message of the teacher is saved again
        await asyncio.to_thread(self._delete_files)
        self._begin_anew()

    async def delete_seat(self, number: int, end_sockets: EndSockets) -> None:
        """Delete everything of a seat, and of its room if no other seat has that.

        Tournaments that its networks have played in are deleted, too: their journals have the
        games. What the teacher has handed out to others has no name, and stays.

        Args:
            number: of the seat.
            end_sockets: as for :meth:`delete_all`.

        Raises:
            JoinError: there is no such seat.
            CommandError: a tournament is played now.
            StoreError: something can't be deleted; the seat is banned, and can be deleted again.
        """
        self.tournament.refuse_while_running()
        # first, else a page that comes back would start its room again
        await asyncio.to_thread(self.seats.set_state, number, SeatState.BANNED)
        sentence = _("Your teacher has deleted this seat, with everything of it.")
        end_sockets(number, sentence)
        self.end_links(number, sentence)
        (seat,) = (each for each in self.seats.all() if each.number == number)
        rooms = [remote_id(number)]
        if self.all_seats_of(seat.room) == [seat]:
            rooms.append(seat.room)
            await self.host.end(seat.room)
        for room in rooms:
            await self.trainings.delete(room)
            await self.practices.delete(room)
            await self.tasks.delete(room)
        await self.results.finish()
        await self.tournament.delete(number)
        if self.shown.room in rooms:
            self.show("join", "")
        await asyncio.to_thread(self._delete_files_of, number, rooms)
        self._forget(number, rooms)

    def _delete_files(self) -> None:
        token = self.store.setting(TEACHER_SETTING)
        self.seats.begin_anew()
        self.store.set_setting(TEACHER_SETTING, token)
        self.store.delete_folders(ROOMS, RACES, NETWORKS, TOURNAMENTS)

    def _delete_files_of(self, number: int, rooms: list[str]) -> None:
        self.store.delete_folders(*(f"{ROOMS}/{room}" for room in rooms))
        self.races.delete_episodes(rooms)
        self.seats.delete(number, rooms)

    def _forget(self, seat: int, rooms: Collection[str]) -> None:
        """Forget a seat that was deleted, and its rooms."""
        for room in rooms:
            self.rooms.pop(room, None)
            self._wrong.pop(room, None)
        for each in (self.progress, self.program_runs, self.stars, self.missions):
            each.forget(seat)
        for part in (self.assignments, self.races):
            part.forget(rooms)
        self.race.note_results()
        self.tell_people()

    def _begin_anew(self) -> None:
        """Forget all states, after everything was deleted."""
        self.rooms.clear()
        self._wrong = {}
        self.attention.read()
        self.switches = Switches()
        self.assignments.read()
        self.progress.read()
        self.program_runs.read()
        self.stars.read()
        self.missions.read()
        self.races.read()
        self.tournament.read()
        self.trainings.read()
        self.practices.read()
        self.shown = Shown()
        self.tell_people()

    def _note_results(self) -> None:
        self.race.note_results()
        self.note_change()

    def _note_exercise(self, received: Received) -> None:
        result = received.result
        room = self.rooms.get(received.room)
        if room is None or not isinstance(result, ExerciseResult) or result.event == "hint":
            return
        room.note_check(result.exercise, result.diagnosis)


def _wrong_answers(store: ClassStore) -> dict[str, tuple[str, str, int]]:
    rows = store.query("select room, exercise, diagnosis, count from wrong_answers")
    return {room: (exercise, diagnosis, count) for room, exercise, diagnosis, count in rows}


def _read_switches(store: ClassStore) -> Switches:
    """Return the stored switches; those that another version had are left out."""
    stored = store.setting_as(SWITCHES, _StoredSwitches).root
    return Switches(
        **{name: on for name, on in stored.items() if name in Switches.__struct_fields__}
    )
