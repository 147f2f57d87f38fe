"""HTTP routes for the kept episodes: a list, and each episode as a file, made one at a time."""

import asyncio
import tempfile
from collections import OrderedDict, deque
from collections.abc import AsyncIterator, Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock, Thread
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse

from ai4u_edu.agent.block_errors import storable
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.locale import catalogue, reader
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.scene_pictures import scene_picture
from ai4u_edu.page.server.api import Number
from ai4u_edu.page.server.loop_queue import result_of
from ai4u_edu.page.server.reader_language import TextResponse
from ai4u_edu.recording import ArchiveEntry, Episode, Replay
from ai4u_edu.recording.episode import encode
from ai4u_edu.recording.exports.csv_file import write_csv
from ai4u_edu.recording.exports.html_page import write_html
from ai4u_edu.recording.exports.movie import write_gif, write_mp4
from ai4u_edu.recording.scene_export import without_unknown_brains
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene

MAX_QUEUED = 16
"""Files in the queue."""
MAX_WAITING = 64
"""Requests that may wait for files; each has a connection meanwhile."""
RETRY_AFTER_S = 10
MAX_CACHED_BYTES = 64 * 2**20
MAX_CACHED = 32
"""Files in the cache, the latest ones; each keeps its episode in memory."""

Make = Callable[[Episode, str, Callable[[], None]], bytes]
"""Function that makes a file, of an episode and for a file extension. It calls its third argument
often, which raises to stop it."""
WRITERS: dict[str, tuple[str, Callable[[Replay, Path], Path]]] = {
    "html": ("text/html; charset=utf-8", write_html),
    "gif": ("image/gif", write_gif),
    "mp4": ("video/mp4", write_mp4),
    "csv": ("text/csv; charset=utf-8", write_csv),
}
"""Media type and writer by file extension."""
RECORDING = "episode"
RECORDING_KIND = "application/octet-stream"
PICTURE = "png"
PICTURE_PX = 160
"""Longer side of the picture of an episode's start."""
MAX_PICTURES = 200
"""Most pictures that are kept."""
PART_BYTES = 64 * 2**10
"""Size of the parts in which a file is sent; a slow client holds one of them in memory."""
HEADERS = {
    "Cache-Control": "no-store",
    # a file that is opened as a page must not act with our origin
    "Content-Security-Policy": "sandbox allow-scripts",
}


class EpisodeView(BaseModel):
    """A kept episode."""

    model_config = ConfigDict(extra="forbid")

    number: int = Field(description="of its file: api/past/NUMBER.episode (.html .csv .gif .mp4)")
    scene: str
    seed: Annotated[int, Field(ge=0)]
    seconds: Number
    decisions: int = Field(description="of the agent that acts first")
    reward: Number = Field(description="of the agent that acts first, altogether")
    success: bool | None = Field(description="null in a scene without a goal")
    driver: str = Field(description="the title of the first agent's brain")
    source: str = Field(description="the file that it came from; empty if it happened here")

    @classmethod
    def of(cls, entry: ArchiveEntry) -> "EpisodeView":
        """Return the view of an entry."""
        episode = entry.episode
        return cls(
            number=entry.number,
            scene=episode.scene.name,
            seed=episode.seed,
            seconds=episode.seconds,
            decisions=len(entry.first),
            reward=entry.first.total,
            success=entry.success,
            driver=entry.first.driver,
            source=entry.source,
        )


class PastView(BaseModel):
    """The kept episodes, the oldest first."""

    model_config = ConfigDict(extra="forbid")

    episodes: list[EpisodeView]


