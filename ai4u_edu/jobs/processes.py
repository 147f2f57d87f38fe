"""The engine that runs jobs in processes of this machine.

The standard library's pools of processes give up when one of theirs dies, and don't tell whose job
it had. Here each process has a pipe of its own.
"""

import multiprocessing
import os
import signal
import threading
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Self

from tqdm import tqdm

from ai4u_edu.jobs.call import Answer, call, use_one_thread
from ai4u_edu.jobs.job import Job

END_TIMEOUT_S = 2.0
"""Time in which a process that has closed its pipe ends by itself, and can tell how it ended."""
KILL_TIMEOUT_S = 60.0
"""Time in which the system removes a process that was killed; a busy machine takes seconds."""


class ProcessEngine:
    """Starts its processes with their first jobs; one that dies is replaced.

    Args:
        width: number of processes; left out, one for each core that this process may use.
    """

    def __init__(self, width: int | None = None) -> None:
        self.width = width or _cores()
        # in one list from before their start to after their end: Ctrl-C may come at any moment, and
        # Python waits at its end for a process that was not ended
        self._workers: list[_Worker] = []

    def start(self, job: Job) -> None:
        """See :class:`ai4u_edu.jobs.Engine`."""
        worker = next((each for each in self._workers if not each.is_busy), None)
        if worker is None:
            worker = _Worker()
            self._workers.append(worker)
            worker.begin()
        worker.start(job)

    def wait(self) -> tuple[Job, Answer]:
        """See :class:`ai4u_edu.jobs.Engine`."""
        busy = {each.pipe: each for each in self._workers if each.is_busy}
        (ready, *_) = wait([*busy])  # the pipe of a dead process is, too
        worker = busy[ready]  # type: ignore[index]  # it is one of them
        answer = worker.answer()
        if answer is None:
            self._workers.remove(worker)
            answer = Answer(error=f"its process died ({worker.end(END_TIMEOUT_S)})")
        return worker.job, answer

    def close(self) -> None:
        """See :class:`ai4u_edu.jobs.Engine`."""
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
        context = multiprocessing.get_context("spawn")
        self.pipe, self._there = context.Pipe()
        self._process: BaseProcess = context.Process(target=_work, args=(self._there,), name="job")

    def begin(self) -> None:
        """Start the process."""
        self._process.start()
        self._there.close()

    def start(self, job: Job) -> None:
        self.job, self.is_busy = job, True
        with suppress(OSError):  # it died while it was idle; the answer tells
            self.pipe.send(job)

    def answer(self) -> Answer | None:
        """Return what the process sent; None if it died."""
        try:
            answer: Answer = self.pipe.recv()
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
            return "not started"
        self._process.join(timeout_s)
        code = self._process.exitcode
        self._process.kill()
        self._process.join(KILL_TIMEOUT_S)
        code = self._process.exitcode if code is None else code
        if self._process.exitcode is not None:
            self._process.close()
        if code is not None and code < 0:
            killed = signal.Signals(-code).name
            return f"{killed}: out of memory?" if killed == "SIGKILL" else killed
        return f"exit code {code}"


def _work(pipe: Connection) -> None:
    use_one_thread()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C ends the one that started it
    # torch shows progress with tqdm, whose usual lock a process that is killed leaves in the system
    tqdm.set_lock(threading.RLock())
    while True:
        try:
            job = pipe.recv()
        except (EOFError, OSError):
            return
        pipe.send(call(job))


def _cores() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
