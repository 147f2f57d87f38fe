"""The engine that runs jobs on Ray, on this machine or on a cluster.

Whoever can connect to a Ray cluster can run any program on its machines: so Ray is started with its
token authentication.
"""

import multiprocessing
import os
import re
import signal
import socket
from contextlib import suppress
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any, Self

import psutil

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.numeric_threads import ONE_THREAD, children_with_one_thread
from ai4u_edu.base.optional_deps import need
from ai4u_edu.base.process_family import kill_descendants
from ai4u_edu.games.jobs.call import JobAnswer, call
from ai4u_edu.games.jobs.job import Job
from ai4u_edu.locale import gettext as _

JOBS_PER_CORE = 2
"""Jobs that Ray has for each core, so that none waits for the way there and back."""
START_TIMEOUT_S = 300.0
"""Time in which Ray starts, or answers at an address; usually it gives up by itself before."""
HINT = _(
    "Look whether the cluster is there; a busy machine may start Ray too slowly: then try again."
)
CONNECT_TIMEOUT_S = 10.0
MAX_PORT = 65_535
END_TIMEOUT_S = 15.0
"""Time in which Ray ends by itself; then it is killed."""
KILL_TIMEOUT_S = 60.0
"""Time in which the system removes processes that were killed; a busy machine takes seconds."""
START_TRIES = 3
"""Attempts to start Ray here: a node gives up if its agents take 15 s, as on a busy machine."""
PIPE_POLL_S = 0.5
"""Interval in which a process that waits for a job looks whether it shall end."""


class RayEngine:
    """Connects to Ray, or starts it; what it started ends with it.

    Ray's side is a process of its own: Ray's calls can block for minutes where Ctrl-C does nothing,
    it ends its process when a cluster is gone, and it changes handlers of signals. A process can be
    killed, and its end can be told.

    Args:
        width: number of jobs at a time; default: as many as the cluster has cores for.
        address: of the cluster; default: Ray is started here.

    Raises:
        SetupError: Ray is not installed, or there is no cluster at that address.
    """

    def __init__(self, width: int | None = None, address: str = "") -> None:
        need("ray", "ray")
        if address and address != "auto":
            _check_address(address)
        self._where = address or _("this machine")
        self._running: dict[str, Job] = {}
        context = multiprocessing.get_context("spawn")
        self._pipe, there = context.Pipe()
        self._process: BaseProcess = context.Process(
            target=_drive, args=(there, address), name="ray", daemon=True
        )
        with children_with_one_thread():  # what Ray starts here inherits it
            self._process.start()
        there.close()
        try:
            cores = self._cores()
        except BaseException:
            self._end(0.0)
            raise
        self.width = width or max(1, cores) * JOBS_PER_CORE

    def start(self, job: Job) -> None:
        """See :class:`ai4u_edu.games.jobs.Engine`."""
        self._running[job.key] = job
        with suppress(OSError):  # Ray's process has ended; the answer tells
            self._pipe.send(job)

    def wait(self) -> tuple[Job, JobAnswer]:
        """See :class:`ai4u_edu.games.jobs.Engine`.

        Raises:
            SetupError: Ray has ended, as it does some time after a cluster's first machine.
        """
        try:
            self._pipe.send(None)
            key, answer = self._pipe.recv()
        except (EOFError, OSError):
            raise self._ended() from None
        return self._running.pop(key), JobAnswer(*answer)

    def close(self) -> None:
        """See :class:`ai4u_edu.games.jobs.Engine`."""
        self._running.clear()
        self._end(END_TIMEOUT_S)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _end(self, timeout_s: float) -> None:
        self._pipe.close()
        try:
            self._process.join(timeout_s)
        finally:  # also after a second Ctrl-C
            if self._process.is_alive():
                _kill(self._process)

    def _cores(self) -> int:
        """Wait until Ray is ready, and return how many cores the cluster has."""
        try:
            if not self._pipe.poll(START_TIMEOUT_S):
                raise SetupError(
                    _(
                        "Ray on {where} did not answer for {start_timeout_s:g} s",
                        where=self._where,
                        start_timeout_s=START_TIMEOUT_S,
                    )
                )
            cores, problem = self._pipe.recv()
        except (EOFError, OSError):
            raise self._ended() from None
        if problem:
            raise SetupError(
                _(
                    "expected Ray on {where}, got: {problem} {hint}",
                    where=self._where,
                    problem=problem,
                    hint=HINT,
                )
            )
        return int(cores)

    def _ended(self) -> SetupError:
        self._process.join(END_TIMEOUT_S)
        return SetupError(
            _(
                "Ray on {where} has ended (exit code {exitcode}); start the cluster again, "
                "and run the same command again",
                where=self._where,
                exitcode=str(self._process.exitcode),
            )
        )


