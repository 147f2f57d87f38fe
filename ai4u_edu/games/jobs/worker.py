"""The process that runs jobs for another one, and ends with it, also in the middle of a job."""

import multiprocessing
import os
import signal
import tempfile
import threading
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from queue import SimpleQueue

import psutil
from tqdm import tqdm

from ai4u_edu.base.process_family import end_with_parent, kill_descendants
from ai4u_edu.base.process_priority import lower_priority
from ai4u_edu.games.jobs.call import call
from ai4u_edu.games.jobs.job import Job


def is_main_thread() -> bool:
    """Return True in the main thread, whose end is that of the process."""
    return threading.current_thread() is threading.main_thread()


def serve_jobs(
    pipe: Connection, *, is_tied: bool, folder: Path | None = None, has_low_priority: bool = False
) -> None:
    """Run jobs until the other end of the pipe is closed; the main function of the process.

    Each core has a job of its own, so whoever starts the process gives it the variables of
    :func:`~ai4u_edu.base.numeric_threads.children_with_one_thread`.

    Args:
        pipe: gives each :class:`Job`, and gets its :class:`~ai4u_edu.games.jobs.call.JobAnswer`.
        is_tied: True has the system end this process with the thread that started it, on Linux:
            the thread that watches the pipe waits for libraries that hold the interpreter.
        folder: for temporary files of jobs; by default the system's.
        has_low_priority: True lets other processes come first.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C ends the one that started it
    parent = multiprocessing.parent_process()
    if is_tied and parent is not None and parent.pid is not None:
        end_with_parent(parent.pid)
    if folder is not None:
        tempfile.tempdir = str(folder.absolute())
    if has_low_priority:
        lower_priority()
    # torch shows progress with tqdm, whose usual lock a process that is killed leaves in the system
    tqdm.set_lock(threading.RLock())
    jobs = SimpleQueue[Job]()
    threading.Thread(target=_receive, args=(pipe, jobs), name="job receiver", daemon=True).start()
    while True:
        answer = call(jobs.get())
        with suppress(OSError):  # the other end is closed: the thread ends this process
            pipe.send(answer)


def _receive(pipe: Connection, jobs: "SimpleQueue[Job]") -> None:
    with suppress(EOFError, OSError):
        while True:
            jobs.put(pipe.recv())
    kill_descendants(psutil.Process())
    os._exit(0)