class Past:
    """Routes to the episodes that a room keeps.

    Args:
        runner: the room's.
    """

    def __init__(self, runner: Runner) -> None:
        self._runner = runner
        # replaying and drawing keep a core busy: one file at a time. Recordings need not wait
        self._recordings, self._files = Exports(_recording), Exports(_file)
        self._pictures: dict[int, bytes] = {}
        self._drawing = asyncio.Lock()
        self._listed: tuple[tuple[ArchiveEntry, ...], str] = ((), "")

    def list(self, _: Request) -> Response:
        """Return the list as JSON."""
        entries, text = self._listed
        if not text or entries is not self._entries():
            entries = self._entries()
            text = PastView(episodes=[*map(EpisodeView.of, entries)]).model_dump_json()
            self._listed = entries, text
        headers = {"Cache-Control": "no-store"}
        return Response(text, media_type="application/json", headers=headers)

    async def file(self, request: Request) -> Response:
        """Return an episode as a file: ``3.episode``, ``3.html``, ..."""
        name = str(request.path_params["file"])
        number, _dot, ending = name.partition(".")
        known = (RECORDING, PICTURE, *WRITERS)
        if ending not in known or not (number.isdecimal() and number.isascii()):
            expected = ", ".join(f"NUMBER.{each}" for each in known)
            return TextResponse(
                _("expected one of {expected}, got {name!r}", expected=expected, name=name[:80]),
                404,
            )
        entry = next((each for each in self._entries() if str(each.number) == number), None)
        if entry is None:
            kept = ", ".join(str(each.number) for each in self._entries()) or "none"
            return TextResponse(
                _("no episode {number} is kept; there are {kept}", number=number[:20], kept=kept),
                404,
            )
        if ending == PICTURE:
            return await self._picture(entry)
        try:
            data = await self._made(entry.episode, ending, request)
        except BusyError as error:
            headers = {"Retry-After": str(RETRY_AFTER_S), "Cache-Control": "no-store"}
            return TextResponse(text_of(error), 503, headers)
        except AI4UError as error:
            return TextResponse(text_of(error), 409)
        kind = RECORDING_KIND if ending == RECORDING else WRITERS[ending][0]
        attached = f'attachment; filename="{_plain(entry)}.{ending}"'
        about = {"Content-Disposition": attached, "Content-Length": str(len(data))}
        return StreamingResponse(_parts(data), media_type=kind, headers=HEADERS | about)

    async def _picture(self, entry: ArchiveEntry) -> Response:
        """Return a picture of an episode's start; one is drawn at a time, and once."""
        async with self._drawing:
            if entry.number not in self._pictures:
                if len(self._pictures) >= MAX_PICTURES:
                    self._pictures.clear()
                try:
                    data = await asyncio.to_thread(_drawn, entry.episode)
                except AI4UError as error:
                    return TextResponse(text_of(error), 409)
                self._pictures[entry.number] = data
        headers = {"Cache-Control": "private, max-age=3600"}
        return Response(self._pictures[entry.number], media_type="image/png", headers=headers)

    async def _made(self, episode: Episode, ending: str, request: Request) -> bytes:
        """Wait for a file until the client disconnects."""
        exports = self._recordings if ending == RECORDING else self._files
        making = asyncio.ensure_future(exports.get(episode, ending))
        leaving = asyncio.ensure_future(_has_left(request))
        try:
            await asyncio.wait({making, leaving}, return_when=asyncio.FIRST_COMPLETED)
            return making.result() if making.done() else b""  # the client has disconnected
        finally:
            making.cancel()
            leaving.cancel()

    def _entries(self) -> tuple[ArchiveEntry, ...]:
        recorder = self._runner.recorder
        return _NONE if recorder is None else recorder.episodes.entries


_NONE: tuple[ArchiveEntry, ...] = ()


