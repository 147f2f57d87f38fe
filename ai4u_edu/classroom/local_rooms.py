"""Rooms as processes of this machine."""

import asyncio
import logging
import multiprocessing
import secrets
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import forkserver
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path

import httpx

from ai4u_edu.base.errors import shorten
from ai4u_edu.classroom.errors import RoomError
from ai4u_edu.classroom.folder_quota import FolderQuota
from ai4u_edu.classroom.no_cookies import no_cookies
from ai4u_edu.classroom.room_host import RoomAddress
from ai4u_edu.classroom.room_process import (
    HOST,
    RoomFailed,
    RoomOrder,
    RoomReady,
    path_of,
    run_room,
)
from ai4u_edu.classroom.room_watch import RoomLimits, RoomWatch
from ai4u_edu.classroom.store import ROOMS
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS
from ai4u_edu.page.server.token_auth import is_same_secret

_logger = logging.getLogger(__name__)

PRELOAD = ("filelock", run_room.__module__, "ai4u_edu.classroom.room_preload")
"""Modules that are imported in the process that rooms are forked from. A file that is locked would
import the first one when it is needed; the last one is imported nowhere else."""
TIMEOUTS = DEFAULT_TIMEOUTS
"""Time limits of the rooms' servers."""
KILL_TIMEOUT_S = 60.0
"""Time in which the system removes a process that was killed; a busy machine takes seconds."""
FIRST_BACKOFF_S = 1.0
MAX_BACKOFF_S = 30.0
LONG_LIFE_S = 60.0
"""A process that ran for longer is restarted at once."""


@dataclass
class _Running:
    process: BaseProcess
    connection: Connection
    address: RoomAddress
    since: float
    watch: RoomWatch


@dataclass
class _Slot:
    """State of a room: its process, who uses it, and how often it ended early."""

    lock: asyncio.Lock = field(default_factory=asyncio.Lock)
    running: _Running | None = None
    backoff_s: float = 0.0
    retry_at: float = 0.0
    reason: str = ""
    """Reason for which its last process was ended."""
    users: int = 0
    """Sockets of pages and scripts."""
    used_at: float = 0.0


