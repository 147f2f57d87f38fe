"""The engine that runs jobs in processes of this machine.

The standard library's pools of processes give up when one of theirs dies, and don't tell whose job
it had. Here each process has a pipe of its own.
"""

import multiprocessing
import os
import signal
import time
from contextlib import suppress
from multiprocessing.connection import wait
from multiprocessing.process import BaseProcess
from typing import Self

import psutil

from ai4u_edu.base.numeric_threads import children_with_one_thread
from ai4u_edu.games.jobs.call import JobAnswer
from ai4u_edu.games.jobs.job import Job
from ai4u_edu.games.jobs.worker import is_main_thread, serve_jobs
from ai4u_edu.locale import gettext as _

END_TIMEOUT_S = 2.0
"""Time in which a process that has closed its pipe ends by itself, and can tell how it ended."""
STOP_POLL_S = 1.0
"""Interval in which it is looked whether a process stands still."""
STOP_TIMEOUT_S = 30.0
"""Time after which a process that another one has stopped is killed, and its job tried again."""
STOPPED = (psutil.STATUS_STOPPED, psutil.STATUS_TRACING_STOP)
KILL_TIMEOUT_S = 60.0
"""Time in which the system removes a process that was killed; a busy machine takes seconds."""


class ProcessEngine:
    """Starts its processes with their first jobs; one that dies is replaced.

    Args:
        width: number of processes; default: one for each core that this process may use.
    """

    def __init__(self, width: int | None = None) -> None:
        self.width = width or core_count()
        # in one list from before their start to after their end: Ctrl-C may come at any moment, and
        # Python waits at its end for a process that was not ended
        self._workers: list[_Worker] = []

    def start(self, job: Job) -> None:
        """See :class:`ai4u_edu.games.jobs.Engine`."""
        worker = next((each for each in self._workers if not each.is_busy), None)
        if worker is None:
            worker = _Worker()
            self._workers.append(worker)
            worker.begin()
        worker.start(job)

    def wait(self) -> tuple[Job, JobAnswer]:
        """See :class:`ai4u_edu.games.jobs.Engine`."""
        busy = {each.pipe: each for each in self._workers if each.is_busy}
        ready = wait([*busy], STOP_POLL_S)
        while not ready:
            for each in busy.values():
                each.wake()
            ready = wait([*busy], STOP_POLL_S)
        worker = busy[ready[0]]  # type: ignore[index]  # it is one of them, maybe of a dead process
        answer = worker.answer()
        if answer is None:
            self._workers.remove(worker)
            end = worker.end(END_TIMEOUT_S)
            answer = JobAnswer(error=worker.problem or _("its process died ({end})", end=end))
        return worker.job, answer

    def close(self) -> None:
        """See :class:`ai4u_edu.games.jobs.Engine`."""
        for worker in self._workers:
            worker.end()
        self._workers.clear()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class _Worker:
    job: Job

    def __init__(self) -> None:
        self.is_busy = False
        self.problem = ""
        """Reason for which the process was killed; empty if it was not."""
        self._stopped_at: float | None = None
        context = multiprocessing.get_context("spawn")
        self.pipe, self._there = context.Pipe()
        self._process: BaseProcess = context.Process(
            target=serve_jobs,
            args=(self._there,),
            kwargs={"is_tied": is_main_thread()},
            name="job",
        )

    def begin(self) -> None:
        """Start the process."""
        with children_with_one_thread():
            self._process.start()
        self._there.close()

    def start(self, job: Job) -> None:
        self.job, self.is_busy = job, True
        with suppress(OSError):  # it died while it was idle; the answer tells
            self.pipe.send(job)

    def wake(self) -> None:
        """Have the process go on if somebody has stopped it, and kill it if that does not help."""
        try:
            process = psutil.Process(self._process.pid)
            is_stopped = process.status() in STOPPED
        except psutil.Error:  # it has died
            return
        if not is_stopped:
            self._stopped_at = None
            return
        now = time.monotonic()
        if self._stopped_at is None:  # the second look counts: Ctrl-Z stops all, and they go on
            self._stopped_at = now
            return
        if now - self._stopped_at > STOP_TIMEOUT_S:
            self.problem = _(
                "its process was stopped by another one for {stop_timeout_s:g} s",
                stop_timeout_s=STOP_TIMEOUT_S,
            )
            process.kill()
        else:
            process.resume()

    def answer(self) -> JobAnswer | None:
        """Return what the process sent; None if it died."""
        try:
            answer: JobAnswer = self.pipe.recv()
        except (EOFError, OSError):
            return None
        self.is_busy = False
        return answer

    def end(self, timeout_s: float = 0.0) -> str:
        """End the process, and return how it ended in words.

        Args:
            timeout_s: time (s) for it to end by itself; then it is killed.
        """
        self.pipe.close()
        if self._process.pid is None:  # Ctrl-C came before its start
            return _("not started")
        self._process.join(timeout_s)
        code = self._process.exitcode
        self._process.kill()
        self._process.join(KILL_TIMEOUT_S)
        code = self._process.exitcode if code is None else code
        if self._process.exitcode is not None:
            self._process.close()
        if code is not None and code < 0:
            killed = signal.Signals(-code).name
            return _("{killed}: out of memory?", killed=killed) if killed == "SIGKILL" else killed
        return _("exit code {code}", code=str(code))


def core_count() -> int:
    """Return the count of processor cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