async def _has_left(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass


async def _parts(data: bytes) -> AsyncIterator[bytes]:
    for begin in range(0, len(data), PART_BYTES):
        yield data[begin : begin + PART_BYTES]


def _recording(episode: Episode, _: str, check: Callable[[], None]) -> bytes:
    check()
    return encode(episode)


def _drawn(episode: Episode) -> bytes:
    return scene_picture(Scene(without_unknown_brains(episode.scene)), PICTURE_PX, episode.seed)


def _file(episode: Episode, ending: str, check: Callable[[], None]) -> bytes:
    _kind, write = WRITERS[ending]
    with tempfile.TemporaryDirectory(prefix="ai4u-edu-") as folder:
        replay = Replay(episode, on_step=check)
        return write(replay, Path(folder) / f"episode.{ending}").read_bytes()


def _plain(entry: ArchiveEntry) -> str:
    """Return a file name for a scene's name, which may be any text."""
    name = "".join(each if each.isascii() and each.isalnum() else "_" for each in entry.name)
    return name.strip("_")[:60] or "episode"


class BusyError(AI4UError):
    """Too many files are in the queue, or too many requests wait."""


class ExportStoppedError(Exception):
    """Raised to stop making a file that nobody waits for any more."""


class Exports:
    """Queue and cache of files.

    Equal requests in one language share one file. A file that all its requests have given up is
    not made, or stopped.

    The event loop calls :meth:`get`. A daemon thread, which ends when the queue is empty, makes the
    files. A lock guards what both use.

    Args:
        make: makes a file.
    """

    def __init__(self, make: Make) -> None:
        self._make = make
        self._lock = Lock()
        self._thread: Thread | None = None
        self._queue: deque[_Job] = deque()
        self._waiting = 0
        self._jobs: dict[_Key, _Job] = {}
        self._cached: OrderedDict[_Key, tuple[Episode, bytes]] = OrderedDict()

    async def get(self, episode: Episode, ending: str) -> bytes:
        """Return an episode as a file; give the request up if cancelled.

        Raises:
            BusyError: too many files are in the queue, or too many requests wait.
            AI4UError: the file can't be made.
        """
        # job and cache keep the episode alive: its id is unique
        key = id(episode), ending, catalogue().language
        with self._lock:
            if key in self._cached:
                self._cached.move_to_end(key)
                return self._cached[key][1]
            if self._waiting >= MAX_WAITING:
                raise BusyError(
                    _(
                        "expected at most {most} requests that wait for files, got another one; "
                        "try again in a moment",
                        most=MAX_WAITING,
                    )
                )
            job = self._jobs.get(key) or self._enqueue(key, episode, ending)
            job.waiting += 1
            self._waiting += 1
        try:
            return await result_of(job.made)
        finally:
            with self._lock:
                job.waiting -= 1
                self._waiting -= 1
                if not job.waiting and not job.made.done():
                    self._drop(job)

    def _enqueue(self, key: "_Key", episode: Episode, ending: str) -> "_Job":
        if len(self._queue) >= MAX_QUEUED:
            raise BusyError(
                _(
                    "expected at most {most} files that wait to be made, got another one; "
                    "try again in a moment",
                    most=MAX_QUEUED,
                )
            )
        job = self._jobs[key] = _Job(key, episode, ending)
        self._queue.append(job)
        if self._thread is None:
            self._thread = Thread(target=self._work, name="exports", daemon=True)
            self._thread.start()
        return job

    def _drop(self, job: "_Job") -> None:
        job.is_stopped = True
        if job in self._queue:
            self._queue.remove(job)
        if self._jobs.get(job.key) is job:
            del self._jobs[job.key]

    def _work(self) -> None:
        while True:
            with self._lock:
                if not self._queue:
                    self._thread = None
                    return
                job = self._queue.popleft()
            try:
                with reader(job.key[2]):
                    data = self._make(job.episode, job.ending, job.check)
            except ExportStoppedError:
                continue
            except BaseException as error:  # else all later requests would wait for ever
                self._finish(job, storable(error))
            else:
                self._finish(job, data)

    def _finish(self, job: "_Job", outcome: bytes | Exception) -> None:
        with self._lock:
            if self._jobs.get(job.key) is job:
                del self._jobs[job.key]
            if isinstance(outcome, bytes):
                self._keep(job, outcome)
            if job.is_stopped:
                return  # the loop may be closed
            if isinstance(outcome, bytes):
                job.made.set_result(outcome)
            else:
                job.made.set_exception(outcome)

    def _keep(self, job: "_Job", data: bytes) -> None:
        self._cached[job.key] = job.episode, data
        size = sum(len(each) for _, each in self._cached.values())
        while self._cached and (size > MAX_CACHED_BYTES or len(self._cached) > MAX_CACHED):
            _, (_, dropped) = self._cached.popitem(last=False)
            size -= len(dropped)


_Key = tuple[int, str, str]


@dataclass(eq=False)
class _Job:
    key: _Key
    episode: Episode
    ending: str
    made: "Future[bytes]" = field(default_factory=Future)
    waiting: int = 0
    is_stopped: bool = False

    def check(self) -> None:
        if self.is_stopped:
            raise ExportStoppedError
