"""Background thread that makes files of kept episodes, one after another, with a cache."""

from collections import OrderedDict, deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from threading import Lock, Thread

from ai4u_edu.agent.block_errors import storable
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.locale import catalogue, reader
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.loop_queue import result_of
from ai4u_edu.recording import Episode

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
