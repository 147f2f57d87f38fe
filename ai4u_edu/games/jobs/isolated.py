"""A process of its own for jobs with data of unknown people; one that takes too much is ended."""

import asyncio
import multiprocessing
import shutil
import time
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import NamedTuple

import psutil

from ai4u_edu.base.numeric_threads import children_with_one_thread
from ai4u_edu.games.jobs.call import JobAnswer
from ai4u_edu.games.jobs.job import Job
from ai4u_edu.games.jobs.worker import serve_jobs
from ai4u_edu.locale import gettext as _

POLL_S = 0.1
START_TIMEOUT_S = 300.0
"""Time in which the process starts; it is no part of a job's."""
END_TIMEOUT_S = 2.0


class _Process(NamedTuple):
    process: BaseProcess
    connection: Connection
    usage: psutil.Process


class IsolatedJobs:
    """Runs jobs one at a time in a process, which is replaced if it takes too long or dies.

    Belongs to the event loop.

    Args:
        max_cpu_s: processor time of one job.
        max_wall_s: wall time of one job, for one that waits.
        folder: for temporary files of jobs; deleted with the process. By default the system's.
        first: job of each new process, for which no limits hold: it loads what others need.
    """

    def __init__(
        self,
        max_cpu_s: float,
        max_wall_s: float,
        folder: Path | None = None,
        first: Job | None = None,
    ) -> None:
        self.max_cpu_s = max_cpu_s
        self._max_wall_s, self._folder = max_wall_s, folder
        self._first = Job.of(ready) if first is None else first
        self._lock = asyncio.Lock()
        self._running: _Process | None = None
        # spawned and not forked, as this process has threads
        self._context = multiprocessing.get_context("spawn")

    async def run(self, job: Job, max_cpu_s: float | None = None) -> JobAnswer:
        """Run a job, and return its result or its error.

        Args:
            job: the job.
            max_cpu_s: its processor time, if it is another one than for others.

        Raises:
            OSError: the process could not be started; a later try may succeed.
        """
        async with self._lock:
            limit_s = self.max_cpu_s if max_cpu_s is None else max_cpu_s
            return await asyncio.to_thread(self._run, job, limit_s)

    async def end(self) -> None:
        """End the process, after the job that it has."""
        async with self._lock:
            await asyncio.to_thread(self.close)

    def close(self) -> None:
        """End the process at once."""
        running, self._running = self._running, None
        if running is not None:
            running.connection.close()
            running.process.kill()
            running.process.join(END_TIMEOUT_S)
            if self._folder is not None:
                shutil.rmtree(self._folder, ignore_errors=True)

    def _run(self, job: Job, max_cpu_s: float) -> JobAnswer:
        running = self._running = self._running or self._start()
        try:
            begin_cpu_s, end_at = _cpu_s(running.usage), time.monotonic() + self._max_wall_s
            running.connection.send(job)
            while not running.connection.poll(POLL_S):
                if _cpu_s(running.usage) - begin_cpu_s > max_cpu_s:
                    self.close()
                    limit = _("{most:g} s of processor time", most=max_cpu_s)
                    return JobAnswer(error=_("it took more than {limit}", limit=limit))
                if time.monotonic() > end_at:
                    self.close()
                    return JobAnswer(error=_("it took more than {most:g} s", most=self._max_wall_s))
            answer: JobAnswer = running.connection.recv()
        except (EOFError, OSError, psutil.Error):
            self.close()
            return JobAnswer(error=_("its process died: it may want more memory than there is"))
        return answer

    def _start(self) -> _Process:
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)  # of a class that was killed
            self._folder.mkdir(parents=True, exist_ok=True)
        ours, theirs = self._context.Pipe()
        process = self._context.Process(
            target=serve_jobs,
            args=(theirs,),
            # who starts it is a thread that may end earlier than this process
            kwargs={"is_tied": False, "folder": self._folder, "has_low_priority": True},
            name="isolated jobs",
            daemon=True,
        )
        with children_with_one_thread():
            process.start()
        theirs.close()
        problem = ""
        try:
            ours.send(self._first)
            if ours.poll(START_TIMEOUT_S):
                problem = ours.recv().error
                if not problem:
                    return _Process(process, ours, psutil.Process(process.pid))
        except (EOFError, OSError, psutil.Error) as error:
            problem = str(error)
        ours.close()
        process.kill()
        raise OSError(
            _("the process for jobs did not start: {value}", value=problem or _("it took too long"))
        )


def ready() -> None:
    """Do nothing: the first job of a process, by default."""


def _cpu_s(process: psutil.Process) -> float:
    times = process.cpu_times()
    return float(times.user + times.system)