class LocalRooms:
    """Runs each room in a child process, which ends with this one.

    On Linux processes are forked from one that has loaded all packages, so that they start in
    tenths of a second and share its memory; elsewhere each one loads them.

    Args:
        folder: of the class; each room has a folder below it.
        blocks: Python files with the teacher's blocks, which every room loads.
        limits: of each process.
        are_shared: True if several students may be in a room.
        receive_timeout_ms: time for which a room's world waits for a program or a script.
        missions: folder with the teacher's missions, which every room reads; None for none.
        clock: returns seconds; to be replaced in tests.
    """

    def __init__(
        self,
        folder: Path,
        blocks: Iterable[Path] = (),
        limits: RoomLimits | None = None,
        *,
        are_shared: bool = False,
        receive_timeout_ms: int = 2000,
        missions: Path | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._are_shared, self._clock = are_shared, clock
        self._receive_timeout_ms = receive_timeout_ms
        self._missions = None if missions is None else missions.absolute()
        self._limits = limits or RoomLimits()
        self._watching: asyncio.Task[None] | None = None
        self._folder, self._blocks = folder, tuple(each.absolute() for each in blocks)
        self._slots: dict[str, _Slot] = {}
        self._secrets: dict[str, str] = {}
        self.class_url = ""
        """Address of the class, to which rooms open links; set before the first one starts."""
        self.quota: FolderQuota | None = None
        """Quota of the class's folder, to which rooms write; set before the first one starts."""
        is_forked = sys.platform == "linux"
        self._context = multiprocessing.get_context("forkserver" if is_forked else "spawn")
        if is_forked:
            self._context.set_forkserver_preload([*PRELOAD])
            forkserver.ensure_running()  # it imports while the first student comes in

    is_hosting = True

    async def enter(self, room: str, scene: str) -> RoomAddress:
        """Return the address of a room's server, which is started if it does not run.

        Raises:
            RoomError: it does not start, or ended early several times and waits.
        """
        slot = self._slots.setdefault(room, _Slot())
        slot.used_at = self._clock()
        if self._watching is None:
            self._watching = asyncio.create_task(self._watch())
        async with slot.lock:  # two pages that come at once wait for one process
            if slot.running is not None and slot.running.process.is_alive():
                return slot.running.address
            if slot.running is not None:
                self._note_end(room, slot, slot.running)
            if self._clock() < slot.retry_at:
                raise RoomError(slot.reason or _("Your world ended. It starts again in a moment."))
            slot.running = await asyncio.to_thread(self._start, room, scene)
            slot.reason = ""
            return slot.running.address

    @contextmanager
    def in_use(self, room: str) -> Iterator[None]:
        """Keep a room's process running while a socket is open."""
        slot = self._slots.setdefault(room, _Slot())
        slot.users += 1
        try:
            yield
        finally:
            slot.users -= 1
            slot.used_at = self._clock()

    def room_of(self, secret: str) -> str:
        """Return the room whose secret this is, also while it starts; empty if it is no room's."""
        for room, own in [*self._secrets.items()]:  # a thread starts rooms
            if is_same_secret(own, secret):
                return room
        return ""

    def is_used(self, room: str) -> bool:
        """Return True while a socket of the room is open."""
        return self._slots.get(room, _Slot()).users > 0

    def is_running(self, room: str) -> bool:
        """Return True if the room's process runs."""
        running = self._slots.get(room, _Slot()).running
        return running is not None and running.process.is_alive()

    async def end(self, room: str) -> None:
        """End a room's process; what was made there is saved."""
        slot = self._slots.get(room)
        if slot is None:
            return
        async with slot.lock:
            running, slot.running = slot.running, None
            if running is not None:
                await asyncio.to_thread(self._end, running)

    def close(self) -> None:
        """End all processes, when the class's event loop has ended."""
        running = [slot.running for slot in self._slots.values() if slot.running is not None]
        for each in running:  # all of them save at the same time
            each.connection.close()
        for each in running:
            self._end(each)

    async def _watch(self) -> None:
        """End processes that nobody uses, and those that break a limit, until the loop ends."""
        http = httpx.AsyncClient(trust_env=False, cookies=no_cookies())
        async with http as client, asyncio.TaskGroup() as requests:
            while True:
                await asyncio.sleep(self._limits.check_s)
                # side by side: one that does not answer keeps no other from its check
                await asyncio.gather(
                    *(
                        self._check(room, slot, slot.running, client, requests)
                        for room, slot in self._slots.items()
                        if slot.running is not None and not slot.lock.locked()
                    )
                )

    async def _check(
        self,
        room: str,
        slot: _Slot,
        running: _Running,
        client: httpx.AsyncClient,
        requests: asyncio.TaskGroup,
    ) -> None:
        idle_s = self._clock() - slot.used_at
        if slot.users == 0 and 0 < self._limits.sleep_after_s < idle_s:
            await self.end(room)
            return
        if self.quota is not None:
            running.watch.limit_files(is_full=self.quota.is_full)
        reason = running.watch.broken_limit()
        if reason:
            slot.reason = reason
            _logger.warning("room %s is ended: %s", room, reason)
            running.process.kill()
        elif slot.users:
            url = f"http://{HOST}:{running.address.port}{path_of(room)}/healthz"
            # beside the checks, which go on until it answers
            requests.create_task(running.watch.ask(client, url, running.address))

    def _start(self, room: str, scene: str) -> _Running:
        ours, theirs = self._context.Pipe()
        token = self._secrets[room] = secrets.token_urlsafe(24)
        folder = self._folder / ROOMS / room
        order = RoomOrder(
            room,
            scene,
            folder,
            token,
            self._blocks,
            self.class_url,
            self._are_shared,
            self._receive_timeout_ms,
            TIMEOUTS,
            self._missions,
        )
        process = self._context.Process(  # type: ignore[attr-defined]  # all contexts have it
            target=run_room, args=(order, theirs), name=f"room {room}", daemon=True
        )
        try:
            process.start()
        except (OSError, EOFError) as error:
            raise RoomError(
                _("Your world can't be started: {problem}. Tell your teacher.", problem=str(error))
            ) from None
        finally:
            theirs.close()
        answer: object = None
        try:
            if ours.poll(self._limits.start_timeout_s):
                answer = ours.recv()
        except EOFError:  # it has ended
            pass
        if isinstance(answer, RoomReady):
            address = RoomAddress(HOST, answer.port, token, answer.viser_port)
            watch = RoomWatch(process.pid, self._limits, self._clock)
            return _Running(process, ours, address, self._clock(), watch)
        ours.close()
        process.kill()
        reason = answer.reason if isinstance(answer, RoomFailed) else _("its process did not start")
        raise RoomError(_("Your world can't be opened: {reason}", reason=shorten(reason, 300)))

    def _note_end(self, room: str, slot: _Slot, ended: _Running) -> None:
        """Note that a process ended by itself; the more often early, the longer the next waits."""
        now = self._clock()
        if not slot.reason:  # else the log has it already
            ended.process.join(0)  # its exit code is known from then on
            code, life_s = ended.process.exitcode, now - ended.since
            _logger.warning("room %s ended after %.0f s with exit code %s", room, life_s, code)
        if now - ended.since > LONG_LIFE_S:
            slot.backoff_s = 0.0
        else:
            slot.backoff_s = min(MAX_BACKOFF_S, 2 * slot.backoff_s or FIRST_BACKOFF_S)
        slot.retry_at = now + slot.backoff_s * (slot.backoff_s > FIRST_BACKOFF_S)
        ended.connection.close()
        slot.running = None

    def _end(self, running: _Running) -> None:
        running.connection.close()
        running.process.join(self._limits.end_timeout_s)
        if running.process.is_alive():
            running.process.kill()
            running.process.join(KILL_TIMEOUT_S)