def _check_address(address: str) -> None:
    """Look whether anybody listens at an address: Ray itself would try for minutes.

    Raises:
        SetupError: it is no address, or nobody does.
    """
    match = re.fullmatch(r"(?:ray://)?\[?([^\[\]/]+?)\]?:(\d{1,5})", address)
    if match is None or int(match[2]) > MAX_PORT:
        raise SetupError(
            _("--address: expected one such as 192.0.2.7:6379, got {address!r}", address=address)
        )
    try:
        socket.create_connection((match[1], int(match[2])), CONNECT_TIMEOUT_S).close()
    except (OSError, UnicodeError) as error:
        raise SetupError(
            _(
                "expected a Ray cluster at {address}, got: {problem}; start one there with "
                "`ray start --head --port=PORT`",
                address=address,
                problem=str(error),
            )
        ) from None


def _kill(process: BaseProcess) -> None:
    """Kill a process and all that it has started."""
    with suppress(psutil.Error):
        started = psutil.Process(process.pid)
        kill_descendants(started)
        process.kill()
    process.join(KILL_TIMEOUT_S)


def _drive(pipe: Connection, address: str) -> None:
    """Start the jobs that come through a pipe until it closes, and at None send an answer.

    It is the main function of the process on Ray's side.

    The first message that it sends is the number of the cluster's cores and an empty text, or 0 and
    why there is no cluster. An answer is a job's key and its
    :class:`~ai4u_edu.games.jobs.call.JobAnswer`.

    Args:
        pipe: to the process of the engine.
        address: of the cluster; empty to start Ray here.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C ends the one that started it
    os.environ.setdefault("RAY_AUTH_MODE", "token")
    import ray as untyped

    ray: Any = untyped  # it has types for a part
    problem = _connect(ray, address)
    if problem:
        pipe.send((0, problem))
        return
    running: dict[Any, Job] = {}
    with suppress(EOFError, OSError):  # the other process has closed the pipe, or died
        pipe.send((int(ray.cluster_resources().get("CPU", 1)), ""))
        _serve(ray, pipe, running)
    for each in running:
        with suppress(ray.exceptions.RayError):
            ray.cancel(each, force=True)
    ray.shutdown()


def _connect(ray: Any, address: str) -> str:
    """Connect to Ray or start it, and return why that is impossible, or an empty text."""
    problem = ""
    for _number in range(1 if address else START_TRIES):
        try:
            ray.init(
                address=address or "local",
                include_dashboard=None if address else False,
                log_to_driver=False,
                logging_level="ERROR",
            )
        except Exception as error:  # its plainest class where a node does not start in time
            problem = str(error)
            ray.shutdown()
        else:
            return ""
    return problem


def _serve(ray: Any, pipe: Connection, running: dict[Any, Job]) -> None:
    remote = ray.remote(num_cpus=1, max_retries=0)(_call)
    while True:
        job = pipe.recv()
        if job is not None:
            running[remote.remote(job)] = job
            continue
        ready: list[Any] = []
        while not ready:
            ready, _ = ray.wait([*running], num_returns=1, timeout=PIPE_POLL_S)
            if not ready and pipe.poll():  # it asks for nothing more before it has its answer
                raise EOFError
        pipe.send((running.pop(ready[0]).key, _answer(ray, ready[0])))


def _answer(ray: Any, done: Any) -> JobAnswer:
    try:
        return JobAnswer(*ray.get(done))
    except ray.exceptions.RayError as error:  # its process or its machine died
        first, *_ = str(error).strip().splitlines() or [""]
        return JobAnswer(error=f"{type(error).__name__}: {first}")


def _call(job: Job) -> tuple[Any, ...]:
    os.environ.update(ONE_THREAD)  # on a cluster's machine, for what is loaded from here on
    return tuple(call(job))
